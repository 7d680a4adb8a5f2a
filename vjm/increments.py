"""The solution strategy of a batch: bounded chunks, Newton's method at once, increments where that fails."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from vjm.frames import Array
from vjm.newton import CONVERGED, RUNNING, SMALL_STEP, Iterate, newton, unsolved
from vjm.problem import Problem
from vjm.reasons import Reason

FIRST_STEP, LARGEST_STEP, LEAST_STEP = 1.0 / 16.0, 1.0 / 4.0, 1.0 / 128.0
# Increments of one load case. Of 30 benches none needs more than 12; one that creeps at the least step is lost.
_TRIES = 48
_SOON = 8
# Beyond a quarter of the first step, or this many iterations, there may be other solutions as near.
_FAR, MANY = 0.25, 6
LOST_STABILITY = str(Reason.UNSTABLE)
UNSURE = "unstable, or found after wandering"


@dataclass(frozen=True, eq=False)
class Start:
    """Where load cases begin.

    unknowns: (B, N), an equilibrium at the inputs `drives` (B, D). astray: (B,) those whose start is one that was
    looked for in this way and not found, or unstable: one short step on the way tells whether it goes on now.
    """

    unknowns: Array
    drives: Array
    astray: np.ndarray

    def take(self, members: np.ndarray) -> Start:
        """Of these load cases."""
        return Start(self.unknowns[members], self.drives[members], self.astray[members])


def solve(problem: Problem, begin: Start, tolerance: float, limit: int, follow: bool) -> Iterate:
    """Equilibria of all load cases, each begun at its start.

    A load case that Newton's method does not reach from its start is approached in increments of all its
    targets, halved where they fail and doubled where they do not. If that fails too, its reason says how far
    there was an equilibrium, and its unknowns are the last one. Unless `follow` is set, an unstable
    equilibrium, or one found after wandering, is approached in increments as well, through stable ones only,
    and a stable one that this leads to takes its place: Newton's method may jump over to a solution that no
    loading reaches.
    """
    start = begin.unknowns
    # What wanders is approached in increments even if it gets there: it goes on only where they do not.
    end = _newton(problem, start, tolerance, limit if follow else min(limit, _SOON))
    direct = np.where(end.reason == CONVERGED, end.iterations, 0)
    failed = np.flatnonzero(end.reason != CONVERGED)
    if failed.size:
        end.put(failed, _in_increments(problem.take(failed), begin.take(failed), tolerance, limit, follow))
    lost = np.flatnonzero((end.reason != CONVERGED) & ~begin.astray)
    if lost.size and not follow and limit > _SOON:
        again = _newton(problem.take(lost), start[lost], tolerance, limit)
        found = again.reason == CONVERGED
        end.put(lost[found], _members(again, found))
    unsure = (end.unstable > 0) | ((end.unstable == 0) & _wandered(problem, start, end))
    doubtful = np.flatnonzero((direct > 0) & unsure)
    if doubtful.size and not follow:
        again = _in_increments(problem.take(doubtful), begin.take(doubtful), tolerance, limit, follow)
        better = again.unstable == 0
        end.put(doubtful[better], _members(again, better))
    return end


def directly(problem: Problem, start: Array, tolerance: float) -> Iterate:
    """Newton's method alone from a start (B, N) nearby; what `solve` would approach in increments has not converged."""
    end = _in_chunks(problem, start, tolerance, _SOON)
    found = end.reason == CONVERGED
    end.reason[found & ((end.unstable > 0) | _wandered(problem, start, end))] = UNSURE
    return end


def _newton(problem: Problem, start: Array, tolerance: float, limit: int) -> Iterate:
    """Newton's method chunk by chunk; stragglers of all chunks are gathered and finish together."""
    end = _in_chunks(problem, start, tolerance, min(limit, _SOON))
    late = np.flatnonzero(end.reason == RUNNING)
    if late.size and limit > _SOON:
        end.put(late, _in_chunks(problem.take(late), end.unknowns[late], tolerance, limit - _SOON))
    return end


def _in_chunks(problem: Problem, start: Array, tolerance: float, limit: int) -> Iterate:
    place = problem.place
    end = unsolved(start)
    for first in range(0, len(start), place.several):
        part = np.arange(first, min(first + place.several, len(start)))
        system = problem.take(part).blockwise
        end.put(
            part, newton(system, start[part], place.scale, tolerance, limit, np.arange(place.platform.stop))
        )
    return end


def _in_increments(problem: Problem, begin: Start, tolerance: float, limit: int, follow: bool) -> Iterate:
    """Targets and inputs approached from those at the start; a load case that fails stays where it got to. The first
    step of one that is astray is the least one."""
    start, before, astray = begin.unknowns, begin.drives, begin.astray
    origin = replace(problem, drives=before).readings(start)
    end = unsolved(start)
    reached, step = np.zeros(len(start)), np.where(astray, LEAST_STEP, FIRST_STEP)
    active = np.arange(len(start))
    for _ in range(_TRIES):
        if not active.size:
            break
        share = np.minimum(reached[active] + step[active], 1.0)[:, None]
        aim = origin[active] + share * (problem.targets[active] - origin[active])
        drives = before[active] + share * (problem.drives[active] - before[active])
        # Many iterations are of use to the least step alone.
        most = limit if np.any((step < 2.0 * LEAST_STEP)[active] & ~astray[active]) else min(limit, _SOON)
        part = _newton(problem.take(active).aim(aim, drives), end.unknowns[active], tolerance, most)
        good = (part.reason == CONVERGED) & (follow | (part.unstable <= 0))
        # A smaller step tells whether one that wandered has found the continuation; the least one is believed.
        good &= ~_wandered(problem, end.unknowns[active], part) | (step[active] < 2.0 * LEAST_STEP)
        part.unknowns[~good] = end.unknowns[active[~good]]
        end.put(active, part)
        reached[active[good]] = share[good, 0]
        step[active] = np.where(good, np.minimum(2.0 * step[active], LARGEST_STEP), 0.5 * step[active])
        lost = active[step[active] < LEAST_STEP]
        _give_up(end, lost, reached, LOST_STABILITY)
        active = active[(step[active] >= LEAST_STEP) & (reached[active] < 1.0)]
    _give_up(end, active, reached, str(Reason.NOT_CONVERGED))
    return end


def _give_up(end: Iterate, lost: np.ndarray, reached: Array, otherwise: str) -> None:
    """Says of load cases how far there was an equilibrium. otherwise: why, of one whose last increment got there."""
    for k in lost:
        why = otherwise if end.reason[k] == CONVERGED else end.reason[k]
        end.reason[k] = f"{why}; last equilibrium {100 * reached[k]:.3g} % of the way from the start"
    end.unstable[lost] = -1


def _wandered(problem: Problem, start: Array, end: Iterate) -> np.ndarray:
    """Members that took many iterations or went far from their first step, begun at `start` (B, N).

    Where there is play the first step goes as far as its soft spring lets it, and comes back from the stop, to and fro
    where there are several: a member that ends near its start has not wandered then.
    """
    wandered = (end.iterations > MANY) | (end.strayed > _FAR)
    if problem.plays:
        motion = slice(problem.place.platform.stop)
        way = np.abs((end.unknowns - start)[:, motion] / problem.place.scale[motion])
        wandered &= np.max(way, axis=-1, initial=0.0) > SMALL_STEP
    return np.asarray(wandered)


def _members(end: Iterate, mask: np.ndarray) -> Iterate:
    return Iterate(*(getattr(end, field.name)[mask] for field in fields(end)))
