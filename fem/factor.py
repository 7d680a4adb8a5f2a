"""What a linear solver gives back: a factor that solves, checks every answer and keeps a record.

A singular system is a `SolveError`, never a number.
"""

import time
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sp

from meshes.solid import Floats

RESIDUAL_LIMIT = 1e-8
GROWTH_LIMIT = 1e12


class SolveError(RuntimeError):
    """A linear system could not be solved; the message says why."""


@dataclass(frozen=True)
class SolveRecord:
    """What solving took so far.

    seconds : of the factorisation (or the set-up of the hierarchy), and of all solutions together
    iterations : most iterations for one right-hand side, 0 for a direct solver
    residual : largest |K x - f| over largest |f| of all solutions
    """

    solver: str
    unknowns: int
    nonzeros: int
    setup_seconds: float
    solve_seconds: float
    right_hand_sides: int
    iterations: int
    residual: float


class Sparse(Protocol):
    """A square matrix that can be had as one of rows, whole only as long as that is asked for."""

    @property
    def shape(self) -> tuple[int, int]: ...

    def tocsr(self) -> sp.csr_matrix: ...


class Operator(Protocol):
    """A square matrix as far as a residual needs it."""

    @property
    def shape(self) -> tuple[int, int]: ...

    @property
    def nnz(self) -> int: ...

    def __matmul__(self, x: Floats) -> Floats: ...


class Factor(ABC):
    """A symmetric matrix made ready for any number of right-hand sides; `matrix` multiplies like it."""

    name = ""
    matrix: Operator

    def __init__(self, matrix: sp.csr_matrix) -> None:
        self.begin(matrix, max(float(matrix.data.max(initial=0.0)), -float(matrix.data.min(initial=0.0))))

    def begin(self, matrix: Operator, scale: float) -> None:
        """Make ready; scale: the largest entry of the matrix."""
        self.matrix, self.scale = matrix, scale
        self.solve_seconds, self.solved, self.iterations, self.residual = 0.0, 0, 0, 0.0
        start = time.perf_counter()
        self.prepare()
        self.setup_seconds = time.perf_counter() - start

    @abstractmethod
    def prepare(self) -> None:
        """Factorise; raises SolveError if that cannot be done."""

    def renewed(self, matrix: sp.csr_matrix) -> "Factor":
        """A factor of another matrix; this one may be used up by it, where the two have the same pattern."""
        return type(self)(matrix)

    def require_held(self) -> None:
        """SolveError if the matrix is singular: a load may happen not to feel the motion that nothing holds."""
        self(np.random.default_rng(0).standard_normal(self.matrix.shape[0]))

    @abstractmethod
    def solve(self, rhs: Floats) -> Floats:
        """The unchecked solution of (n,) or (n, r) right-hand sides."""

    @property
    @abstractmethod
    def negative_eigenvalues(self) -> int:
        """Number of negative eigenvalues of the matrix; SolveError where this solver does not have it."""

    @property
    def record(self) -> SolveRecord:
        """What it took so far."""
        return SolveRecord(
            self.name,
            self.matrix.shape[0],
            self.matrix.nnz,
            self.setup_seconds,
            self.solve_seconds,
            self.solved,
            self.iterations,
            self.residual,
        )

    def __call__(self, rhs: Floats) -> Floats:
        """Solve for (n,) or (n, r) right-hand sides; raises SolveError if the residual is not small."""
        start = time.perf_counter()
        x, residual = checked(self.matrix, rhs, self.solve(rhs), self.scale)
        self.solve_seconds += time.perf_counter() - start
        self.solved += 1 if rhs.ndim == 1 else rhs.shape[1]
        load = float(np.abs(rhs).max(initial=0.0))
        self.residual = max(self.residual, residual / load if load > 0.0 else 0.0)
        return x


def checked(matrix: Operator, rhs: Floats, x: Floats, scale: float) -> tuple[Floats, float]:
    """`x` (n, ...) if it solves the system for `rhs` (n, ...), and the largest residual; `scale` is the largest
    entry of the matrix."""
    if not np.all(np.isfinite(x)):
        raise SolveError(
            "the linear system has no finite solution: the model is not held, or a value is not finite"
        )
    size = float(np.abs(x).max(initial=0.0))
    load = float(np.abs(rhs).max(initial=0.0))
    residual = float(np.abs(matrix @ x - rhs).max(initial=0.0))
    if size * scale > GROWTH_LIMIT * load and load > 0.0:
        raise SolveError("the linear system is singular to working precision: the model is not held")
    if residual > RESIDUAL_LIMIT * (load + scale * size * 1e-4):
        raise SolveError(
            f"the linear system was solved only to a residual of {residual:.2g} on a load of {load:.2g}"
        )
    return x, residual
