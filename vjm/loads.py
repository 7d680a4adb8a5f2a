"""Dead loads: forces of constant size and direction on points of a chain, as its own weight."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.chain import Chain, Kinematics, Mark
from vjm.frames import Array


@dataclass(frozen=True, eq=False)
class DeadLoads:
    """Forces on points along a path.

    path: from the base to the last point or beyond. coordinates: numbers of the path's coordinates in its chain.
    marks: the s points. forces: (s, 3) N, base frame.
    """

    path: Chain
    coordinates: np.ndarray
    marks: tuple[Mark, ...]
    forces: Array

    def potential(self, coordinates: Array) -> Array:
        """Potential energy (...), N·mm, at all coordinates (..., n) of the chain."""
        places = self._walk(coordinates).places
        return -np.einsum("ks...,sk->...", places, self.forces)

    def pull(self, coordinates: Array, second: bool) -> tuple[Array, Array]:
        """Generalised force (..., n) and, if `second`, its derivative (..., n, n), else an empty array.

        A joint carries what hangs beyond it: the sum F of the forces and, about its origin o, T = sum (p - o) f^T,
        whose antisymmetric part is their moment. It feels F along, or the moment about, its axis a; and with the
        velocity v of a point, sum v x f is a x F where the joint slides and T a - a tr T where it turns.
        """
        here, numbers = self._walk(coordinates), self.coordinates
        batch = (1,) * (coordinates.ndim - 1)
        turns = here.turns.reshape(-1, *batch)
        beyond = self._beyond.reshape(3, -1, *batch)
        spread = np.einsum("as...,sbj->abj...", here.places, self._shares, optimize=True)
        spread -= here.origins[:, None] * beyond
        moment = np.stack([spread[i, j] - spread[j, i] for i, j in ((1, 2), (2, 0), (0, 1))])
        felt = np.sum(here.axes * np.where(turns, moment, beyond), axis=0)
        force = np.zeros(coordinates.shape)
        force[..., numbers] = here.tie.fold(np.moveaxis(felt, 0, -1))
        if not second:
            return force, np.zeros(0)
        trace = spread[0, 0] + spread[1, 1] + spread[2, 2]
        turned = np.einsum("abj...,bj...->aj...", spread, here.axes) - here.axes * trace
        slid = np.cross(here.axes, beyond, axis=0)
        slope = np.zeros((*coordinates.shape, coordinates.shape[-1]))
        z = np.moveaxis(np.where(turns, turned, slid), (0, 1), (-2, -1))
        slope[..., numbers[:, None], numbers] = here.second(z)
        return force, slope

    def _walk(self, coordinates: Array) -> Kinematics:
        return self.path.kinematics(coordinates[..., self.coordinates], self.marks)

    @cached_property
    def _shares(self) -> Array:
        """(s, 3, joints) forces as far as they lie beyond the joints."""
        joints = np.array([mark.joints(self.path) for mark in self.marks])
        return self.forces[:, :, None] * (joints[:, None, None] > np.arange(len(self.path.moved)))

    @cached_property
    def _beyond(self) -> Array:
        """(3, joints) F."""
        return np.asarray(self._shares.sum(axis=0))
