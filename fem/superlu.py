"""scipy's SuperLU with the ordering for symmetric patterns: everywhere at hand, one thread."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem.factor import Factor, SolveError
from meshes.solid import Floats


class SuperLUFactor(Factor):
    """LU factors of a symmetric matrix, definite or not."""

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
