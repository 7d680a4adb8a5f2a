"""Stretches of a sweep condensed to the unknowns of their two end planes, in one symmetry class.

Unknowns along x come first in every plane. Dense and in double precision; Cholesky factors only.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg.blas import dgemm, dtrsm
from scipy.linalg.lapack import dpotrs

from fem.factor import SolveError
from meshes.layers import Layer
from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class Ends:
    """Forces on the planes before and behind: [[first, coupling], [couplingᵀ, last]] times their displacements."""

    first: Floats
    coupling: Floats
    last: Floats


@dataclass(frozen=True, eq=False)
class Prism:
    """A stretch that is its own mirror image along x.

    `last` = D first D and `coupling` = D turned, with `turned` symmetric. D is the identity with
    -1 for the `along` unknowns along x: mirroring reverses those.

    first, turned : (k, k) N/mm
    along         : number of unknowns along x
    length        : mm
    """

    first: Floats
    turned: Floats
    along: int
    length: float

    def reversed(self, rows: Floats) -> Floats:
        """D times (k, ...) rows, a copy."""
        out = rows.copy()
        out[: self.along] *= -1.0
        return out

    @property
    def coupling(self) -> Floats:
        return self.reversed(self.turned)

    @property
    def last(self) -> Floats:
        out = self.first.copy()
        out[: self.along, self.along :] *= -1.0
        out[self.along :, : self.along] *= -1.0
        return out


Stretch = Ends | Prism
Factors = tuple[Floats, ...]


def cholesky(matrix: Floats) -> Floats:
    """Lower Cholesky factor (k, k) of a symmetric matrix; SolveError if it is not positive definite."""
    try:
        return np.asarray(np.linalg.cholesky(matrix))
    except np.linalg.LinAlgError as error:
        raise SolveError("a slice of the sweep is not positive definite: the model is not held") from error


def half_solved(lower: Floats, rows: Floats) -> Floats:
    """L⁻¹ rows (k, c)."""
    # Of arrays that lie row by row BLAS sees the transpose: rowsᵀ L⁻ᵀ, and nothing is copied but the result.
    return np.asarray(dtrsm(1.0, lower.T, np.array(rows, order="C").T, side=1, overwrite_b=1).T)


def solved(lower: Floats, rows: Floats) -> Floats:
    """(L Lᵀ)⁻¹ rows (k, c)."""
    if not rows.size:
        return np.zeros_like(rows)
    # The transpose lies as LAPACK wants it, so that it is not copied; small planes are many, and each check counts.
    return np.asarray(dpotrs(lower.T, rows, lower=0)[0])


@dataclass(frozen=True, eq=False)
class Slice:
    """One layer with its middle unknowns eliminated.

    middle : (m, m) lower Cholesky factor of the middle unknowns
    to_first, to_last : sparse (m, k) stiffness between the middle and the planes
    """

    ends: Stretch
    middle: Floats
    to_first: sp.csr_matrix
    to_last: sp.csr_matrix


def condensed(
    layer: Layer,
    stiffness: sp.csr_matrix,
    bases: Sequence[sp.csc_matrix],
    rigid: Floats,
    along: int,
    thickness: float,
) -> Slice:
    """A layer's slice from its stiffness (dofs, dofs), for the class `bases` of first plane, middle and last plane.

    rigid : (k, c) rigid motions of the first plane about its own middle, as `without_rigid` needs them
    """
    count = stiffness.shape[0]
    first, middle, last = (
        placed(nodes, basis, count)
        for nodes, basis in zip((layer.first, layer.middle, layer.last), bases, strict=True)
    )
    ahead, between = stiffness @ first, stiffness @ middle
    lower = cholesky((middle.T @ between).toarray())
    to_first, to_last = sp.csr_matrix(middle.T @ ahead), sp.csr_matrix(between.T @ last)
    one, two = half_solved(lower, to_first.toarray()), half_solved(lower, to_last.toarray())
    near = (first.T @ ahead).toarray() - one.T @ one
    coupling = (ahead.T @ last).toarray() - one.T @ two
    if not layer.even:
        far = (last.T @ (stiffness @ last)).toarray() - two.T @ two
        return Slice(Ends(near, coupling, far), lower, to_first, to_last)
    coupling[:along] *= -1.0
    prism = Prism(near, 0.5 * (coupling + coupling.T), along, thickness)
    return Slice(without_rigid(prism, rigid), lower, to_first, to_last)


def placed(nodes: Ints, basis: sp.csc_matrix, count: int) -> sp.csr_matrix:
    """Sparse (count, k): a basis (3 n, k) on `nodes` (n,) among all unknowns; a node below zero has none."""
    rows = np.flatnonzero(np.repeat(nodes >= 0, 3))
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()[rows]
    spread = sp.csr_matrix((np.ones(len(rows)), (dofs, rows)), shape=(count, 3 * len(nodes)))
    return sp.csr_matrix(spread @ basis)


def doubled(half: Prism, rigid: Floats) -> tuple[Prism, Factors]:
    """Two equal prisms in series, and the Cholesky factors of the plane between: of its unknowns along x, and across.

    With mirrored halves the plane's stiffness first + D first D has nothing between the two kinds of unknowns.
    rigid: (k, 6) as for `without_rigid`.
    """
    p, s = half.along, half.turned
    lower = cholesky(2.0 * half.first[:p, :p]), cholesky(2.0 * half.first[p:, p:])
    x, across = half_solved(lower[0], s[:p]), half_solved(lower[1], s[p:])
    turned, rest = x.T @ x, across.T @ across
    first = turned + rest
    first[:p, p:] *= -1.0
    first[p:, :p] *= -1.0
    np.subtract(half.first, first, out=first)
    turned -= rest
    return without_rigid(Prism(first, turned, p, 2.0 * half.length), rigid), lower


def without_rigid(prism: Prism, rigid: Floats) -> Prism:
    """The prism, changed in place, with the forces taken out that rounding gives to its rigid motions.

    They are small beside its stiffest motions, not beside its bending: left in, two to four digits of the bending
    stiffness go. K - W Qᵀ - Q Wᵀ + Q (Qᵀ W) Qᵀ with W = K Q, Q orthonormal rigid motions of both planes.

    rigid : (k, 6) of a plane about its own middle; zero where the class has no such motion
    """
    moved = np.any(rigid != 0.0, axis=0)
    planes = (rigid_at(rigid, x)[:, moved] for x in (-0.5 * prism.length, 0.5 * prism.length))
    q1, q2 = np.split(np.linalg.qr(np.concatenate(list(planes)))[0], 2)
    r1, r2 = prism.reversed(q1), prism.reversed(q2)
    w1 = prism.first @ q1 + prism.reversed(prism.turned @ q2)
    w2 = prism.turned @ r1 + prism.reversed(prism.first @ r2)
    half_product = 0.5 * (q1.T @ w1 + q2.T @ w2)
    w1 -= q1 @ half_product
    w2 -= q2 @ half_product
    subtract_product(prism.first, np.hstack((w1, q1)), np.hstack((q1, w1)))
    before, behind = np.hstack((prism.reversed(w1), r1)), np.hstack((q2, w2))
    subtract_product(prism.turned, 0.5 * np.hstack((before, behind)), np.hstack((behind, before)))
    return prism


def subtract_product(target: Floats, a: Floats, b: Floats) -> None:
    """target -= a bᵀ in place, for a `target` (k, k) that lies row by row; a and b (k, r)."""
    dgemm(-1.0, b, a, 1.0, target.T, trans_b=1, overwrite_c=1)


def rigid_at(rigid: Floats, x: float) -> Floats:
    """Rigid motions (k, 6) of a plane at `x` mm along the bar, from those of the plane at zero."""
    out = rigid.copy()
    out[:, 4] -= x * rigid[:, 2]
    out[:, 5] += x * rigid[:, 1]
    return out


def joined_to_base(held: Floats | None, stretch: Stretch) -> tuple[Floats, Floats | None]:
    """Stiffness (k, k) of the last plane of a stretch behind a part that is fixed at its base, and the factor between.

    held : stiffness of the plane before, None where that is the fixed base itself
    """
    if held is None:
        return stretch.last, None
    lower = cholesky(held + stretch.first)
    through = half_solved(lower, stretch.coupling)
    last = stretch.last
    last -= through.T @ through
    return last, lower
