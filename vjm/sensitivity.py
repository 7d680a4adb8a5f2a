"""Derivatives of an equilibrium by its inputs and by any parameter of its chains, by implicit differentiation.

An equilibrium solves r(u, targets, p) = 0; with the converged tangent r_u, du/dp = -r_u^-1 r_p. No equilibrium
is solved again. r_p is taken at fixed u by central differences of fourth order of the residual, which is
smooth in the data of a chain; its error, about the fourth power of the relative step, is at rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.mechanism import Mechanism

_OFFSETS = np.array([-2.0, -1.0, 1.0, 2.0])
_WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """Derivatives of an equilibrium; the last axis counts the inputs.

    unknowns: (..., N, k). memory: (..., M, k) of `Equilibrium.next_memory`. regular: (...) False at a critical
    state, where there is no derivative and zeros stand.
    """

    state: Equilibrium
    unknowns: Array
    memory: Array
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

    def reading(self, gauge: Gauge) -> Array:
        """(..., k) of a gauge whose own data do not change."""
        return np.einsum("...n,...nk->...k", gauge.gradient(self.state), self.unknowns)


def by_targets(state: Equilibrium) -> Sensitivity:
    """By the six targets: pose where a coordinate is held, load where it is free."""
    place = lagrangian.layout(state.mechanism)
    right = np.zeros((*state.unknowns.shape, 6))
    pose_scale = place.scale[place.platform]
    unit = np.where(state.held, 1.0 / pose_scale, pose_scale / place.energy)
    right[..., place.platform, :] = unit[..., None] * np.eye(6)
    unknowns, regular = _solve(state, right)
    memory = np.zeros((*state.memory.shape, 6))
    if state.memory.shape[-1]:
        memory = _memory_change(state, lambda _: state.mechanism, 0.0, unknowns, memory, np.ones(6))
    return Sensitivity(state, unknowns, memory, regular)


def by_parameter(
    state: Equilibrium,
    build: Callable[[float], Mechanism],
    value: float,
    size: float,
    target_slope: ArrayLike = 0.0,
    memory_slope: ArrayLike = 0.0,
) -> Sensitivity:
    """By one parameter p of the mechanism, `build(value)` being the mechanism of the state.

    size: typical size of p; differences reach 2e-3 of it to either side. target_slope: (..., 6) derivative of
    the targets, where they change with p. memory_slope: (..., M) derivative of the memory at the start of the
    step, `Sensitivity.memory` of the step before.
    """
    place = lagrangian.layout(state.mechanism)
    target = np.broadcast_to(np.asarray(target_slope, dtype=float), (*state.unknowns.shape[:-1], 6))
    memory = np.broadcast_to(np.asarray(memory_slope, dtype=float), state.memory.shape)
    slope = np.zeros_like(state.unknowns)
    for offset, weight in zip(_OFFSETS, _WEIGHTS, strict=True):
        step = 1e-3 * size * offset
        chains = lagrangian.all_rows(build(value + step), state.unknowns, state.memory + step * memory)
        # The platform's own row does not know the mechanism.
        rows = lagrangian.gradient(place, chains, state.unknowns, 0.0)
        slope += weight / (1e-3 * size) * rows
    right = -slope * place.scale / place.energy
    pose_scale = place.scale[place.platform]
    right[..., place.platform] = target * np.where(state.held, 1 / pose_scale, pose_scale / place.energy)
    unknowns, regular = _solve(state, right[..., None])
    change = _memory_change(state, build, value, unknowns, memory[..., None], np.array([size]))
    return Sensitivity(state, unknowns, change, regular)


def reading_by_parameter(
    sensitivity: Sensitivity, gauge: Callable[[float], Gauge], value: float, size: float
) -> Array:
    """(...) derivative of a gauge by a parameter that moves the gauge itself too, `gauge(value)` built anew."""
    readings = [gauge(value + 1e-3 * size * offset).reading(sensitivity.state) for offset in _OFFSETS]
    own = np.tensordot(_WEIGHTS, np.stack(readings), axes=1) / (1e-3 * size)
    return np.asarray(own + sensitivity.reading(gauge(value))[..., 0])


def _solve(state: Equilibrium, right: Array) -> tuple[Array, np.ndarray]:
    """Solutions in the units of the unknowns of the dimensionless right sides (..., N, k)."""
    place = lagrangian.layout(state.mechanism)
    flat = state.reshaped(state.converged.size)
    chains = lagrangian.all_rows(state.mechanism, flat.unknowns, flat.memory)
    sides = right.reshape(len(flat.unknowns), place.size, right.shape[-1])
    found = lagrangian.newton_step(place, chains, sides, flat.held)
    unknowns = (found.step * place.scale[:, None]).reshape(right.shape)
    return unknowns, found.regular.reshape(state.converged.shape)


def _memory_change(
    state: Equilibrium,
    build: Callable[[float], Mechanism],
    value: float,
    unknowns: Array,
    memory: Array,
    sizes: Array,
) -> Array:
    """Derivative (..., M, k) of the memory after the step along the changes of unknowns and memory."""
    out = np.zeros(memory.shape)
    if not memory.shape[-2]:
        return out
    for k, size in enumerate(sizes):
        for offset, weight in zip(_OFFSETS, _WEIGHTS, strict=True):
            step = 1e-3 * size * offset
            moved = replace(
                state,
                mechanism=build(value + step),
                unknowns=state.unknowns + step * unknowns[..., k],
                memory=state.memory + step * memory[..., k],
            )
            out[..., k] += weight / (1e-3 * size) * moved.next_memory
    return out
