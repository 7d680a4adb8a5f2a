"""Dead loads: forces of constant size and direction on points of a chain, as its own weight."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm import kernels
from vjm.chain import Chain, Mark
from vjm.frames import Array, flat
from vjm.program import Marks


@dataclass(frozen=True, eq=False)
class DeadLoads:
    """Forces on points along a path.

    path: from the base to the last point or beyond. coordinates: numbers of the path's coordinates in its chain.
    marks: the s points, those nearer the base first. forces: (s, 3) N, base frame. ValueError for what does not fit.
    """

    path: Chain
    coordinates: np.ndarray
    marks: tuple[Mark, ...]
    forces: Array

    def __post_init__(self) -> None:
        places = [mark.elements for mark in self.marks]
        if self.coordinates.size != self.path.size or self.forces.shape != (len(places), 3):
            raise ValueError(
                f"a path of {self.path.size} coordinates with {len(places)} points, "
                f"got {self.coordinates.size} numbers and forces {self.forces.shape}"
            )
        if places != sorted(places) or (places and places[-1] > len(self.path.elements)):
            raise ValueError(f"points stand along {len(self.path.elements)} elements in order, got {places}")

    def pull(self, coordinates: Array, second: bool) -> tuple[Array, Array]:
        """Generalised force (..., n) and, if `second`, its derivative (..., n, n), else an empty array.

        A joint carries what hangs beyond it: the sum F of the forces and, about its origin o, T = sum (p - o) f^T,
        whose antisymmetric part is their moment. It feels F along, or the moment about, its axis a; and with the
        velocity v of a point, sum v x f is a x F where the joint slides and T a - a tr T where it turns.
        """
        force = np.zeros(coordinates.shape)
        slope = np.zeros((*coordinates.shape, coordinates.shape[-1]) if second else 0)
        self.add(coordinates, self.coordinates, 1.0, force, slope)
        return force, slope

    def add(self, coordinates: Array, columns: np.ndarray, sign: float, force: Array, slope: Array) -> None:
        """Add sign x the force to (..., m) and, unless that is empty, sign x its derivative to (..., k, k).

        Both contiguous. columns: (n,) number there of each coordinate of the path, `vjm.kernels.NO_COLUMN` of none.
        """
        here = flat(coordinates[..., self.coordinates])
        slopes = slope.reshape(len(here), *slope.shape[-2:]) if slope.size else np.zeros((0, 0, 0))
        parts = (self.path.program, self._marked, self._joints, flat(self.forces))
        kernels.load(*parts, columns, here, sign, force.reshape(len(here), force.shape[-1]), slopes)

    @cached_property
    def _marked(self) -> Marks:
        return Marks(
            np.array([mark.elements for mark in self.marks], dtype=np.int64),
            np.array([mark.offset for mark in self.marks], dtype=float).reshape(-1, 3),
        )

    @cached_property
    def _joints(self) -> np.ndarray:
        """(s,) joints that move each point."""
        return np.array([mark.joints(self.path) for mark in self.marks], dtype=np.int64)
