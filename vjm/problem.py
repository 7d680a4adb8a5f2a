"""Eq. 5 of a batch of load cases, each platform coordinate held or loaded, as a system for Newton's method."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm import lagrangian
from vjm.frames import POSE_NAMES, Array
from vjm.mechanism import Mechanism
from vjm.newton import Step

Held = Collection[str] | np.ndarray
"""The held platform coordinates: names among x y z rx ry rz, or a mask (..., 6), one for each load case."""


def held_mask(held: Held) -> np.ndarray:
    """Mask (6,) or (..., 6) of the held coordinates; ValueError for what is neither names nor a mask."""
    if isinstance(held, np.ndarray):
        if held.dtype != bool or held.ndim == 0 or held.shape[-1] != 6:
            raise ValueError(f"a mask of held coordinates must be (..., 6) of bool, got {held.shape}")
        return held
    unknown = sorted(set(held) - set(POSE_NAMES))
    if unknown:
        raise ValueError(f"held coordinates must be among {POSE_NAMES}, got {unknown}")
    return np.array([name in held for name in POSE_NAMES])


@dataclass(frozen=True, eq=False)
class Problem:
    """Load cases of one mechanism.

    targets: (B, 6) pose values where held, loads elsewhere. held: (B, 6). memory: (B, M) of the laws.
    Residual rows are dimensionless: translations over the length, forces over the largest spring x length.
    """

    mechanism: Mechanism
    targets: Array
    held: np.ndarray
    memory: Array

    @cached_property
    def place(self) -> lagrangian.Layout:
        return lagrangian.layout(self.mechanism)

    def take(self, members: np.ndarray | slice) -> Problem:
        """The load cases with these numbers."""
        return Problem(self.mechanism, self.targets[members], self.held[members], self.memory[members])

    def aim(self, targets: Array) -> Problem:
        """The same control with other targets."""
        return Problem(self.mechanism, targets, self.held, self.memory)

    def blockwise(self, unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
        """`System` that solves chain by chain."""
        chains = lagrangian.all_rows(self.mechanism, unknowns, self.memory[members])
        rows = self._residual(chains, unknowns, members)

        def step(done: np.ndarray) -> tuple[Array, np.ndarray, np.ndarray]:
            held = self.held[members]
            found = lagrangian.newton_step(self.place, chains, -rows[..., None], held)
            unstable = lagrangian.unstable_directions(self.place, chains, found.stiffness, held, done)
            return found.step[..., 0], found.regular, unstable

        return rows, step

    def whole(self, unknowns: Array, members: np.ndarray) -> tuple[Array, Array]:
        """Residual (B, N) and its whole matrix (B, N, N), columns by unknowns in their units."""
        chains = lagrangian.all_rows(self.mechanism, unknowns, self.memory[members])
        rows = self._residual(chains, unknowns, members)
        place, held = self.place, self.held[members]
        matrix = lagrangian.hessian(place, chains) * (place.scale / place.energy)[:, None]
        pinned = np.diag(1.0 / place.scale)[place.platform]
        matrix[:, place.platform] = np.where(held[..., None], pinned, matrix[:, place.platform])
        return rows, matrix

    def _residual(
        self, chains: tuple[lagrangian.ChainRows, ...], unknowns: Array, members: np.ndarray
    ) -> Array:
        place, held, value = self.place, self.held[members], self.targets[members]
        rows = lagrangian.gradient(place, chains, unknowns, np.where(held, 0.0, value))
        rows *= place.scale / place.energy
        offset = (unknowns[:, place.platform] - value) / place.scale[place.platform]
        rows[:, place.platform] = np.where(held, offset, rows[:, place.platform])
        return rows
