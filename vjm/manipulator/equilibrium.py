"""Loaded equilibrium of a manipulator at many postures or under many loads at once."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array, moment
from vjm.increments import FIRST_STEP, LARGEST_STEP, LEAST_STEP, MANY
from vjm.manipulator.lagrangian import System, gradient_and_hessian
from vjm.manipulator.loops import LoopedLeg
from vjm.newton import CONVERGED, Step, dense, newton
from vjm.problem import held_mask
from vjm.reasons import Reason
from vjm.sensors import Channels, through

TOLERANCE = 1e-12
ITERATIONS = 40
TRIES = 48
"""Of one member; what creeps at the least step is lost."""
SOON = 8
"""Iterations of a step that may be halved still; more are of use to the least one alone."""


@dataclass(frozen=True, eq=False)
class Loaded:
    """Equilibria of a manipulator, one for each member (B,) of its system.

    unknowns (B, size). iterations (B,). residual (B,), dimensionless. converged (B,) of bool; reason (B,) of
    strings; where not converged the state is none of the equilibrium asked for.
    """

    system: System
    unknowns: Array
    iterations: np.ndarray
    residual: Array
    converged: np.ndarray
    reason: np.ndarray

    @property
    def pose(self) -> Array:
        """(B, 6) of the platform."""
        return self.unknowns[:, self.system.platform]

    @property
    def loads(self) -> Array:
        """(B, legs, 6) load that each leg takes, conjugate to (p, rotation vector)."""
        legs = range(len(self.system.legs))
        return np.stack([self.unknowns[:, self.system.multiplier(k)] for k in legs], axis=1)

    @property
    def strains(self) -> tuple[tuple[LoopedLeg, Array, slice], ...]:
        """Each leg with its coordinates (B, n) from rest and the place of its moving ones."""
        of = self.system
        parts = enumerate(zip(of.legs, of.rest, of.coordinates, strict=True))
        return tuple((leg, of.full(k, self.unknowns) - start, at) for k, (leg, start, at) in parts)

    @property
    def readings(self) -> Array:
        """(B, 12) pose and load as the manipulator's sensors read them; without any, the load is that of `loads`."""
        return channels(self.system, self.unknowns).values

    @property
    def wrench(self) -> Array:
        """(B, 6) on the platform at its point, base frame; moments are true moments."""
        load = self.loads.sum(1)
        return np.concatenate([load[:, :3], moment(self.pose[:, 3:], load[:, 3:])], axis=-1)


def equilibrium(
    system: System,
    targets: ArrayLike,
    held: Collection[str] = (),
    start: Loaded | None = None,
    tolerance: float = TOLERANCE,
    limit: int = ITERATIONS,
    increments: bool = True,
) -> Loaded:
    """Newton's method on the stationarity of L.

    targets: (6,) or (B, 6): pose of a held platform coordinate (mm, rad), load on a free one (N, N·mm, conjugate to
    the rotation vector), each as the manipulator's sensors read it. held: names of the held ones. start: state to
    begin from, default unloaded.
    increments: approach a target that is not met at once in steps from the start, halved where they fail and doubled
    where they do not. ValueError for targets that are not finite or have another last axis.
    """
    wanted = np.asarray(targets, dtype=float)
    if wanted.ndim == 0 or wanted.shape[-1] != 6 or not np.all(np.isfinite(wanted)):
        raise ValueError(f"targets must be finite, six numbers on the last axis, got shape {wanted.shape}")
    wanted = np.broadcast_to(wanted, (len(system.pose), 6))
    mask = held_mask(held)
    first = system.at_rest() if start is None else start.unknowns
    end = _solve(system, wanted, mask, first, tolerance, limit)
    if not increments:
        return end
    doubtful = ~end.converged
    if any(past.shape[-1] for past in system.memory):
        # Friction has several states of balance: which one a long way of Newton's method ends at is chance.
        doubtful |= end.iterations > MANY
    members = np.flatnonzero(doubtful)
    if members.size:
        slow = _in_increments(system.take(members), wanted[members], mask, first[members], tolerance, limit)
        better = slow.converged | ~end.converged[members]
        _put(end, members[better], slow, better)
    return end


def _in_increments(
    of: System, wanted: Array, mask: np.ndarray, first: Array, tolerance: float, limit: int
) -> Loaded:
    """Targets approached from those at `first`; a member that fails has the reason of its last increment."""
    before = _prescribed(of, first, mask)
    count = len(first)
    end = Loaded(
        of,
        first.copy(),
        np.zeros(count, dtype=int),
        np.full(count, np.inf),
        np.zeros(count, dtype=bool),
        np.full(count, "", dtype=object),
    )
    reached, step, last = np.zeros(count), np.full(count, FIRST_STEP), first.copy()
    active = np.arange(count)
    for _ in range(TRIES):
        if not active.size:
            break
        share = np.minimum(reached[active] + step[active], 1.0)
        aim = before[active] + share[:, None] * (wanted[active] - before[active])
        most = limit if np.any(step[active] < 2.0 * LEAST_STEP) else min(limit, SOON)
        part = _solve(of.take(active), aim, mask, last[active], tolerance, most)
        good, there = part.converged.copy(), active[part.converged]
        last[there], reached[there] = part.unknowns[good], share[good]
        # An increment that got there is no equilibrium under the whole target.
        part.converged[:] = good & (share == 1.0)
        _put(end, active, part)
        step[active] = np.where(good, np.minimum(2.0 * step[active], LARGEST_STEP), 0.5 * step[active])
        active = active[(step[active] >= LEAST_STEP) & (reached[active] < 1.0)]
    end.reason[active] = str(Reason.NOT_CONVERGED)
    return end


def _put(end: Loaded, members: np.ndarray, other: Loaded, which: np.ndarray | slice = slice(None)) -> None:
    """Replaces these members by those of another solution, or by some of its."""
    for name in ("unknowns", "iterations", "residual", "converged", "reason"):
        getattr(end, name)[members] = getattr(other, name)[which]


def channels(of: System, u: Array) -> Channels:
    """Pose and load (B, 12) as read, with their derivative (B, 12, 12) by true pose and load, at u (B, size)."""
    load = np.sum([u[:, of.multiplier(k)] for k in range(len(of.legs))], axis=0)
    return through(of.manipulator.sensors, np.concatenate([u[:, of.platform], load], axis=-1))


def _prescribed(of: System, u: Array, mask: np.ndarray) -> Array:
    return channels(of, u).values[:, _numbers(mask)]


def _numbers(mask: np.ndarray) -> np.ndarray:
    """(6,) reading that each coordinate's control prescribes."""
    return np.arange(6) + np.where(mask, 0, 6)


def control_rows(of: System, u: Array, mask: np.ndarray) -> tuple[Array, Array, Array]:
    """Dimensionless stationarity of L (B, size), its derivative (B, size, size) by the unknowns, and the unit (6,) of
    a target; the platform's rows are those of its control: the readings, from which the targets are to be taken."""
    pose = of.platform
    pose_scale = of.scale[pose]
    unit = np.where(mask, 1.0 / pose_scale, pose_scale / of.energy)
    gradient, hessian = gradient_and_hessian(of, u)
    gradient *= of.scale / of.energy
    hessian *= (of.scale / of.energy)[:, None]
    read = channels(of, u)
    gradient[:, pose] = read.values[:, _numbers(mask)] * unit
    slope = read.slope[:, _numbers(mask)] * unit[:, None]
    hessian[:, pose] = 0.0
    hessian[:, pose, pose] = slope[..., :6]
    for k in range(len(of.legs)):
        hessian[:, pose, of.multiplier(k)] = slope[..., 6:]
    return gradient, hessian, unit


def _solve(of: System, wanted: Array, mask: np.ndarray, first: Array, tolerance: float, limit: int) -> Loaded:
    def rows_and_step(u: Array, members: np.ndarray) -> tuple[Array, Step]:
        gradient, hessian, unit = control_rows(of.take(members), u, mask)
        gradient[:, of.platform] -= wanted[members] * unit
        return gradient, dense(gradient, hessian, of.scale)

    motion = np.flatnonzero(~of.multipliers)
    end = newton(rows_and_step, first, of.scale, tolerance, limit, motion)
    done = np.asarray(end.reason == CONVERGED)
    return Loaded(of, end.unknowns, end.iterations, end.residual, done, end.reason)


def bordered_tangent(state: Loaded, held: Collection[str] = ()) -> Array:
    """Symmetric dimensionless Hessian (B, M, M) of L without the held platform coordinates."""
    of = state.system
    _, hessian = gradient_and_hessian(of, state.unknowns)
    free = np.setdiff1d(np.arange(of.size), np.arange(of.size)[of.platform][held_mask(held)])
    scaled = hessian * of.scale[:, None] * (of.scale / of.energy)
    return np.asarray(scaled[:, free[:, None], free])


def unstable_directions(state: Loaded, held: Collection[str] = ()) -> np.ndarray:
    """Number (B,) of unstable directions: negative eigenvalues of the bordered tangent beyond one per closure."""
    values = np.linalg.eigvalsh(bordered_tangent(state, held))
    return np.asarray(np.sum(values < 0.0, axis=-1) - state.system.closures)


def loaded_stiffness(state: Loaded) -> Array:
    """(B, 6, 6) at the platform point, base frame, conjugate to the rotation vector (Eq. 10 with closed loops).

    numpy.linalg.LinAlgError in a critical state with the platform held.
    """
    of = state.system
    _, hessian = gradient_and_hessian(of, state.unknowns)
    scaled = hessian * of.scale[:, None] * (of.scale / of.energy)
    pose = np.arange(of.size)[of.platform]
    inner = np.setdiff1d(np.arange(of.size), pose)
    mixed = scaled[:, inner[:, None], pose]
    # L is stationary in all but the pose, so its second derivative along the pose is the Schur complement.
    k = -np.swapaxes(mixed, -1, -2) @ np.linalg.solve(scaled[:, inner[:, None], inner], mixed)
    k = k * of.energy / of.scale[pose][:, None] / of.scale[pose]
    return np.asarray(0.5 * (k + np.swapaxes(k, -1, -2)))


def read_stiffness(state: Loaded) -> Array:
    """(B, 6, 6) change of the load read with the pose read: `loaded_stiffness` seen through the sensors."""
    slope = channels(state.system, state.unknowns).slope
    k = loaded_stiffness(state)
    pose = slope[..., :6, :6] + slope[..., :6, 6:] @ k
    load = slope[..., 6:, :6] + slope[..., 6:, 6:] @ k
    return np.asarray(
        np.swapaxes(np.linalg.solve(np.swapaxes(pose, -1, -2), np.swapaxes(load, -1, -2)), -1, -2)
    )
