"""Newton's method for many small dense systems at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vjm.frames import Array

Step = Callable[[], tuple[Array, np.ndarray]]
System = Callable[[Array, np.ndarray], tuple[Array, Step]]
"""Takes unknowns (B, N) and the numbers (B,) of their batch members; returns the dimensionless residual (B, N)
and what gives Newton's step (B, N), in units of the scale, with a mask (B,) of the members that have one."""

CONVERGED, RUNNING = "converged", "not converged within the allowed iterations"
DIVERGED, SINGULAR = "diverged: the residual grew beyond bounds", "stopped at a singular matrix"
DIVERGED_ABOVE = 1e4
LARGEST_STEP = 0.5


@dataclass(frozen=True, eq=False)
class Iterate:
    """Where the iteration ended: unknowns (B, N), residual (B,), iterations (B,), reason (B,) of strings."""

    unknowns: Array
    residual: Array
    iterations: np.ndarray
    reason: np.ndarray


def solve_each(matrices: Array, right: Array) -> tuple[Array, np.ndarray]:
    """Solutions (B, N, r) and a mask (B,) of the members whose matrix is regular; the others get zeros."""
    regular = np.ones(len(matrices), dtype=bool)
    try:
        solution = np.asarray(np.linalg.solve(matrices, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        regular = np.array([np.linalg.matrix_rank(m) == len(m) for m in matrices])
        solution = np.zeros_like(right)
        solution[regular] = np.linalg.solve(matrices[regular], right[regular])
    finite = np.isfinite(solution)
    if not finite.all():
        regular &= np.all(finite, axis=(-2, -1))
        solution = np.where(regular[:, None, None], solution, 0.0)
    return solution, regular


def dense(rows: Array, matrix: Array, scale: Array) -> Step:
    """Newton's step from the whole matrix (B, N, N), its columns by unknowns of the sizes `scale`."""

    def step() -> tuple[Array, np.ndarray]:
        solution, regular = solve_each(matrix * scale, -rows[..., None])
        return solution[..., 0], regular

    return step


def newton(
    system: System, start: Array, scale: Array, tolerance: float, limit: int, motion: np.ndarray | None = None
) -> Iterate:
    """Iterate every member of a batch until its largest residual is below the tolerance.

    start: (B, N). scale: (N,) sizes of the unknowns. motion: numbers of the unknowns that are displacements;
    a step that would change one of them by more than `LARGEST_STEP` of its size is shortened.
    The step after the residual has met the tolerance is still taken: it costs one solve and brings the
    residual to rounding. Members that fail keep their last finite unknowns and a reason.
    """
    unknowns = start.copy()
    count = len(start)
    residual = np.full(count, np.inf)
    iterations = np.zeros(count, dtype=int)
    reason = np.full(count, RUNNING, dtype=object)
    active = np.arange(count)
    for _ in range(limit):
        if active.size == 0:
            break
        rows, solve = system(unknowns[active], active)
        residual[active] = size = np.max(np.abs(rows), axis=-1)
        step, regular = solve()
        reason[active[~regular]] = SINGULAR
        far = ~(size < DIVERGED_ABOVE)
        reason[active[far]] = DIVERGED
        moving = regular & ~far
        unknowns[active[moving]] += _shortened(step[moving], motion) * scale
        iterations[active] += 1
        done = moving & (size < tolerance)
        reason[active[done]] = CONVERGED
        active = active[moving & ~done]
    return Iterate(unknowns, residual, iterations, reason)


def _shortened(step: Array, motion: np.ndarray | None) -> Array:
    if motion is None:
        return step
    largest = np.max(np.abs(step[:, motion]), axis=-1, initial=LARGEST_STEP)
    return step * (LARGEST_STEP / largest)[:, None]
