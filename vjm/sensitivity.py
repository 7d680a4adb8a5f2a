"""Derivatives of an equilibrium by its inputs and by any parameter of its mechanism, by implicit differentiation.

An equilibrium solves r(u, targets, p) = 0; with the converged tangent r_u, du/dp = -r_u^-1 r_p. No equilibrium
is solved again. r_p is taken at fixed u by differences of the residual, which is smooth in the data of a mechanism:
of fourth order their error, about the fourth power of the relative step, is at rounding; of second order it is some
1e-6, of first some 1e-3, at a half and a quarter of the cost.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from vjm import blocks, lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.mechanism import Mechanism
from vjm.problem import channel_scale
from vjm.reread import Reread
from vjm.sensors import Sensor

_SCHEMES = {
    1: ((0.0, -1.0), (1.0, 1.0)),
    2: ((-1.0, -0.5), (1.0, 0.5)),
    4: ((-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)),
}
"""Offsets and weights of differences, by their order."""
_STEP = 1e-3
Size = TypeVar("Size", float, Array)


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """Derivatives of an equilibrium; the last axis counts the inputs.

    unknowns: (..., N, k). memory: (..., M, k) of `Equilibrium.next_memory`, zero for targets.
    readings: (..., 12 + G, k) of `Equilibrium.readings`. regular: (...) False at a critical state, where there
    is no derivative and zeros stand.
    """

    state: Equilibrium
    unknowns: Array
    memory: Array
    readings: Array
    regular: np.ndarray

    @property
    def pose(self) -> Array:
        """(..., 6, k) of the platform pose."""
        return self.unknowns[..., lagrangian.layout(self.state.mechanism).platform, :]

    @property
    def load(self) -> Array:
        """(..., 6, k) of the total load."""
        places = lagrangian.layout(self.state.mechanism).multipliers
        return np.sum([self.unknowns[..., place, :] for place in places], axis=0)


def _none(_: float) -> Mapping[str, Array]:
    return {}


@dataclass(frozen=True, eq=False)
class Direction:
    """One parameter p of the mechanism: `build(value)` is the mechanism of the state.

    size: typical size of p; differences reach 2e-3 of it to either side. inputs(value): those
    inputs, by name, that p moves; they broadcast against the batch.
    """

    build: Callable[[float], Mechanism]
    value: float
    size: float
    inputs: Callable[[float], Mapping[str, Array]] = _none

    def moved(self, state: Equilibrium, change: float) -> Equilibrium:
        """The unknowns of the state in what a change of p makes of the mechanism."""
        value = self.value + change
        mechanism = self.build(value)
        place, drives = lagrangian.layout(mechanism), state.drives
        for name, there in self.inputs(value).items():
            number = place.drives.index(name)
            drives = drives if drives is not state.drives else drives.copy()
            drives[..., number] = there - place.defaults[number]
        return replace(state, mechanism=mechanism, drives=drives)


@dataclass(frozen=True, eq=False)
class SensorDirection:
    """One parameter p of the sensors alone: `sensors(value)` are those of the state. size: as of a `Direction`."""

    sensors: Callable[[float], tuple[Sensor, ...]]
    value: float
    size: float

    def moved(self, state: Equilibrium, change: float) -> Equilibrium:
        """The unknowns of the state, read as a change of p has it."""
        return replace(state, mechanism=Reread(state.mechanism, self.sensors(self.value + change)))


@dataclass(frozen=True, eq=False)
class DriveDirection:
    """One input of the mechanism by name."""

    name: str
    size: float

    def moved(self, state: Equilibrium, change: float) -> Equilibrium:
        """The unknowns of the state at a changed input."""
        drives = state.drives.copy()
        drives[..., lagrangian.layout(state.mechanism).drives.index(self.name)] += change
        return replace(state, drives=drives)


@dataclass(frozen=True)
class Target:
    """One of the six targets: the reading that the control of that platform coordinate prescribes."""

    coordinate: int


@dataclass(frozen=True)
class Force:
    """A force on a coordinate, the unknown of this number, that its law holds against it beside its own."""

    number: int


AnyDirection = Direction | SensorDirection | DriveDirection | Target | Force
TARGETS = tuple(Target(k) for k in range(6))


def by_targets(state: Equilibrium) -> Sensitivity:
    """By the six targets."""
    return by_parameters(state, TARGETS)


def by_parameters(
    state: Equilibrium,
    directions: Sequence[AnyDirection],
    target_slope: ArrayLike = 0.0,
    memory_slope: ArrayLike = 0.0,
    order: int = 4,
) -> Sensitivity:
    """By k parameters, inputs or targets at once.

    target_slope: (..., 6, k) derivative of the targets, where they change with them. memory_slope: (..., M, k)
    derivative of the memory at the start of the step, `Sensitivity.memory` of the step before. order: of the
    differences, 1, 2 or 4.
    """
    place, count = lagrangian.layout(state.mechanism), len(directions)
    batch = state.converged.shape
    memory = np.broadcast_to(np.asarray(memory_slope, dtype=float), (*state.memory.shape, count))
    target = np.broadcast_to(np.asarray(target_slope, dtype=float), (*batch, 6, count))
    slope = np.zeros((*state.unknowns.shape, count))
    own = np.zeros((*state.readings.shape, count))
    here = {still: _residual(state, state.memory, place, still) for still in (False, True) if order == 1}
    for k, direction in enumerate(directions):
        if isinstance(direction, Target):
            sides = channel_scale(place, state.channels)[..., direction.coordinate]
            slope[..., place.platform.start + direction.coordinate, k] -= 1.0 / sides
            continue
        if isinstance(direction, Force):
            slope[..., direction.number, k] += place.scale[direction.number] / place.energy
            continue
        still = isinstance(direction, SensorDirection) and not state.memory.shape[-1]
        for step, weight in differences(order, direction.size):
            if not step:
                slope[..., k] += weight * here[still]
                own[..., k] += weight * state.readings
                continue
            moved = direction.moved(state, step)
            slope[..., k] += weight * _residual(moved, _along(state.memory, memory, step, k), place, still)
            own[..., k] += weight * moved.readings
    slope[..., place.platform, :] -= target / channel_scale(place, state.channels)[..., None]
    unknowns, regular = _solve(state, -slope)
    change = _memory_change(state, directions, unknowns, memory, order)
    return Sensitivity(state, unknowns, change, own + read_change(state, unknowns), regular)


def _residual(state: Equilibrium, memory: Array, place: lagrangian.Layout, still: bool = False) -> Array:
    """Dimensionless residual (..., N) with zero targets, in the scales of `place`; still: of the chains, which do not
    change, zeros."""
    rows = np.zeros(state.unknowns.shape)
    if not still:
        chains = lagrangian.all_rows(state.mechanism, state.unknowns, memory, state.drives, second=False)
        rows = lagrangian.gradient(place, chains, state.unknowns) * place.scale / place.energy
    values = np.take_along_axis(state.readings, state.channels, axis=-1)
    rows[..., place.platform] = values / channel_scale(place, state.channels)
    return np.asarray(rows)


def read_change(state: Equilibrium, unknowns: Array) -> Array:
    """Change (..., 12 + G, k) of the readings along k changes (..., N, k) of the unknowns."""
    return state.seen.change(unknowns)


def _solve(state: Equilibrium, right: Array) -> tuple[Array, np.ndarray]:
    """Solutions in the units of the unknowns of the dimensionless right sides (..., N, k)."""
    place = lagrangian.layout(state.mechanism)
    flat = state.reshaped(state.converged.size)
    sides = right.reshape(len(flat.unknowns), place.size, right.shape[-1])
    unknowns, regular = np.empty(sides.shape), np.empty(len(sides), dtype=bool)
    for first in range(0, len(sides), place.several):
        part = slice(first, first + place.several)
        here = flat.member(part)
        chains = lagrangian.all_rows(state.mechanism, here.unknowns, here.memory, here.drives)
        control = here.seen.control(here.channels)
        found = blocks.newton_step(state.mechanism, chains, sides[part], control)
        unknowns[part], regular[part] = found.step * place.scale[:, None], found.regular
    return unknowns.reshape(right.shape), regular.reshape(state.converged.shape)


def differences(order: int, size: Size) -> list[tuple[Size, Size]]:
    """Changes of parameters of these typical sizes, and their weights in the derivatives."""
    step = _STEP * size
    return [(offset * step, weight / step) for offset, weight in _SCHEMES[order]]


def _memory_change(
    state: Equilibrium, directions: Sequence[AnyDirection], unknowns: Array, memory: Array, order: int
) -> Array:
    """Derivative (..., M, k) of the memory after the step along the changes of unknowns and memory.

    What a target or a force leaves in the memory is not followed: it belongs to its own step.
    """
    if not memory.shape[-2]:
        return np.zeros(memory.shape)
    # Each direction in one piece: memories are long, and a sum into every k-th number takes several times as long.
    out = np.zeros((memory.shape[-1], *memory.shape[:-1]))
    for k, direction in enumerate(directions):
        if isinstance(direction, Target | Force):
            continue
        for step, weight in differences(order, direction.size):
            moved = replace(
                direction.moved(state, step),
                unknowns=state.unknowns + step * unknowns[..., k],
                memory=_along(state.memory, memory, step, k),
            )
            out[k] += weight * moved.next_memory
    return np.moveaxis(out, 0, -1)


def _along(memory: Array, slope: Array, step: float, number: int) -> Array:
    """Memory (..., M) moved by a step along one of its slopes (..., M, k); the same where one zero stands for all."""
    none = not any(slope.strides) and slope.size and slope.flat[0] == 0.0
    return memory if none else memory + step * slope[..., number]
