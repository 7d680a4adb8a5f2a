"""The load that makes a leg of a manipulator buckle.

A bar without segments (`ElasticLink.segments`, `Parallelogram.segments`) has no geometric stiffness of its own:
where its 6x6 is lumped decides what is found, as for the single parallelogram.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.equilibrium import Equilibrium, nearby
from vjm.frames import Array
from vjm.problem import held_mask
from vjm.stability import reduced_modes, scaled_hessian

# Of the length, or rad: what the linear path moves in the difference that gives the slope of its tangent.
_MOTION = 1e-6
# Eigenvalues of the pencil are real where they are buckling loads; rounding leaves this share.
_REAL = 1e-6
_ACCURACY = 1e-8
_STEPS = 8
_FALLING, _SHARE = 0.5, 0.9


@dataclass(frozen=True, eq=False)
class Critical:
    """Where the equilibrium path under a growing load loses its stiffness, or the news that it does not.

    found: whether it does up to the largest factor searched. factor: of the load; nan if not found. sharp: whether the
    tangent becomes singular there; else the leg gives way smoothly, as a column with an imperfection does, and the
    factor is that of its least stiffness. left: lowest eigenvalue of the last state over that at rest. leg: number of
    the leg that moves most in that direction, -1 if not found. state: the last stable equilibrium before. linear:
    factor by the slope of the tangent at rest; inf if there is none. reason: a sentence.
    """

    found: bool
    factor: float
    sharp: bool
    left: float
    leg: int
    state: Equilibrium
    linear: float
    reason: str


@dataclass(frozen=True, eq=False)
class _Point:
    """A state on the path, its factor, and the lowest eigenvalue of its tangent; -1 where it is no stable one."""

    factor: float
    lowest: float
    state: Equilibrium


def critical_load(start: Equilibrium, load: ArrayLike, largest: float = np.inf) -> Critical:
    """Follow the equilibrium of a machine under factor x load (6,) from its state without load, no batch axes, up to
    the factor `largest`.

    Steps follow the linear estimate until the lowest eigenvalue of the tangent has lost half of its value; from there
    on they go nine tenths of the way to where it would vanish, so that the path is never overrun: beyond, another
    stable one may lie near. A sharp critical load is found to 1e-8. ValueError for more than one posture, or no bound
    while the linear estimate finds none.
    """
    if start.converged.ndim:
        raise ValueError(f"the critical load of one posture at a time, got {start.converged.shape}")
    unit = np.asarray(load, dtype=float)
    estimate = linear_factor(start, unit)
    end = min(largest, 4.0 * estimate)
    if not np.isfinite(end):
        raise ValueError("nothing buckles to first order: give the largest factor to search")
    first = here = _point(unit, 0.0, start)
    before, step = here, min(estimate, end) / _STEPS
    while here.factor < end:
        falling = here.lowest < _FALLING * first.lowest
        if falling:
            zero = here.factor - here.lowest * (here.factor - before.factor) / (here.lowest - before.lowest)
            if zero - here.factor < _ACCURACY * zero:
                return _record(here, first, zero, True, estimate)
            step = min(step, _SHARE * (zero - here.factor))
        following = _point(unit, min(here.factor + step, end), here.state)
        if following.lowest > 0.0 and (following.lowest < here.lowest or not falling):
            before, here = here, following
        else:
            step *= 0.5
            if step < _ACCURACY * end:
                return _record(here, first, here.factor, following.lowest < 0.0, estimate)
    reason = f"stable up to {here.factor:.6g} of the load"
    return Critical(False, np.nan, False, here.lowest / first.lowest, -1, here.state, estimate, reason)


def _point(unit: Array, factor: float, start: Equilibrium) -> _Point:
    state = _beside(start, factor * unit)
    if not state.converged:
        return _Point(factor, -1.0, state)
    lowest = float(reduced_modes(state, ()).values[0])
    return _Point(factor, lowest if lowest > 0.0 else -1.0, state)


def _beside(start: Equilibrium, load: Array) -> Equilibrium:
    """The equilibrium under a load on the branch of the start, by Newton's method alone."""
    names, defaults = (getattr(lagrangian.layout(start.mechanism), name) for name in ("drives", "defaults"))
    drives = {name: start.drives[k] + defaults[k] for k, name in enumerate(names)}
    return nearby(start.mechanism, load, (), start, drives, start.memory)


def _record(here: _Point, first: _Point, factor: float, sharp: bool, estimate: float) -> Critical:
    mechanism = here.state.mechanism
    mode = reduced_modes(here.state, ()).vectors[:, 0] / lagrangian.layout(mechanism).scale
    leg = int(np.argmax([float(np.linalg.norm(mode[x])) for x in lagrangian.layout(mechanism).coordinates]))
    how = "loses stability" if sharp else "gives way smoothly"
    reason = f"leg {mechanism.chains[leg].name} {how} at {factor:.6g} of the load"
    return Critical(True, factor, sharp, here.lowest / first.lowest, leg, here.state, estimate, reason)


def linear_factor(start: Equilibrium, load: ArrayLike, held: Collection[str] = ()) -> float:
    """Lowest positive factor at which the tangent, linear along the unloaded path, is singular; inf if there is none.

    start: the state without load, no batch axes. load: (6,) of free coordinates, displacement from the unloaded pose of
    held ones. Classic linear buckling with the change of geometry of first order included: det(B + factor dB) = 0 of
    the bordered tangent.
    """
    mask, place = held_mask(held), lagrangian.layout(start.mechanism)
    way = linear_path(start, np.asarray(load, dtype=float), mask)
    motion = slice(place.platform.stop)
    share = _MOTION / np.max(np.abs(way / place.scale)[motion], initial=1e-300)
    free = np.setdiff1d(np.arange(place.size), np.arange(place.size)[place.platform][mask])

    def tangent(factor: float) -> Array:
        moved = replace(start, unknowns=start.unknowns + factor * way)
        return np.asarray(scaled_hessian(moved)[np.ix_(free, free)])

    slope = (tangent(share) - tangent(-share)) / (2.0 * share)
    values = -np.linalg.eigvals(np.linalg.solve(tangent(0.0), slope))
    real = np.abs(values.imag) <= _REAL * np.abs(values)
    largest = float(np.max(values.real[real], initial=0.0))
    return 1.0 / largest if largest > 0.0 else np.inf


def linear_path(start: Equilibrium, target: Array, mask: np.ndarray) -> Array:
    """(N,) first-order change of the unknowns of the state without load under loads, or displacements where the mask
    (6,) holds."""
    place = lagrangian.layout(start.mechanism)
    matrix, right = scaled_hessian(start).copy(), np.zeros(place.size)
    pose = np.arange(place.size)[place.platform]
    right[pose] = np.where(mask, target / place.pose_scale, target / place.load_scale)
    matrix[pose[mask]] = 0.0
    matrix[pose[mask], pose[mask]] = 1.0
    return np.asarray(np.linalg.solve(matrix, right) * place.scale)
