"""Newton's method for many small dense systems at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vjm.frames import Array

System = Callable[[Array, np.ndarray], tuple[Array, Array]]
"""Takes unknowns (B, N) and the numbers (B,) of their batch members; returns residual and matrix."""

CONVERGED, RUNNING = "converged", "not converged within the allowed iterations"
DIVERGED, SINGULAR = "diverged: the residual grew beyond bounds", "stopped at a singular matrix"
DIVERGED_ABOVE = 1e4


@dataclass(frozen=True, eq=False)
class Iterate:
    """Where the iteration ended: unknowns (B, N), residual (B,), iterations (B,), reason (B,) of strings."""

    unknowns: Array
    residual: Array
    iterations: np.ndarray
    reason: np.ndarray


def solve_each(matrices: Array, right: Array) -> tuple[Array, np.ndarray]:
    """Solutions (B, N) and a mask (B,) of the members whose matrix is regular; the others get zeros."""
    regular = np.ones(len(matrices), dtype=bool)
    try:
        solution = np.linalg.solve(matrices, right[..., None])[..., 0]
    except np.linalg.LinAlgError:
        regular = np.array([np.linalg.matrix_rank(m) == len(m) for m in matrices])
        solution = np.zeros_like(right)
        solution[regular] = np.linalg.solve(matrices[regular], right[regular][..., None])[..., 0]
    regular &= np.all(np.isfinite(solution), axis=-1)
    return np.where(regular[:, None], solution, 0.0), regular


def newton(system: System, start: Array, scale: Array, tolerance: float, limit: int) -> Iterate:
    """Iterate every member of a batch until its largest residual is below the tolerance.

    system: see `System`; its residual is dimensionless, row by row. start: (B, N).
    scale: (N,) sizes of the unknowns; the matrix is multiplied by it for the solve.
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
        rows, matrix = system(unknowns[active], active)
        residual[active] = size = np.max(np.abs(rows), axis=-1)
        step, regular = solve_each(matrix * scale, -rows)
        reason[active[~regular]] = SINGULAR
        far = ~(size < DIVERGED_ABOVE)
        reason[active[far]] = DIVERGED
        moving = regular & ~far
        unknowns[active[moving]] += step[moving] * scale
        iterations[active] += 1
        done = moving & (size < tolerance)
        reason[active[done]] = CONVERGED
        active = active[moving & ~done]
    return Iterate(unknowns, residual, iterations, reason)
