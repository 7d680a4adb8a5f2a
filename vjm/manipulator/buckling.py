"""The load that makes a leg of a manipulator buckle.

A bar without segments (`ElasticLink.segments`, `Parallelogram.segments`) has no geometric stiffness of its own:
where its 6x6 is lumped decides what is found, as for the single parallelogram.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.manipulator.equilibrium import Loaded, bordered_tangent, equilibrium
from vjm.manipulator.lagrangian import System, gradient_and_hessian
from vjm.problem import held_mask

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
    state: Loaded
    linear: float
    reason: str


@dataclass(frozen=True, eq=False)
class _Point:
    """A state on the path, its factor, and the lowest eigenvalue of its tangent; -1 where it is no stable one."""

    factor: float
    lowest: float
    state: Loaded


def critical_load(of: System, load: ArrayLike, largest: float = np.inf) -> Critical:
    """Follow the equilibrium of one posture under factor x load (6,), up to the factor `largest`.

    Steps follow the linear estimate until the lowest eigenvalue of the tangent has lost half of its value; from there
    on they go nine tenths of the way to where it would vanish, so that the path is never overrun: beyond, another
    stable one may lie near. A sharp critical load is found to 1e-8. ValueError for more than one posture, or no bound
    while the linear estimate finds none.
    """
    if len(of.pose) != 1:
        raise ValueError(f"the critical load of one posture at a time, got {len(of.pose)}")
    unit = np.asarray(load, dtype=float)
    estimate = linear_factor(of, unit)
    end = min(largest, 4.0 * estimate)
    if not np.isfinite(end):
        raise ValueError("nothing buckles to first order: give the largest factor to search")
    first = here = _point(of, unit, 0.0, None)
    before, step = here, min(estimate, end) / _STEPS
    while here.factor < end:
        falling = here.lowest < _FALLING * first.lowest
        if falling:
            zero = here.factor - here.lowest * (here.factor - before.factor) / (here.lowest - before.lowest)
            if zero - here.factor < _ACCURACY * zero:
                return _record(of, here, first, zero, True, estimate)
            step = min(step, _SHARE * (zero - here.factor))
        following = _point(of, unit, min(here.factor + step, end), here.state)
        if following.lowest > 0.0 and (following.lowest < here.lowest or not falling):
            before, here = here, following
        else:
            step *= 0.5
            if step < _ACCURACY * end:
                return _record(of, here, first, here.factor, following.lowest < 0.0, estimate)
    reason = f"stable up to {here.factor:.6g} of the load"
    return Critical(False, np.nan, False, here.lowest / first.lowest, -1, here.state, estimate, reason)


def _point(of: System, unit: Array, factor: float, start: Loaded | None) -> _Point:
    state = equilibrium(of, factor * unit, start=start, increments=False)
    if not state.converged[0]:
        return _Point(factor, -1.0, state)
    lowest = float(reduced_modes(state)[0][0])
    return _Point(factor, lowest if lowest > 0.0 else -1.0, state)


def reduced_modes(state: Loaded) -> tuple[Array, Array]:
    """Eigenvalues (r,), ascending and dimensionless, of the tangent of one state on the motions that keep all loops
    closed, and these motions (moving, r), platform free."""
    of = state.system
    tangent = bordered_tangent(state)[0]
    closing = of.multipliers
    closures = tangent[np.ix_(closing, ~closing)]
    basis = np.linalg.svd(closures)[2][of.closures :].T
    values, vectors = np.linalg.eigh(basis.T @ tangent[np.ix_(~closing, ~closing)] @ basis)
    return values, basis @ vectors


def _record(of: System, here: _Point, first: _Point, factor: float, sharp: bool, estimate: float) -> Critical:
    mode = np.zeros(of.size)
    mode[~of.multipliers] = reduced_modes(here.state)[1][:, 0]
    leg = int(np.argmax([float(np.linalg.norm(mode[x])) for x in of.coordinates]))
    how = "loses stability" if sharp else "gives way smoothly"
    reason = f"leg {of.legs[leg].leg.name} {how} at {factor:.6g} of the load"
    return Critical(True, factor, sharp, here.lowest / first.lowest, leg, here.state, estimate, reason)


def linear_factor(of: System, load: ArrayLike, held: Collection[str] = ()) -> float:
    """Lowest positive factor at which the tangent, linear along the unloaded path, is singular; inf if there is none.

    load: (6,) of free coordinates, displacement from the unloaded pose of held ones. Classic linear buckling with the
    change of geometry of first order included: det(B + factor dB) = 0 of the bordered tangent.
    """
    mask = held_mask(held)
    rest, way = of.at_rest(), linear_path(of, np.asarray(load, dtype=float), mask)
    share = _MOTION / np.max(np.abs(way / of.scale)[:, ~of.multipliers], initial=1e-300)
    free = np.setdiff1d(np.arange(of.size), np.arange(of.size)[of.platform][mask])
    scaled = of.scale[:, None] * of.scale / of.energy

    def tangent(factor: float) -> Array:
        _, hessian = gradient_and_hessian(of, rest + factor * way)
        return np.asarray((hessian[0] * scaled)[np.ix_(free, free)])

    slope = (tangent(share) - tangent(-share)) / (2.0 * share)
    values = -np.linalg.eigvals(np.linalg.solve(tangent(0.0), slope))
    real = np.abs(values.imag) <= _REAL * np.abs(values)
    largest = float(np.max(values.real[real], initial=0.0))
    return 1.0 / largest if largest > 0.0 else np.inf


def linear_path(of: System, target: Array, mask: np.ndarray) -> Array:
    """(1, size) first-order change of the unknowns under loads, or displacements where the mask (6,) holds."""
    _, hessian = gradient_and_hessian(of, of.at_rest())
    matrix = hessian[0] * of.scale[:, None] * (of.scale / of.energy)
    right = np.zeros(of.size)
    pose = np.arange(of.size)[of.platform]
    pose_scale = of.scale[pose]
    right[pose] = np.where(mask, target / pose_scale, target * pose_scale / of.energy)
    matrix[pose[mask]] = 0.0
    matrix[pose[mask], pose[mask]] = 1.0
    return np.asarray(np.linalg.solve(matrix, right) * of.scale)[None]
