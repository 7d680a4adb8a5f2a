"""The solution strategy of a batch: bounded chunks, Newton's method at once, increments where that fails."""

from __future__ import annotations

import numpy as np

from vjm.frames import Array
from vjm.newton import CONVERGED, RUNNING, Iterate, newton
from vjm.problem import Problem

DIVISIONS = (4, 16)
# Numbers of a chunk's matrices; a few MB, so that they stay in a cache and memory does not grow with the batch.
_NUMBERS = 400_000
_SOON = 8


def solve(problem: Problem, start: Array, tolerance: float, limit: int) -> Iterate:
    """Equilibria of all load cases, begun at `start` (B, N).

    A load case that Newton's method does not reach from its start is approached in 4, then in 16 equal
    increments of all its targets. Where that fails too, its reason says how far there was an equilibrium, and
    its unknowns are the last one.
    """
    end = _newton(problem, start, tolerance, limit)
    for divisions in DIVISIONS:
        failed = np.flatnonzero(end.reason != CONVERGED)
        if failed.size == 0:
            break
        again = _in_increments(problem.take(failed), start[failed], divisions, tolerance, limit)
        end.unknowns[failed], end.residual[failed] = again.unknowns, again.residual
        end.iterations[failed] += again.iterations
        end.reason[failed] = again.reason
    return end


def _newton(problem: Problem, start: Array, tolerance: float, limit: int) -> Iterate:
    """Newton's method chunk by chunk; stragglers of all chunks are gathered and finish together."""
    end = _in_chunks(problem, start, tolerance, min(limit, _SOON))
    late = np.flatnonzero(end.reason == RUNNING)
    if late.size and limit > _SOON:
        rest = _in_chunks(problem.take(late), end.unknowns[late], tolerance, limit - _SOON)
        end.unknowns[late], end.residual[late], end.reason[late] = rest.unknowns, rest.residual, rest.reason
        end.iterations[late] += rest.iterations
    return end


def _in_chunks(problem: Problem, start: Array, tolerance: float, limit: int) -> Iterate:
    place = problem.place
    motion = np.arange(place.platform.stop)
    step = max(4, _NUMBERS // (max(x.stop - x.start for x in place.coordinates) + 6) ** 2)
    ends = []
    for first in range(0, max(len(start), 1), step):
        part = slice(first, first + step)
        system = problem.take(part).blockwise
        ends.append(newton(system, start[part], place.scale, tolerance, limit, motion))
    parts = zip(*((e.unknowns, e.residual, e.iterations, e.reason) for e in ends), strict=True)
    return Iterate(*(np.concatenate(part) for part in parts))


def _in_increments(problem: Problem, start: Array, divisions: int, tolerance: float, limit: int) -> Iterate:
    place = problem.place
    load = np.sum([start[:, dual] for dual in place.multipliers], axis=0)
    origin = np.where(problem.held, start[:, place.platform], load)
    count = len(start)
    end = Iterate(
        start.copy(), np.full(count, np.inf), np.zeros(count, dtype=int), np.full(count, "", dtype=object)
    )
    active = np.arange(count)
    for k in range(1, divisions + 1):
        aim = origin + (k / divisions) * (problem.targets - origin)
        part = _newton(problem.aim(aim).take(active), end.unknowns[active], tolerance, limit)
        found = part.reason == CONVERGED
        end.unknowns[active[found]] = part.unknowns[found]
        end.residual[active], end.reason[active] = part.residual, part.reason
        end.iterations[active] += part.iterations
        reached = f"; last equilibrium {100 * (k - 1) / divisions:.0f} % of the way from the start"
        end.reason[active[~found]] += reached
        active = active[found]
    return end
