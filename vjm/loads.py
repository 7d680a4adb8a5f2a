"""Dead loads: forces of constant size and direction on points of a chain, as its own weight."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm.chain import Chain
from vjm.frames import Array


@dataclass(frozen=True, eq=False)
class DeadLoad:
    """A force on the point at the end of a path.

    path: from the base to the point. coordinates: numbers of the path's coordinates in its chain.
    force: (3,) N, base frame.
    """

    path: Chain
    coordinates: np.ndarray
    force: Array

    def potential(self, coordinates: Array) -> Array:
        """Potential energy (...), N·mm, at all coordinates (..., n) of the chain."""
        return -np.asarray(self.path.pose(coordinates[..., self.coordinates])[..., :3] @ self.force)

    def pull(self, coordinates: Array, second: bool) -> tuple[Array, Array]:
        """Generalised force (..., n) and, if `second`, its derivative (..., n, n), else an empty array."""
        here = self.path.kinematics(coordinates[..., self.coordinates])
        force = np.zeros(coordinates.shape)
        force[..., self.coordinates] = np.einsum("k,...kn->...n", self.force, here.jacobian[..., :3, :])
        if not second:
            return force, np.zeros(0)
        slope = np.zeros((*coordinates.shape, coordinates.shape[-1]))
        wrench = np.concatenate([self.force, np.zeros(3)])
        slope[..., self.coordinates[:, None], self.coordinates] = here.hessian(wrench)
        return force, slope
