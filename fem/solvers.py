"""A linear solver is a callable: `solver(matrix, coarse)` makes a `Factor` once, and the factor solves.

`coarse()` gives the prolongation from a coarse space to the unknowns; direct solvers do not ask for it.
"""

from collections.abc import Callable
from typing import Protocol

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem.factor import Factor, SolveError, SolveRecord, checked
from fem.multigrid import MultigridFactor
from fem.pardiso import PardisoFactor, has_pardiso
from meshes.solid import Floats

__all__ = [
    "Factor",
    "MultigridFactor",
    "PardisoFactor",
    "SolveError",
    "SolveRecord",
    "Solver",
    "SuperLUFactor",
    "automatic",
    "automatic_name",
    "checked",
    "direct",
    "has_pardiso",
    "multigrid",
]

Coarse = Callable[[], sp.csr_matrix]

# Unknowns of a slender bar above which multigrid takes the place of the direct solver. Memory decides, for multigrid
# takes twice the time of SuperLU and ten times that of pardiso (106 000 unknowns, 1.1 GiB): pardiso takes 6.3 GiB at
# 335 000 and about 17 at 800 000, SuperLU 3.1 GiB at 106 000 and about 5 at 150 000.
LARGE = {"pardiso": 800_000, "SuperLU": 150_000}


class SuperLUFactor(Factor):
    """LU factors of a symmetric matrix, definite or not: scipy's SuperLU with the ordering for symmetric patterns,
    everywhere at hand, one thread."""

    name = "SuperLU"

    matrix: sp.csr_matrix

    def prepare(self) -> None:
        options = {"SymmetricMode": True, "DiagPivotThresh": 0.001}
        try:
            self.lu = splu(self.matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", options=options)
        except RuntimeError as error:
            raise SolveError(f"the matrix cannot be factorised ({error}): the model is not held") from error

    @property
    def negative_eigenvalues(self) -> int:
        """Number of negative pivots, equal to that of negative eigenvalues of the symmetric matrix."""
        swapped = not np.array_equal(self.lu.perm_r, self.lu.perm_c)
        if swapped:
            raise SolveError("the inertia is not available: the factorisation left the diagonal")
        return int(np.count_nonzero(self.lu.U.diagonal() < 0.0))

    def solve(self, rhs: Floats) -> Floats:
        x = self.lu.solve(np.ascontiguousarray(rhs))
        return np.asarray(x + self.lu.solve(rhs - self.matrix @ x))


class Solver(Protocol):
    """Makes a symmetric matrix ready for right-hand sides; raises SolveError if that cannot be done."""

    def __call__(self, matrix: sp.spmatrix, coarse: Coarse | None = None) -> Factor: ...


def direct(matrix: sp.spmatrix, coarse: Coarse | None = None) -> Factor:
    """Factorise a symmetric matrix with the fastest direct solver that is installed."""
    return (PardisoFactor if has_pardiso() else SuperLUFactor)(matrix.tocsr())


def multigrid(matrix: sp.spmatrix, coarse: Coarse | None = None) -> Factor:
    """Two-level conjugate gradients, for positive definite matrices; ValueError without `coarse`."""
    if coarse is None:
        raise ValueError("multigrid needs the coarse space of its unknowns")
    return MultigridFactor(matrix.tocsr(), coarse(), direct)


def automatic(matrix: sp.spmatrix, coarse: Coarse | None = None) -> Factor:
    """Direct up to a size that depends on which direct solver is installed, multigrid above where it can be had."""
    chosen = automatic_name(matrix.shape[0], coarse is not None)
    return multigrid(matrix, coarse) if chosen == "multigrid" else direct(matrix)


def automatic_name(unknowns: int, has_coarse: bool) -> str:
    """The solver that `automatic` takes: "multigrid", "pardiso" or "SuperLU"."""
    engine = "pardiso" if has_pardiso() else "SuperLU"
    return "multigrid" if unknowns > LARGE[engine] and has_coarse else engine
