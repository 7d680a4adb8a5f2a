"""The chain of slices as a linear solver: for the elastic stiffness of linkages whose bars are swept meshes.

The inner unknowns of a bar, both faces held, are solved by its chain. The few generalised coordinates of the rigid
faces come by their Schur complement.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.factor import Factor, SolveError
from fem.linkage import Linkage
from fem.material import Isotropic
from fem.reduction import Reduction
from fem.slices.chain import Chain
from fem.solvers import Coarse, Solver, automatic
from meshes.layers import as_sweep
from meshes.solid import Floats

# Relative to the largest force: a matrix that differs more is not that of the chain, but a tangent of a stressed state.
SAME_MATRIX = 1e-9


@dataclass(frozen=True, eq=False)
class ChainSolver:
    """A `Solver` for the stiffness of one linkage; other matrices go to `otherwise`.

    Raises ValueError when first used if a mesh of the linkage is no sweep (`meshes.layers.as_sweep` says why).
    """

    linkage: Linkage
    material: Isotropic
    otherwise: Solver = automatic

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """Of every member; members with the same space share one."""
        made: dict[int, Chain] = {}
        for member in self.linkage.members:
            if id(member.space) not in made:
                made[id(member.space)] = Chain.of(as_sweep(member.space.mesh), self.material)
        return tuple(made[id(member.space)] for member in self.linkage.members)

    @cached_property
    def reduction(self) -> Reduction:
        return Reduction(self.linkage)

    def __call__(self, matrix: sp.spmatrix, coarse: Coarse | None = None) -> Factor:
        matrix = matrix.tocsr()
        if self.is_own(matrix):
            return ChainFactor(matrix, self.chains, self.reduction)
        return self.otherwise(matrix, coarse)

    def is_own(self, matrix: sp.csr_matrix) -> bool:
        """Whether the matrix multiplies the inner unknowns as the chains do."""
        r = self.reduction
        inner = r.starts[-1]
        if not inner <= matrix.shape[0] <= r.size:
            return False
        x = np.random.default_rng(0).standard_normal(inner)
        wanted = (matrix @ np.concatenate((x, np.zeros(matrix.shape[0] - inner))))[:inner]
        found = np.concatenate([chain.product(u)[d] for chain, u, d in self._fields(x)])
        return bool(np.abs(found - wanted).max() <= SAME_MATRIX * np.abs(wanted).max())

    def _fields(self, x: Floats) -> list[tuple[Chain, Floats, np.ndarray]]:
        """Each member's chain, its node displacements for inner unknowns `x`, and the inner dofs."""
        r = self.reduction
        found = []
        for i, chain in enumerate(self.chains):
            u = np.zeros(chain.swept.mesh.dofs)
            u[r.inner[i]] = x[r.starts[i] : r.starts[i + 1]]
            found.append((chain, u, r.inner[i]))
        return found


class ChainFactor(Factor):
    """The stiffness of a linkage's unknowns: all inner ones, then some generalised coordinates."""

    matrix: sp.csr_matrix

    def __init__(self, matrix: sp.csr_matrix, chains: Sequence[Chain], reduction: Reduction) -> None:
        self.chains, self.reduction = chains, reduction
        self.name = chains[0].name
        super().__init__(matrix)

    def prepare(self) -> None:
        self.inner = self.reduction.starts[-1]
        self.border = self.matrix[: self.inner, self.inner :].toarray()
        self.answer = self.inner_solved(self.border)
        corner = self.matrix[self.inner :, self.inner :].toarray()
        self.schur = corner - self.border.T @ self.answer
        self.negative = int(np.count_nonzero(np.linalg.eigvalsh(self.schur) < 0.0))

    @property
    def negative_eigenvalues(self) -> int:
        """Of the Schur complement alone: what the chain solves is positive definite."""
        return self.negative

    def renewed(self, matrix: sp.csr_matrix) -> Factor:
        """Of another matrix, which the chain does not know."""
        return automatic(matrix)

    def inner_solved(self, loads: Floats) -> Floats:
        """Inner unknowns (n, r) for loads on them, all faces held."""
        r = self.reduction
        out = np.empty_like(loads)
        if not loads.shape[1]:
            return out
        for i, chain in enumerate(self.chains):
            own = slice(r.starts[i], r.starts[i + 1])
            nodal = np.zeros((chain.swept.mesh.dofs, loads.shape[1]))
            nodal[r.inner[i]] = loads[own]
            out[own] = chain.solve(nodal)[r.inner[i]]
        return out

    def solve(self, rhs: Floats) -> Floats:
        columns = rhs.reshape(len(rhs), -1)
        inner = self.inner_solved(columns[: self.inner])
        try:
            ends = np.linalg.solve(self.schur, columns[self.inner :] - self.border.T @ inner)
        except np.linalg.LinAlgError as error:
            raise SolveError("the linear system is singular: the model is not held") from error
        return np.concatenate((inner - self.answer @ ends, ends)).reshape(rhs.shape)
