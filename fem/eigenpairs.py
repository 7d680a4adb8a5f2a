"""The largest eigenvalues of A x = μ K x with every member of a multiple one.

One Krylov space holds one vector of each eigenspace, so that Lanczos' method finds further members of a multiple
eigenvalue only through rounding, or not at all. What was found is therefore taken out of A, and the rest is searched
again until nothing is left that belongs among the wanted ones.
Source: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, sections 5.2 (deflation) and 13.1 (Krylov spaces).
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import LinearOperator, eigsh

from fem.solvers import Factor
from meshes.solid import Floats

# Of the vectors, relative; the eigenvalues are then good to its square.
VECTOR_TOLERANCE = 1e-6
# Enough to see whether anything is left; what is found is then searched with the tolerance above.
GLANCE = 1e-3
# Eigenvalues closer than this are members of one: above the error of the eigensolver, below that of a mesh.
SAME = 1e-4
# Members of the last wanted eigenvalue beyond those asked for; more of them change no answer.
MOST_BEYOND = 5


def largest_eigenpairs(
    a: sp.csr_matrix, k: sp.csr_matrix, factor: Factor, count: int
) -> tuple[Floats, Floats]:
    """The `count` largest μ (m,) in falling order with vectors (n, m), m ≥ count: with the twins of the last one.

    a      : (n, n) sparse symmetric
    k      : (n, n) sparse symmetric, positive definite; `factor` solves with it
    The vectors are orthonormal in K. Raises RuntimeError (ArpackNoConvergence) if the iteration does not settle.
    """
    search = Search(a, k, factor)
    values, vectors = search.rest(np.zeros((k.shape[0], 0)), np.zeros(0), count, VECTOR_TOLERANCE)
    while len(values) < k.shape[0] - 1:
        last = float(np.sort(values)[-count])
        beyond = int(np.sum(values >= last * (1.0 - SAME))) - int(np.sum(values > last * (1.0 + SAME)))
        glance, _ = search.rest(vectors, values, 1, GLANCE)
        if glance[0] < last * (1.0 - SAME):
            break
        value, vector = search.rest(vectors, values, 1, VECTOR_TOLERANCE)
        if value[0] < last * (1.0 - SAME) or (beyond > MOST_BEYOND and value[0] <= last * (1.0 + SAME)):
            break
        values, vectors = np.append(values, value), np.hstack((vectors, vector))
    order = np.argsort(-values, kind="stable")
    return values[order], vectors[:, order]


class Search:
    """Lanczos' method on what is left of A once found pairs are taken out of it."""

    def __init__(self, a: sp.csr_matrix, k: sp.csr_matrix, factor: Factor) -> None:
        self.a, self.k = a, k
        self.inverse = LinearOperator(k.shape, matvec=factor, dtype=float)

    def rest(self, vectors: Floats, values: Floats, count: int, tolerance: float) -> tuple[Floats, Floats]:
        """The `count` largest of A - Σ μ (K v)(K v)ᵀ over pairs found: values (count,), vectors (n, count)."""
        operator = self.a if not len(values) else self.without(vectors, values)
        # What is left of an eigenspace is orthogonal to the start of the search before: another start each time, but
        # the same in every run.
        start = np.random.default_rng(len(values)).standard_normal(self.k.shape[0])
        found, new = eigsh(operator, count, self.k, which="LA", Minv=self.inverse, v0=start, tol=tolerance)
        order = np.argsort(-found, kind="stable")
        return found[order], new[:, order]

    def without(self, vectors: Floats, values: Floats) -> LinearOperator:
        """A without the pairs (m,), (n, m): their eigenvalues become zero, all others stay."""
        heavy = self.k @ vectors

        def product(x: Floats) -> Floats:
            x = np.ravel(x)
            return np.asarray(self.a @ x - heavy @ (values * (heavy.T @ x)))

        return LinearOperator(self.a.shape, matvec=product, dtype=float)
