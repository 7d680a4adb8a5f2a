"""Equilibria of a manipulator at the steps of some tests, in the shape in which a prediction keeps its states."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class States:
    """Batched over leading axes: unknowns (..., size), converged and unstable (...), reason (...) of strings."""

    unknowns: Array
    converged: np.ndarray
    unstable: np.ndarray
    reason: np.ndarray

    def member(self, index: int | tuple[int | slice, ...] | slice | np.ndarray) -> States:
        """One state of the batch, or several."""
        parts = (self.unknowns, self.converged, self.unstable, self.reason)
        return States(*(np.asarray(part[index]) for part in parts))

    def with_members(self, index: np.ndarray | tuple[int | np.ndarray, ...], other: States) -> States:
        """The same states with those of another one at these numbers of the batch."""
        parts = [self.unknowns.copy(), self.converged.copy(), self.unstable.copy(), self.reason.copy()]
        for part, new in zip(
            parts, (other.unknowns, other.converged, other.unstable, other.reason), strict=True
        ):
            part[index] = new
        return States(*parts)

    def reshaped(self, *batch: int) -> States:
        """The same states with other batch axes."""
        axes = self.converged.ndim
        parts = (self.unknowns, self.converged, self.unstable, self.reason)
        return States(*(part.reshape((*batch, *part.shape[axes:])) for part in parts))
