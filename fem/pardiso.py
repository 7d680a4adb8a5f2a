"""MKL's multithreaded pardiso, called through the library that pypardiso brings.

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

from fem.factor import Factor, SolveError
from meshes.solid import Floats

# The same bits in every run; has to stand before MKL is loaded. "COMPATIBLE" would hold on older processors too,
# but factorises four times slower (measured: 6.5 s against 1.6 s at 69 000 unknowns).
os.environ.setdefault("MKL_CBWR", "AVX2")

# Below this many unknowns a second thread gains nothing alone, and waits for its turn on a busy machine.
SMALL = 40_000
SYMMETRIC_INDEFINITE = -2
ANALYSE_AND_FACTORISE, FACTORISE, SOLVE, RELEASE = 12, 22, 33, -1
# By the manual's numbers, which start at 1: own settings, nested dissection, pivots perturbed at 1e-8, 1x1 and
# 2x2 pivots, indices from zero, fill to be reported.
SETTINGS = {1: 1, 2: 2, 10: 8, 18: -1, 21: 1, 35: 1}
FACTOR_ENTRIES, NEGATIVE_PIVOTS = 18, 23


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

    def prepare(self) -> None:
        self.upper = upper_triangle(sp.csr_matrix(self.matrix))
        # The other half is let go: at 300 000 unknowns it would be half a gigabyte.
        self.matrix = SymmetricHalf(self.upper)
        self.handle = np.zeros(64, dtype=np.int64)
        self.settings = np.zeros(64, dtype=np.int32)
        for number, value in SETTINGS.items():
            self.settings[number - 1] = value
        count = self.upper.shape[0]
        self.threads = 1 if count < SMALL else cores()
        library().MKL_Set_Num_Threads(self.threads)
        # MKL keeps the factor outside Python's memory.
        weakref.finalize(
            self, call, RELEASE, self.handle, self.settings, self.upper, np.zeros(1), np.zeros(1)
        )
        self.run(ANALYSE_AND_FACTORISE, np.zeros(count), np.zeros(count))

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
        error = call(phase, self.handle, self.settings, self.upper, rhs, x)
        if error:
            raise SolveError(
                f"the matrix cannot be factorised (pardiso's error {error}): the model is not held"
            )

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative eigenvalues of the symmetric matrix."""
        return int(self.settings[NEGATIVE_PIVOTS - 1])

    def solve(self, rhs: Floats) -> Floats:
        columns = np.asfortranarray(rhs, dtype=float)
        x = np.zeros_like(columns)
        self.run(SOLVE, columns, x)
        return np.ascontiguousarray(x)


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


def cores() -> int:
    """Threads to use: the processor's cores that this process may run on, or fewer if MKL_NUM_THREADS says so."""
    free = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    wanted = os.environ.get("MKL_NUM_THREADS", "")
    return min(free, int(wanted)) if wanted.isdigit() and int(wanted) > 0 else free


@cache
def has_pardiso() -> bool:
    """Whether MKL's pardiso can be called on this machine."""
    return importlib.util.find_spec("pypardiso") is not None


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
