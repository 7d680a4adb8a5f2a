"""Conjugate gradients with a two-level preconditioner: for matrices too large to factorise.

Level one is the quadratic elements, smoothed by Chebyshev polynomials of the diagonally scaled matrix; level two the
linear elements on the same mesh, a fifth of the unknowns, factorised. All right-hand sides go together.
Sources: Y. Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., SIAM 2003 (12.3, Chebyshev); M. Adams,
M. Brezina, J. Hu, R. Tuminaro, J. Comput. Phys. 188 (2003) 593-610 (Chebyshev as smoother).
"""

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from fem.conjugate_gradients import conjugate_gradients
from fem.factor import Factor, SolveError
from meshes.solid import Floats

# Four matrix products a sweep, for eigenvalues from a thirtieth of the largest: the fewest products altogether on
# bars whose cells are eight times as long as wide (measured; two to five and ten to forty do within a quarter).
DEGREE, RANGE = 4, 30.0
TOLERANCE = 1e-11
MOST_ITERATIONS = 600
# Powers of the matrix estimate its largest eigenvalue from below.
POWERS, MARGIN = 20, 1.1


class MultigridFactor(Factor):
    """A symmetric positive definite matrix with the `prolongation` (n, coarse) of its coarse space."""

    name = "multigrid"
    matrix: sp.csr_matrix

    def __init__(
        self,
        matrix: sp.csr_matrix,
        prolongation: sp.csr_matrix,
        coarse_solver: Callable[[sp.csr_matrix], Factor],
    ) -> None:
        self.prolongation, self.coarse_solver = prolongation, coarse_solver
        super().__init__(matrix)

    def prepare(self) -> None:
        diagonal = self.matrix.diagonal()
        if np.any(diagonal <= 0.0):
            raise SolveError(
                "the matrix is not positive definite, as multigrid needs it: the model is not held"
            )
        self.inverse_diagonal = 1.0 / diagonal
        coarse = self.prolongation.T @ (self.matrix @ self.prolongation)
        self.coarse = self.coarse_solver(sp.csr_matrix(coarse))
        x = np.random.default_rng(0).standard_normal(len(diagonal))
        for _ in range(POWERS):
            x = self.inverse_diagonal * (self.matrix @ (x / np.linalg.norm(x)))
        self.largest = MARGIN * float(np.linalg.norm(x))

    def require_held(self) -> None:
        """By the linear elements alone, whose space has every rigid motion of the parts."""
        self.coarse.require_held()

    @property
    def negative_eigenvalues(self) -> int:
        """Not to be had from an iteration: SolveError."""
        raise SolveError("the inertia is not available from an iterative solver")

    def renewed(self, matrix: sp.csr_matrix) -> Factor:
        return MultigridFactor(matrix, self.prolongation, self.coarse_solver)

    def solve(self, rhs: Floats) -> Floats:
        x, iterations = conjugate_gradients(self.matrix, rhs, self.preconditioned, TOLERANCE, MOST_ITERATIONS)
        self.iterations = max(self.iterations, iterations)
        return x

    def preconditioned(self, r: Floats) -> Floats:
        """One V-cycle, symmetric: smooth, correct on the linear elements, smooth."""
        x = self.smoothed(r)
        x += self.prolongation @ self.coarse(self.prolongation.T @ (r - self.matrix @ x))
        return x + self.smoothed(r - self.matrix @ x)

    def smoothed(self, r: Floats) -> Floats:
        """Chebyshev's polynomial of the scaled matrix applied to a residual."""
        low = self.largest / RANGE
        middle, half = 0.5 * (self.largest + low), 0.5 * (self.largest - low)
        sigma = middle / half
        rho = 1.0 / sigma
        scale = self.inverse_diagonal[:, None]
        step = scale * r / middle
        x = step.copy()
        for _ in range(DEGREE - 1):
            r = r - self.matrix @ step
            following = 1.0 / (2.0 * sigma - rho)
            step = following * rho * step + (2.0 * following / half) * (scale * r)
            x += step
            rho = following
        return x
