"""The largest eigenvalues of A x = μ K x with every member of a multiple one, by block Krylov spaces.

A space that starts from one vector holds one vector of each eigenspace, so that further members of a multiple
eigenvalue are found only through rounding, or not at all. One that starts from b random vectors holds b of them: where
fewer than b were found of an eigenvalue there are no more. Else the search is done again with more.
Sources: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, sections 13.1 (Krylov spaces) and 13.10 (blocks);
G. H. Golub, R. Underwood, in: Mathematical Software III, Academic Press 1977, 361-377.
"""

from typing import Protocol

import numpy as np

from fem.factor import Factor
from meshes.solid import Floats

# Of the residual of a wanted pair over its eigenvalue, which is then good to the square of it.
VECTOR_TOLERANCE = 1e-6
# The same of the next one, which is only looked at for being a twin of the last.
GLANCE = 1e-3
# Eigenvalues closer than this are members of one: above the error of the eigensolver, below that of a mesh.
SAME = 1e-4
# Vectors to start from: a solver takes little longer for a few columns than for one.
BLOCK = 5
MOST_STEPS = 60
# Squared, of the longest of new vectors: what is left of a shorter one is the solver's rounding.
GONE = 1e-18


class Product(Protocol):
    """A symmetric matrix as far as it multiplies columns (n, r)."""

    def __matmul__(self, x: Floats) -> Floats: ...


def largest_eigenpairs(a: Product, factor: Factor, count: int, block: int = BLOCK) -> tuple[Floats, Floats]:
    """The `count` largest μ (m,) in falling order with vectors (n, m), m ≥ count: with the twins of the last one.

    a      : (n, n) symmetric
    factor : solves with K (n, n), symmetric positive definite
    The vectors are orthonormal in K. RuntimeError if the iteration does not settle.
    """
    size = factor.matrix.shape[0]
    space = Krylov(a, factor, np.random.default_rng(0).standard_normal((size, min(block, size))))
    for _ in range(MOST_STEPS):
        space.grow()
        values, parts, residuals = space.pairs()
        if len(values) < min(count + 1, size):
            continue
        last = values[min(count, size) - 1]
        wanted = int(np.count_nonzero(values >= last - SAME * abs(last)))
        limits = np.where(np.arange(len(values)) < wanted, VECTOR_TOLERANCE, GLANCE) * np.abs(values)
        if space.whole or np.all(residuals[: wanted + 1] <= limits[: wanted + 1]):
            break
    else:
        raise RuntimeError(f"{count} eigenvalues did not settle in {MOST_STEPS} steps of {block} vectors")
    if not space.whole and members(values[:wanted]) >= block:
        return largest_eigenpairs(a, factor, count, 2 * block)
    return values[:wanted], space.basis @ parts[:, :wanted]


def members(values: Floats) -> int:
    """Most of the values (m,), in falling order, that are one."""
    return max(int(np.count_nonzero(np.abs(values - v) <= SAME * abs(v))) for v in values)


class Krylov:
    """The span of K⁻¹F, K⁻¹A K⁻¹F, .. with a basis Q (n, m) orthonormal in K, and A in it.

    K Q comes with Q, for K times a new vector is A times the old one: no product with K is made.
    """

    def __init__(self, a: Product, factor: Factor, loads: Floats) -> None:
        self.a, self.factor = a, factor
        empty = np.zeros((len(loads), 0))
        self.basis, self.heavy, self.within = empty, empty, np.zeros((0, 0))
        self.next, self.heavy_next, self.over = self.orthonormal(loads)

    @property
    def whole(self) -> bool:
        """Whether A maps the space into itself, so that its pairs are exact."""
        return self.next.shape[1] == 0

    def grow(self) -> None:
        """Take in the next vectors."""
        loads = np.asarray(self.a @ self.next)
        self.basis = np.hstack((self.basis, self.next))
        self.heavy = np.hstack((self.heavy, self.heavy_next))
        columns = self.basis.T @ loads
        old = len(self.within)
        self.within = np.block([[self.within, columns[:old]], [columns[:old].T, columns[old:]]])
        self.next, self.heavy_next, self.over = self.orthonormal(loads)

    def pairs(self) -> tuple[Floats, Floats, Floats]:
        """Eigenvalues (m,) of A in the space, falling, their vectors (m, m) in the basis, and residuals (m,)."""
        values, parts = np.linalg.eigh(0.5 * (self.within + self.within.T))
        values, parts = values[::-1], parts[:, ::-1]
        # Only the last vectors taken in lead out of the space.
        return values, parts, np.linalg.norm(self.over @ parts[-self.over.shape[1] :], axis=0)

    def orthonormal(self, loads: Floats) -> tuple[Floats, Floats, Floats]:
        """K⁻¹ loads (n, b) beyond the basis as new vectors (n, r), K times these, and (r, b) the shares of them."""
        new, heavy = self.factor(loads), loads
        over = np.eye(loads.shape[1])
        # Twice is enough.
        for _ in range(2):
            longest = np.einsum("nb,nb->b", new, heavy).max(initial=0.0)
            shares = self.basis.T @ heavy
            new, heavy = new - self.basis @ shares, heavy - self.heavy @ shares
            squares, turn = np.linalg.eigh(0.5 * (new.T @ heavy + heavy.T @ new))
            kept = squares > GONE * longest
            lengths, turn = np.sqrt(squares[kept]), turn[:, kept]
            new, heavy = new @ turn / lengths, heavy @ turn / lengths
            over = (lengths[:, None] * turn.T) @ over
        return new, heavy, over
