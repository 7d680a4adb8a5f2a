"""The chain of slices as a linear solver: for the elastic stiffness of linkages whose bars are swept meshes.

The inner unknowns of a bar, both faces held, are solved by its chain. The few generalised coordinates of the rigid
faces come by their Schur complement.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.anisotropic import Regional
from fem.factor import Factor, SolveError, Sparse
from fem.linkage import Linkage
from fem.material import Isotropic
from fem.reduction import Reduction
from fem.slices.chain import Chain
from fem.solvers import Coarse, Solver, automatic
from meshes.layers import as_sweep
from meshes.solid import Floats, Ints, SolidMesh

# Relative to the largest force: a matrix that differs more is not that of the chain, but a tangent of a stressed state.
SAME_MATRIX = 1e-9


@dataclass(frozen=True, eq=False)
class ChainSolver:
    """A `Solver` for the stiffness of one linkage; other matrices go to `otherwise`.

    known : the chain of its members, where that is there already and all are on one mesh
    Raises ValueError when first used if a mesh of the linkage is no sweep (`meshes.layers.as_sweep` says why).
    """

    linkage: Linkage
    material: Isotropic
    otherwise: Solver = automatic
    known: Chain | None = None

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """Of every member; members with the same space share one."""
        if self.known is not None:
            return (self.known,) * len(self.linkage.members)
        made: dict[int, Chain] = {}
        for member in self.linkage.members:
            if id(member.space) not in made:
                made[id(member.space)] = Chain.of(as_sweep(member.space.mesh), self.material)
        return tuple(made[id(member.space)] for member in self.linkage.members)

    @cached_property
    def reduction(self) -> Reduction:
        return Reduction(self.linkage)

    def __call__(self, matrix: Sparse, coarse: Coarse | None = None) -> Factor:
        whole = matrix.tocsr()
        if self.is_own(whole):
            return ChainFactor(Bordered.of(whole, self.chains, self.reduction))
        return self.otherwise(matrix, coarse)

    def is_own(self, matrix: sp.csr_matrix) -> bool:
        """Whether the matrix multiplies the inner unknowns as the chains do."""
        r = self.reduction
        inner = r.starts[-1]
        if not inner <= matrix.shape[0] <= r.size:
            return False
        x = np.random.default_rng(0).standard_normal(inner)
        wanted = (matrix @ np.concatenate((x, np.zeros(matrix.shape[0] - inner))))[:inner]
        found = inner_forces(x[:, None], self.chains, r)[:, 0]
        return bool(np.abs(found - wanted).max() <= SAME_MATRIX * np.abs(wanted).max())


SolverOf = Callable[[Linkage], Solver]


def by_chain(mesh: SolidMesh, material: Isotropic | Regional) -> SolverOf:
    """The solver of every linkage of bars on this mesh: one chain of slices for all, where the mesh is a sweep of one
    isotropic material, else the automatic one."""
    if isinstance(material, Regional):
        return lambda _: automatic
    try:
        chain = Chain.of(as_sweep(mesh), material)
    except ValueError:
        return lambda _: automatic
    return lambda linkage: ChainSolver(linkage, material, known=chain)


@dataclass(frozen=True, eq=False)
class Bordered:
    """A linkage's matrix by its chains: n inner unknowns, then g generalised coordinates.

    scale, nonzeros : its largest entry, and the number of its entries
    border : (n, g) of inner unknowns and generalised coordinates; `corner` (g, g) of these
    answer : (n, g) inner unknowns of the loads `border`, all faces held
    """

    chains: tuple[Chain, ...]
    reduction: Reduction
    scale: float
    nonzeros: int
    border: Floats
    corner: Floats
    answer: Floats

    @staticmethod
    def of(matrix: sp.csr_matrix, chains: tuple[Chain, ...], reduction: Reduction) -> "Bordered":
        """Of all inner unknowns and some generalised coordinates, in this order."""
        inner = reduction.starts[-1]
        ends = matrix[inner:]
        border = ends[:, :inner].toarray().T
        scale = max(float(matrix.data.max()), -float(matrix.data.min()))
        answer = inner_solved(border, chains, reduction)
        return Bordered(chains, reduction, scale, matrix.nnz, border, ends[:, inner:].toarray(), answer)

    def part(self, held: Ints) -> "Bordered":
        """With some of the generalised coordinates alone."""
        return replace(
            self,
            border=self.border[:, held],
            corner=self.corner[np.ix_(held, held)],
            answer=self.answer[:, held],
        )

    @property
    def shape(self) -> tuple[int, int]:
        size = sum(self.border.shape)
        return size, size

    @property
    def nnz(self) -> int:
        return self.nonzeros

    def __matmul__(self, x: Floats) -> Floats:
        columns = x.reshape(len(x), -1)
        inner, ends = columns[: len(self.border)], columns[len(self.border) :]
        forces = inner_forces(inner, self.chains, self.reduction) + self.border @ ends
        return np.concatenate((forces, self.border.T @ inner + self.corner @ ends)).reshape(x.shape)


def inner_forces(motions: Floats, chains: Sequence[Chain], reduction: Reduction) -> Floats:
    """Forces on the inner unknowns (n, r) for motions of them, all faces held."""
    return _by_member(motions, chains, reduction, Chain.product)


def inner_solved(loads: Floats, chains: Sequence[Chain], reduction: Reduction) -> Floats:
    """Inner unknowns (n, r) for loads on them, all faces held."""
    return _by_member(loads, chains, reduction, Chain.solve)


def _by_member(
    given: Floats, chains: Sequence[Chain], r: Reduction, work: Callable[[Chain, Floats], Floats]
) -> Floats:
    out = np.empty_like(given)
    if not given.shape[1]:
        return out
    for i, chain in enumerate(chains):
        own = slice(r.starts[i], r.starts[i + 1])
        nodal = np.zeros((chain.swept.mesh.dofs, given.shape[1]))
        nodal[r.inner[i]] = given[own]
        out[own] = work(chain, nodal)[r.inner[i]]
    return out


class ChainFactor(Factor):
    """The stiffness of a linkage's unknowns: all inner ones, then some generalised coordinates."""

    def __init__(self, whole: Bordered) -> None:
        self.whole = whole
        self.name = whole.chains[0].name
        self.begin(whole, whole.scale)

    def prepare(self) -> None:
        self.schur = self.whole.corner - self.whole.border.T @ self.whole.answer
        self.negative = int(np.count_nonzero(np.linalg.eigvalsh(self.schur) < 0.0))

    def part(self, kept: Ints) -> "ChainFactor":
        """Of some of its unknowns, in rising order, all inner ones among them: nothing is solved again."""
        inner = len(self.whole.border)
        return ChainFactor(self.whole.part(kept[inner:] - inner))

    @property
    def negative_eigenvalues(self) -> int:
        """Of the Schur complement alone: what the chain solves is positive definite."""
        return self.negative

    def renewed(self, matrix: sp.csr_matrix) -> Factor:
        """Of another matrix, which the chain does not know."""
        return automatic(matrix)

    def solve(self, rhs: Floats) -> Floats:
        columns, whole = rhs.reshape(len(rhs), -1), self.whole
        count = len(whole.border)
        inner = inner_solved(columns[:count], whole.chains, whole.reduction)
        try:
            ends = np.linalg.solve(self.schur, columns[count:] - whole.border.T @ inner)
        except np.linalg.LinAlgError as error:
            raise SolveError("the linear system is singular: the model is not held") from error
        return np.concatenate((inner - whole.answer @ ends, ends)).reshape(rhs.shape)
