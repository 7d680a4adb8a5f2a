"""Post-critical equilibrium path: switch to the buckled branch at a critical load and follow it in x."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from vjm import lagrangian
from vjm.critical import CriticalLoad, drive, driven
from vjm.equilibrium import ITERATIONS, TOLERANCE, Equilibrium, record, stack
from vjm.frames import Array
from vjm.newton import Step, dense, newton
from vjm.problem import Problem, channel_numbers, held_mask

FELL_BACK = "returned to the primary path: the branch does not reach this displacement"
JUMPED = "jumped away from the branch that was followed"
_SUBDIVISIONS = 6


def buckled_path(
    critical: CriticalLoad, displacements: Sequence[float] | Array, amplitude: float = 0.01
) -> Equilibrium:
    """Equilibria (steps, ...) on the branch that leaves the primary path at a critical load.

    displacements: of the platform along x, mm, in the order to follow, away from the critical one.
    amplitude: dimensionless first step along the buckling direction, 0.01 rad or 0.01 of the length. That
    step is taken with the amplitude given and x free, which picks the branch whichever way it bends. Near the
    bifurcation amplitudes grow as the root of the travel past it, and each prediction uses that; a step whose
    solution lies far from its prediction is halved.
    A displacement that the branch does not reach comes back with `converged` False and a reason.
    ValueError for a critical load that was not found.
    """
    if critical.direction is None:
        raise ValueError(f"there is no branch to follow: {critical.reason}")
    state = _switch(critical, critical.direction, amplitude)
    states = []
    for displacement in displacements:
        following = _follow(critical, state, float(displacement), _SUBDIVISIONS)
        if following.converged:
            state = following
        states.append(following)
    return stack(states)


def branch_amplitude(critical: CriticalLoad, unknowns: Array) -> float:
    """Dimensionless distance of unknowns (N,) from the critical state along the buckling direction."""
    if critical.direction is None:
        raise ValueError(f"there is no buckling direction: {critical.reason}")
    scale = lagrangian.layout(critical.state.mechanism).scale
    return float(np.dot(critical.direction / scale, (unknowns - critical.state.unknowns) / scale))


def _switch(critical: CriticalLoad, direction: Array, amplitude: float) -> Equilibrium:
    """The equilibrium at a given amplitude of the buckling direction, x being unknown."""
    mechanism = critical.state.mechanism
    place = lagrangian.layout(mechanism)
    mask = held_mask(critical.held)
    targets = np.where(mask, driven(mechanism, critical.displacement), 0.0)[None]
    numbers = channel_numbers(critical.held)[None]
    state = critical.state
    problem = Problem(mechanism, targets, numbers, state.memory[None], state.drives[None])
    row = place.platform.start
    weight = direction / place.scale**2

    def system(unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
        rows, matrix = problem.whole(unknowns, members)
        rows[:, row] = (unknowns - critical.state.unknowns) @ weight - amplitude
        matrix[:, row] = weight
        return rows, dense(rows, matrix, place.scale)

    first = critical.state.unknowns + amplitude * direction
    end = newton(system, first[None], place.scale, TOLERANCE, ITERATIONS)
    return _if_near(record(problem, end, (1,)).member(0), first, amplitude)


def _follow(critical: CriticalLoad, state: Equilibrium, displacement: float, halvings: int) -> Equilibrium:
    """The branch at a displacement, started from another state of it."""
    if not state.converged:
        return state
    amplitude = branch_amplitude(critical, state.unknowns)
    travelled = state.pose[0] - critical.state.pose[0]
    ratio = (displacement - critical.displacement) / travelled
    growth = np.sqrt(ratio) - 1.0 if ratio > 0 else 0.0
    guess = state.unknowns + growth * amplitude * np.asarray(critical.direction)
    following = drive(state.mechanism, displacement, critical.held, replace(state, unknowns=guess))
    if following.converged and abs(branch_amplitude(critical, following.unknowns)) < 1e-6:
        return replace(following, converged=np.array(False), reason=np.array(FELL_BACK, dtype=object))
    following = _if_near(following, guess, (1.0 + growth) * amplitude)
    if following.converged or halvings == 0:
        return following
    middle = critical.displacement + 0.5 * (displacement - critical.displacement + travelled)
    state = _follow(critical, state, middle, halvings - 1)
    return _follow(critical, state, displacement, halvings - 1)


def _if_near(state: Equilibrium, guess: Array, amplitude: float) -> Equilibrium:
    """The state, marked as failed if it lies further from the prediction than half the amplitude."""
    place = lagrangian.layout(state.mechanism)
    motion = slice(0, place.platform.stop)
    distance = np.linalg.norm(((state.unknowns - guess) / place.scale)[motion])
    if distance <= 0.5 * abs(amplitude) or not state.converged:
        return state
    return replace(state, converged=np.array(False), reason=np.array(JUMPED, dtype=object))
