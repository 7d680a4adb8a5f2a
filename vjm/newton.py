"""Newton's method for many small dense systems at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dsytrf, dsytrs

from vjm.frames import Array
from vjm.reasons import Reason

Step = Callable[[np.ndarray], tuple[Array, np.ndarray, np.ndarray]]
System = Callable[[Array, np.ndarray], tuple[Array, Step]]
"""Takes unknowns (B, N) and the numbers (B,) of their batch members; returns the dimensionless residual (B, N)
and what gives Newton's step (B, N), in units of the scale, with a mask (B,) of the members that have one. It is
told the numbers of the members that this step finishes and counts their unstable directions, -1: not counted.
"""

CONVERGED = "converged"
RUNNING = f"{Reason.NOT_CONVERGED} within the allowed iterations"
DIVERGED = f"{Reason.NOT_CONVERGED}: the residual grew beyond bounds"
SINGULAR = f"{Reason.NOT_CONVERGED}: it met a singular matrix"
DIVERGED_ABOVE = 1e4
# Near a solution the residual falls by far more than a half in an iteration; on the way there it may rise for some.
STALLED = 12
LARGEST_STEP = 0.5
WORKSPACE = 32
"""Numbers of the work array of LAPACK's sytrf for each row of a matrix: the columns that it takes at once."""
NO_PIVOT = 1e-14
"""Of the largest entry of a matrix: a smaller pivot is rounding."""
# Of the length, or rad: what a solution is improved by when it was nearly known is not a way that it went.
SMALL_STEP = 1e-3


@dataclass(frozen=True, eq=False)
class Iterate:
    """Where the iteration ended.

    unknowns: (B, N). residual: (B,). iterations: (B,). reason: (B,) of strings. unstable: (B,) number of
    unstable directions, -1 where not converged or not counted. strayed: (B,) how far it moved after its first
    step, relative to that step.
    """

    unknowns: Array
    residual: Array
    iterations: np.ndarray
    reason: np.ndarray
    unstable: np.ndarray
    strayed: Array

    def put(self, members: np.ndarray, other: Iterate) -> None:
        """Replace these members by those of another iteration, whose iterations are added."""
        for name in ("unknowns", "residual", "reason", "unstable", "strayed"):
            getattr(self, name)[members] = getattr(other, name)
        self.iterations[members] += other.iterations


def unsolved(start: Array) -> Iterate:
    """The state before the first iteration, of unknowns (B, N)."""
    count = len(start)
    return Iterate(
        start.copy(),
        np.full(count, np.inf),
        np.zeros(count, dtype=int),
        np.full(count, RUNNING, dtype=object),
        np.full(count, -1),
        np.zeros(count),
    )


def solve_each(matrices: Array, right: Array) -> tuple[Array, np.ndarray]:
    """Solutions (B, N, r) and a mask (B,) of the members whose matrix is regular; the others get zeros."""
    regular = np.ones(len(matrices), dtype=bool)
    try:
        solution = np.asarray(np.linalg.solve(matrices, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        # A number that is none has no rank, and ends the search for one.
        regular[:] = np.isfinite(matrices).all(axis=(-2, -1))
        regular[regular] = [np.linalg.matrix_rank(m) == len(m) for m in matrices[regular]]
        solution = np.zeros_like(right)
        solution[regular] = np.linalg.solve(matrices[regular], right[regular])
    finite = np.isfinite(solution)
    if not finite.all():
        regular &= np.all(finite, axis=(-2, -1))
        solution = np.where(regular[:, None, None], solution, 0.0)
    return solution, regular


def dense(rows: Array, matrix: Array, scale: Array) -> Step:
    """Newton's step from the whole matrix (B, N, N), its columns by unknowns of the sizes `scale`."""

    def step(done: np.ndarray) -> tuple[Array, np.ndarray, np.ndarray]:
        solution, regular = solve_each(matrix * scale, -rows[..., None])
        return solution[..., 0], regular, np.full(done.size, -1)

    return step


def newton(
    system: System,
    start: Array,
    scale: Array,
    tolerance: float,
    limit: int,
    motion: np.ndarray | None = None,
    patience: int = STALLED,
) -> Iterate:
    """Iterate every member of a batch until its largest residual is below the tolerance.

    start: (B, N). scale: (N,) sizes of the unknowns. motion: numbers of the unknowns that are displacements;
    a step that would change one of them by more than `LARGEST_STEP` of its size is shortened.
    The step after the residual has met the tolerance is still taken: it costs one solve and brings the
    residual to rounding. A step that goes far there is along a motion without stiffness, as of a linkage that swings
    freely, and is none. Members that fail keep their last finite unknowns and a reason.
    """
    end, first = unsolved(start), None
    part = slice(None) if motion is None else motion
    active = np.arange(len(start))
    best, since = np.full(len(start), np.inf), np.zeros(len(start), dtype=int)
    for _ in range(limit):
        if active.size == 0:
            break
        rows, solve = system(end.unknowns[active], active)
        end.residual[active] = size = np.max(np.abs(rows), axis=-1)
        done = size < tolerance
        step, regular, end.unstable[active[done]] = solve(np.flatnonzero(done))
        step[done & (np.max(np.abs(step[:, part]), axis=-1, initial=0.0) > SMALL_STEP)] = 0.0
        end.reason[active[~regular]] = SINGULAR
        far = ~(size < DIVERGED_ABOVE)
        end.reason[active[far]] = DIVERGED
        moving = regular & ~far
        end.unknowns[active[moving]] += _shortened(step[moving], motion) * scale
        end.iterations[active] += 1
        end.reason[active[moving & done]] = CONVERGED
        better = size < 0.5 * best[active]
        best[active] = np.where(better, size, best[active])
        since[active] = np.where(better, 0, since[active] + 1)
        active = active[moving & ~done & (since[active] < patience)]
        first = end.unknowns.copy() if first is None else first
    if first is not None:
        ways = [
            np.max(np.abs((b - a) / scale)[:, part], axis=-1)
            for a, b in ((start, first), (first, end.unknowns))
        ]
        end.strayed[:] = ways[1] / (ways[0] + SMALL_STEP)
    return end


def solve_symmetric(
    matrices: Array, right: Array, counted: np.ndarray
) -> tuple[Array, np.ndarray, np.ndarray]:
    """As `solve_each`, of symmetric matrices (B, n, n), and the number (m,) of negative eigenvalues of the members with
    the numbers `counted` (m,), by the factors that solve them."""
    if not counted.size:
        return *solve_each(matrices, right), np.zeros(0, dtype=int)
    solution, regular = np.zeros_like(right), np.ones(len(right), dtype=bool)
    other = np.ones(len(right), dtype=bool)
    other[counted] = False
    solution[other], regular[other] = solve_each(matrices[other], right[other])
    factors = _Factors.of(matrices[counted])
    for member, factor, pivots in zip(counted, factors.factors, factors.pivots, strict=True):
        solution[member] = dsytrs(factor, pivots, right[member], lower=1)[0]
    regular[counted] = factors.regular & np.isfinite(solution[counted]).all(axis=(-2, -1))
    solution[~regular] = 0.0
    return solution, regular, factors.negatives


def negatives(symmetric: Array) -> np.ndarray:
    """Number (B,) of negative eigenvalues of (B, n, n), by Sylvester's law of inertia."""
    return _Factors.of(symmetric).negatives


@dataclass(frozen=True, eq=False)
class _Factors:
    """L D L^T with pivots of one or two rows (J. R. Bunch, L. Kaufman, Mathematics of Computation 31, 1977; LAPACK's
    sytrf). factors, pivots: of each matrix as LAPACK leaves them. regular: (B,) whether no pivot is zero. negatives:
    (B,) negative eigenvalues."""

    factors: list[Array]
    pivots: np.ndarray
    regular: np.ndarray
    negatives: np.ndarray

    @classmethod
    def of(cls, symmetric: Array) -> _Factors:
        """Of (B, n, n). A pivot that is rounding beside its matrix counts as none: along a motion that meets no
        stiffness. Of two rows each has one negative eigenvalue."""
        count, n, _ = symmetric.shape
        factors, failed = [], np.zeros(count, dtype=int)
        diagonals, pivots = np.zeros((count, n)), np.zeros((count, n), dtype=np.int32)
        for k, matrix in enumerate(symmetric):
            # Transposed it stands as LAPACK wants it, and is the same.
            factor, pivots[k], failed[k] = dsytrf(matrix.T, lower=1, lwork=WORKSPACE * max(n, 1))
            diagonals[k] = np.diagonal(factor)
            factors.append(factor)
        single = pivots > 0
        tiny = NO_PIVOT * np.max(np.abs(symmetric), axis=(-2, -1), initial=0.0)[:, None]
        below = np.sum((diagonals < -tiny) & single, axis=-1) + np.sum(~single, axis=-1) // 2
        return cls(factors, pivots, failed == 0, np.asarray(below))


def _shortened(step: Array, motion: np.ndarray | None) -> Array:
    if motion is None:
        return step
    largest = np.max(np.abs(step[:, motion]), axis=-1, initial=LARGEST_STEP)
    return step * (LARGEST_STEP / largest)[:, None]
