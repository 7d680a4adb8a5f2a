"""MKL's multithreaded pardiso, called through the library that pypardiso brings.

In single precision a factor takes half of the memory and less time, and is near enough to a bar's matrix for
conjugate gradients in double precision to end in some ten steps.
The arguments are handed over by ourselves: pypardiso's own call copies the whole index array at every solution.
Source: Intel oneAPI Math Kernel Library, Developer Reference, "oneMKL PARDISO - parallel direct sparse solver".
"""

import ctypes
import importlib.util
import os
import sys
import time
import weakref
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from fem.conjugate_gradients import conjugate_gradients
from fem.factor import Factor, SolveError, Sparse
from meshes.solid import Floats

# The same bits in every run; has to stand before MKL is loaded. "COMPATIBLE" would hold on older processors too,
# but factorises four times slower (measured: 6.5 s against 1.6 s at 69 000 unknowns).
os.environ.setdefault("MKL_CBWR", "AVX2")

# Below this many unknowns a second thread gains nothing alone, and waits for its turn on a busy machine.
SMALL = 40_000
SYMMETRIC_INDEFINITE = -2
ANALYSE, FACTORISE, SOLVE, RELEASE = 11, 22, 33, -1
# By the manual's numbers, which start at 1: own settings, nested dissection, pivots perturbed at 1e-8, 1x1 and
# 2x2 pivots, indices from zero, fill to be reported.
SETTINGS = {1: 1, 2: 2, 10: 8, 18: -1, 21: 1, 35: 1}
NEGATIVE_PIVOTS, SINGLE = 23, 28
PEAK_OF_ANALYSIS, OF_FACTOR = 15, 17
"""Of the settings after the analysis, in a row: KiB that it took at most, what it keeps, what a factor takes."""
TOLERANCE, MOST_ITERATIONS = 1e-9, 30
"""Of the conjugate gradients about a factor in single precision: a bar of 280 000 unknowns takes eight, and thirty take
what single precision saves."""


ALWAYS_THERE = 2**28
"""Bytes that no machine lacks; which it has is asked beyond that."""


class TooLarge(SolveError):
    """A factor takes more memory than there is."""


@dataclass(frozen=True, eq=False)
class SymmetricHalf:
    """A symmetric matrix of which only the part on and above the diagonal is kept, rows sorted."""

    upper: sp.csr_matrix

    @property
    def shape(self) -> tuple[int, int]:
        return self.upper.shape[0], self.upper.shape[0]

    @property
    def nnz(self) -> int:
        return 2 * int(self.upper.nnz) - self.shape[0]

    def __matmul__(self, x: Floats) -> Floats:
        diagonal = self.upper.data[self.upper.indptr[:-1]]
        below = self.upper.T @ x
        return np.asarray(self.upper @ x + (below.T - diagonal * x.T).T)


class PardisoFactor(Factor):
    """LDLᵀ of a symmetric matrix, definite or not."""

    name = "pardiso"

    def __init__(self, matrix: Sparse) -> None:
        # The other half is let go: at 300 000 unknowns it would be half a gigabyte.
        self.upper = upper_triangle(matrix.tocsr())
        self.begin(SymmetricHalf(self.upper), float(np.abs(self.upper.data).max(initial=0.0)))

    def prepare(self) -> None:
        self.factorise(self.upper)

    def factorise(self, handed: sp.csr_matrix) -> None:
        """The matrix in the precision in which it is handed over. TooLarge before anything of size is done."""
        self.handed = handed
        self.handle, self.settings = np.zeros(64, dtype=np.int64), np.zeros(64, dtype=np.int32)
        for number, value in SETTINGS.items():
            self.settings[number - 1] = value
        self.settings[SINGLE - 1] = handed.dtype == np.float32
        self.threads = 1 if handed.shape[0] < SMALL else cores()
        library().MKL_Set_Num_Threads(self.threads)
        none = np.zeros(handed.shape[0], dtype=handed.dtype)
        # MKL keeps the factor outside Python's memory.
        self.release = weakref.finalize(self, call, RELEASE, self.handle, self.settings, handed, none, none)
        self.run(ANALYSE, none, none)
        needed = self.forecast
        if needed > ALWAYS_THERE and needed > (there := free_memory()):
            raise TooLarge(
                f"the factor of {handed.shape[0]} unknowns takes {needed / 2**30:.1f} GiB of memory, "
                f"of which {there / 2**30:.1f} are free"
            )
        self.run(FACTORISE, none, none)

    @property
    def forecast(self) -> int:
        """Bytes that the analysis says the factor and its making take."""
        peak, kept, factor = map(int, self.settings[PEAK_OF_ANALYSIS - 1 : OF_FACTOR])
        return 1024 * max(peak, kept + factor)

    def renewed(self, matrix: sp.csr_matrix) -> Factor:
        upper = upper_triangle(matrix)
        pairs = ((upper.indptr, self.upper.indptr), (upper.indices, self.upper.indices))
        if not all(np.array_equal(mine, old) for mine, old in pairs):
            return PardisoFactor(matrix)
        start = time.perf_counter()
        # The order of elimination, half of the work at this size, is kept.
        self.upper.data[:] = upper.data
        self.scale = float(np.abs(upper.data).max(initial=0.0))
        library().MKL_Set_Num_Threads(self.threads)
        self.run(FACTORISE, np.zeros(upper.shape[0]), np.zeros(upper.shape[0]))
        self.setup_seconds += time.perf_counter() - start
        return self

    def run(self, phase: int, rhs: Floats, x: Floats) -> None:
        """One phase of pardiso; SolveError says what went wrong."""
        error = call(phase, self.handle, self.settings, self.handed, rhs, x)
        if error:
            raise SolveError(
                f"the matrix cannot be factorised (pardiso's error {error}): the model is not held"
            )

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative eigenvalues of the symmetric matrix."""
        return int(self.settings[NEGATIVE_PIVOTS - 1])

    def solve(self, rhs: Floats) -> Floats:
        columns = np.asfortranarray(rhs, dtype=self.handed.dtype)
        x = np.zeros_like(columns)
        self.run(SOLVE, columns, x)
        return np.ascontiguousarray(x)


class SinglePardisoFactor(PardisoFactor):
    """LDLᵀ in single precision of a symmetric positive definite matrix, and conjugate gradients in double about it.

    A matrix that it is not near enough to is factorised in double precision.
    """

    name = "pardiso in single precision"

    def factorise(self, handed: sp.csr_matrix) -> None:
        upper = handed
        super().factorise(
            sp.csr_matrix((upper.data.astype(np.float32), upper.indices, upper.indptr), upper.shape)
        )
        try:
            super().require_held()
        except SolveError:
            self.name = PardisoFactor.name
            self.release()
            super().factorise(upper)

    def require_held(self) -> None:
        """In single precision it was asked when the factor was made."""
        if self.handed.dtype != np.float32:
            super().require_held()

    def renewed(self, matrix: sp.csr_matrix) -> Factor:
        return SinglePardisoFactor(matrix)

    @property
    def negative_eigenvalues(self) -> int:
        """Not to be had of a matrix that is known to single precision: SolveError."""
        if self.handed.dtype == np.float32:
            raise SolveError("the inertia is not available from a factor in single precision")
        return super().negative_eigenvalues

    def solve(self, rhs: Floats) -> Floats:
        if self.handed.dtype != np.float32:
            return super().solve(rhs)
        x, iterations = conjugate_gradients(self.matrix, rhs, self._near, TOLERANCE, MOST_ITERATIONS)
        self.iterations = max(self.iterations, iterations)
        return x

    def _near(self, r: Floats) -> Floats:
        """Of residuals (n, r), each first brought to numbers that single precision has."""
        sizes = np.abs(r).max(axis=0)
        sizes[sizes == 0.0] = 1.0
        return np.asarray(super().solve(r / sizes) * sizes)


def upper_triangle(matrix: sp.csr_matrix) -> sp.csr_matrix:
    """The entries on and above the diagonal, rows sorted; SolveError where an entry of the diagonal is missing."""
    matrix.sort_indices()
    rows = np.repeat(np.arange(matrix.shape[0], dtype=np.int32), np.diff(matrix.indptr))
    kept = matrix.indices >= rows
    counts = np.concatenate(([0], np.cumsum(kept, dtype=np.int32)))[matrix.indptr]
    indices = matrix.indices[kept].astype(np.int32, copy=False)
    present = np.diff(counts) > 0
    if not np.all(present) or not np.array_equal(indices[counts[:-1]], np.arange(matrix.shape[0])):
        raise SolveError("the matrix cannot be factorised (no entry on its diagonal): the model is not held")
    return sp.csr_matrix((matrix.data[kept], indices, counts.astype(np.int32)), shape=matrix.shape)


def call(
    phase: int, handle: np.ndarray, settings: np.ndarray, upper: sp.csr_matrix, rhs: Floats, x: Floats
) -> int:
    """Call pardiso; `handle` (64,), `settings` (64,) and `x`, like `rhs` (n,) or (n, k), are changed in place.
    Returns its error code."""

    def number(value: int) -> Any:
        return ctypes.byref(ctypes.c_int32(value))

    def address(array: np.ndarray) -> Any:
        return ctypes.c_void_p(array.ctypes.data)

    error = ctypes.c_int32(0)
    count, sides = upper.shape[0], 1 if rhs.ndim == 1 else rhs.shape[1]
    matrix = (address(upper.data), address(upper.indptr), address(upper.indices))
    head = (address(handle), number(1), number(1), number(SYMMETRIC_INDEFINITE), number(phase), number(count))
    permutation = np.zeros(1, dtype=np.int32)
    tail = (address(permutation), number(sides), address(settings), number(0), address(rhs), address(x))
    library().pardiso(*head, *matrix, *tail, ctypes.byref(error))
    return int(error.value)


def free_memory() -> int:
    """Bytes that the machine has free for this process."""
    import psutil

    return int(psutil.virtual_memory().available)


def cores() -> int:
    """Threads to use: the processor's cores that this process may run on, or fewer if MKL_NUM_THREADS says so."""
    free = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    wanted = os.environ.get("MKL_NUM_THREADS", "")
    return min(free, int(wanted)) if wanted.isdigit() and int(wanted) > 0 else free


@cache
def has_pardiso() -> bool:
    """Whether MKL's pardiso can be called on this machine, and its memory asked for before."""
    return all(importlib.util.find_spec(name) is not None for name in ("pypardiso", "psutil"))


@cache
def library() -> Any:
    """MKL as pypardiso loads it, told where it is: left alone it searches the whole environment."""
    found = next(iter(sorted(Path(sys.prefix, "lib").glob("libmkl_rt.so*"))), None)
    if found is not None:
        os.environ.setdefault("PYPARDISO_MKL_RT", str(found))
    import pypardiso

    mkl = pypardiso.PyPardisoSolver(mtype=SYMMETRIC_INDEFINITE).libmkl
    mkl.pardiso.argtypes, mkl.pardiso.restype = None, None
    return mkl
