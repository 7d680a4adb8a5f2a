"""A linear solver is a callable: `solver(matrix)` factorises once and returns `solve(right-hand sides)`.

Every answer is checked against its own equations: a singular system is a `SolveError`, never a number.
"""

import importlib.util
import os
import sys
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Protocol

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from meshes.solid import Floats

# The same bits in every run; has to stand before MKL is loaded. "COMPATIBLE" would hold on older processors too,
# but factorises four times slower (measured: 6.5 s against 1.6 s at 69 000 unknowns).
os.environ.setdefault("MKL_CBWR", "AVX2")

# Below this many unknowns a second thread gains nothing alone, and waits for its turn on a busy machine.
SMALL = 40_000
RESIDUAL_LIMIT = 1e-8
GROWTH_LIMIT = 1e12


class SolveError(RuntimeError):
    """A linear system could not be solved; the message says why."""


class Factor(Protocol):
    """A factorised matrix."""

    name: str

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative eigenvalues of the matrix."""
        ...

    def __call__(self, rhs: Floats) -> Floats:
        """Solve for (n,) or (n, r) right-hand sides; raises SolveError if the residual is not small."""
        ...


Solver = Callable[[sp.spmatrix], Factor]


def checked(matrix: sp.csr_matrix, rhs: Floats, x: Floats, scale: float) -> Floats:
    """`x` if it solves the system; `scale` is the largest entry of the matrix."""
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
    return x


@dataclass
class SuperLUFactor:
    """scipy's SuperLU with the ordering for symmetric patterns."""

    matrix: sp.csr_matrix
    name: str = "SuperLU"

    def __post_init__(self) -> None:
        options = {"SymmetricMode": True, "DiagPivotThresh": 0.001}
        try:
            self.lu = splu(self.matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", options=options)
        except RuntimeError as error:
            raise SolveError(f"the matrix cannot be factorised ({error}): the model is not held") from error
        self.scale = float(np.abs(self.matrix.data).max())

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative pivots, equal to that of negative eigenvalues of the symmetric matrix."""
        swapped = not np.array_equal(self.lu.perm_r, self.lu.perm_c)
        if swapped:
            raise SolveError("the inertia is not available: the factorisation left the diagonal")
        return int(np.count_nonzero(self.lu.U.diagonal() < 0.0))

    def __call__(self, rhs: Floats) -> Floats:
        x = self.lu.solve(np.ascontiguousarray(rhs))
        x = x + self.lu.solve(rhs - self.matrix @ x)
        return checked(self.matrix, rhs, x, self.scale)


@dataclass
class PardisoFactor:
    """MKL's multithreaded LDLᵀ of a symmetric matrix, definite or not."""

    matrix: sp.csr_matrix
    name: str = "pardiso"

    def __post_init__(self) -> None:
        import pypardiso

        find_mkl()
        self.upper = sp.triu(self.matrix, format="csr")
        self.upper.sort_indices()
        self.scale = float(np.abs(self.matrix.data).max())
        self.engine = pypardiso.PyPardisoSolver(mtype=-2)
        # MKL keeps the factor outside Python's memory.
        weakref.finalize(self, self.engine.free_memory, everything=True)
        self.engine.libmkl.MKL_Set_Num_Threads(1 if self.upper.shape[0] < SMALL else os.cpu_count() or 1)
        self.engine.set_phase(12)
        try:
            self.engine._check_A(self.upper)
            self.engine._call_pardiso(self.upper, np.zeros((self.upper.shape[0], 1)))
        except (pypardiso.pardiso_wrapper.PyPardisoError, ValueError) as error:
            raise SolveError(f"the matrix cannot be factorised ({error}): the model is not held") from error

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative eigenvalues of the symmetric matrix."""
        return int(self.engine.get_iparm(23))

    def __call__(self, rhs: Floats) -> Floats:
        self.engine.set_phase(33)
        x = self.engine._call_pardiso(self.upper, np.asfortranarray(rhs, dtype=float))
        return checked(self.matrix, rhs, x, self.scale)


def direct(matrix: sp.spmatrix) -> Factor:
    """Factorise a symmetric matrix with the fastest direct solver that is installed."""
    return (PardisoFactor if has_pardiso() else SuperLUFactor)(matrix.tocsr())


@cache
def has_pardiso() -> bool:
    """Whether MKL's pardiso can be called on this machine."""
    return importlib.util.find_spec("pypardiso") is not None


@cache
def find_mkl() -> None:
    """Tell pypardiso where MKL is: left alone it searches the whole environment at every factorisation."""
    library = next(iter(sorted(Path(sys.prefix, "lib").glob("libmkl_rt.so*"))), None)
    if library is not None:
        os.environ.setdefault("PYPARDISO_MKL_RT", str(library))
