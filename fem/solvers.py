"""A linear solver is a callable: `solver(matrix, coarse)` makes a `Factor` once, and the factor solves.

`coarse()` gives the prolongation from a coarse space to the unknowns; direct solvers do not ask for it.
"""

from collections.abc import Callable
from typing import Protocol

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem.factor import Factor, SolveError, Sparse
from fem.multigrid import MultigridFactor
from fem.pardiso import PardisoFactor, SinglePardisoFactor, TooLarge, has_pardiso
from meshes.solid import Floats

Coarse = Callable[[], sp.csr_matrix]

LARGE = 150_000
"""Unknowns of a slender bar above which multigrid takes the place of SuperLU: memory decides, for it takes twice the
time. SuperLU takes 3.1 GiB at 106 000 and about 5 here. What pardiso takes its analysis says."""
SINGLE = 50_000
"""Unknowns from which pardiso factorises in single precision: below it the iterations take what that saves."""


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

    def __call__(self, matrix: Sparse, coarse: Coarse | None = None) -> Factor: ...


def direct(matrix: Sparse, coarse: Coarse | None = None) -> Factor:
    """Factorise a symmetric matrix with the fastest direct solver that is installed."""
    return PardisoFactor(matrix) if has_pardiso() else SuperLUFactor(matrix.tocsr())


def multigrid(matrix: Sparse, coarse: Coarse | None = None) -> Factor:
    """Two-level conjugate gradients, for positive definite matrices; ValueError without `coarse`."""
    if coarse is None:
        raise ValueError("multigrid needs the coarse space of its unknowns")
    return MultigridFactor(matrix.tocsr(), coarse(), direct)


def automatic(matrix: Sparse, coarse: Coarse | None = None, few: bool = False) -> Factor:
    """For positive definite matrices: direct where there is memory for it, else multigrid where it can be had. few:
    whether there are few right-hand sides; from `SINGLE` unknowns on single precision, refined, is quicker then."""
    count = matrix.shape[0]
    if not has_pardiso():
        return multigrid(matrix, coarse) if count > LARGE and coarse is not None else direct(matrix)
    for make in (SinglePardisoFactor,) if few and count >= SINGLE else (PardisoFactor, SinglePardisoFactor):
        try:
            return make(matrix)
        except TooLarge:
            if coarse is None and make is SinglePardisoFactor:
                raise
    return multigrid(matrix, coarse)
