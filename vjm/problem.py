"""Eq. 5 of a batch of load cases, each platform coordinate under its own control, as a system for Newton's method."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from vjm import blocks, lagrangian
from vjm.clearance import Clearance
from vjm.frames import POSE_NAMES, Array
from vjm.lagrangian import ChainRows
from vjm.mechanism import Mechanism
from vjm.newton import Step
from vjm.readings import Readings

Held = Collection[str] | np.ndarray
"""The control of the platform coordinates: names of the held ones among x y z rx ry rz, a mask (..., 6) of
them, or channel numbers (..., 6) of integers (`vjm.sensors`: pose 0 to 5, load 6 to 11, gauges from 12).
"""


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


def channel_numbers(held: Held, gauges: int = 0) -> np.ndarray:
    """Channel (6,) or (..., 6) that each coordinate's control prescribes.

    ValueError for a pose or load channel of another coordinate, or a gauge beyond the number of them.
    """
    if not (isinstance(held, np.ndarray) and np.issubdtype(held.dtype, np.integer)):
        return np.arange(6) + np.where(held_mask(held), 0, 6)
    own = (held % 6 == np.arange(6)) & (held >= 0) & (held < 12)
    if held.ndim == 0 or held.shape[-1] != 6 or not np.all(own | ((held >= 12) & (held < 12 + gauges))):
        raise ValueError(f"coordinate i is controlled by channel i, i + 6 or a gauge of {gauges}, got {held}")
    return held


@dataclass(frozen=True, eq=False)
class Problem:
    """Load cases of one mechanism.

    targets: (B, 6) readings of the channels (B, 6). memory: (B, M) of the laws. drives: (B, D) inputs, as departures.
    Residual rows are dimensionless: translations over the length, forces over the largest spring x length.
    """

    mechanism: Mechanism
    targets: Array
    channels: np.ndarray
    memory: Array
    drives: Array

    @cached_property
    def place(self) -> lagrangian.Layout:
        return lagrangian.layout(self.mechanism)

    @property
    def held(self) -> np.ndarray:
        """(B, 6) coordinates that are held, by their own reading or by a gauge."""
        return (self.channels < 6) | (self.channels >= 12)

    @cached_property
    def plays(self) -> bool:
        """Whether a law has a play, nearly free up to its stops."""
        return any(isinstance(s.law, Clearance) for chain in self.mechanism.chains for s in chain.springs)

    def take(self, members: np.ndarray | slice) -> Problem:
        """The load cases with these numbers."""
        parts = (self.targets, self.channels, self.memory, self.drives)
        return Problem(self.mechanism, *(part[members] for part in parts))

    def aim(self, targets: Array, drives: Array) -> Problem:
        """The same control with other targets and inputs."""
        return replace(self, targets=targets, drives=drives)

    def readings(self, unknowns: Array) -> Array:
        """(B, 6) of the controlled channels at unknowns (B, N)."""
        return self._controlled(Readings(self.mechanism, unknowns, self.drives))

    def _controlled(self, seen: Readings) -> Array:
        values = seen.values if np.any(self.channels >= 12) else seen.channels.values
        return np.asarray(np.take_along_axis(values, self.channels, axis=-1))

    def blockwise(self, unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
        """`System` that solves chain by chain."""
        part = self.take(members)
        chains = lagrangian.all_rows(self.mechanism, unknowns, part.memory, part.drives)
        seen = Readings(self.mechanism, unknowns, part.drives)
        control = seen.control(part.channels)
        rows = part.residual(chains, seen)

        def step(done: np.ndarray) -> tuple[Array, np.ndarray, np.ndarray]:
            found = blocks.newton_step(self.mechanism, chains, -rows[..., None], control, done)
            unstable = blocks.unstable_directions(self.mechanism, chains, found, control)
            # In equilibrium, a platform that moves freely needs no step.
            there = np.zeros(len(rows), dtype=bool)
            there[done] = found.eliminated[done]
            return found.step[..., 0], found.regular | there, np.where(there[done], unstable, -1)

        return rows, step

    def whole(self, unknowns: Array, members: np.ndarray) -> tuple[Array, Array]:
        """Residual (B, N) and its whole matrix (B, N, N), columns by unknowns in their units."""
        part, place = self.take(members), self.place
        chains = lagrangian.all_rows(self.mechanism, unknowns, part.memory, part.drives)
        seen = Readings(self.mechanism, unknowns, part.drives)
        control = seen.control(part.channels)
        matrix = lagrangian.hessian(place, chains) * (place.scale / place.energy)[:, None]
        matrix[:, place.platform] = 0.0
        matrix[:, place.platform, place.platform] = control.by_pose / place.pose_scale
        for x, dual, by in zip(place.coordinates, place.multipliers, control.by_coordinates, strict=True):
            matrix[:, place.platform, dual] = control.by_load / place.load_scale
            if by is not None:
                matrix[:, place.platform, x] = by / place.scale[x]
        return part.residual(chains, seen), matrix

    def residual(self, chains: tuple[ChainRows, ...], seen: Readings) -> Array:
        """Dimensionless residual (B, N) from the chains' rows and what is read there."""
        place = self.place
        rows = lagrangian.gradient(place, chains, seen.unknowns)
        rows *= place.scale / place.energy
        rows[:, place.platform] = (self._controlled(seen) - self.targets) / channel_scale(
            place, self.channels
        )
        return rows


def channel_scale(place: lagrangian.Layout, channels: np.ndarray) -> Array:
    """Size of the readings of the channels (..., 6)."""
    longest = max(12, int(np.max(channels, initial=0)) + 1) - 12
    length = place.pose_scale[0]
    return np.concatenate([place.pose_scale, place.load_scale, np.full(longest, length)])[channels]
