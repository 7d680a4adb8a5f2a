"""Small displacements of a linkage: its Cartesian 6x6 and its response to a driven platform coordinate."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
import scipy.sparse as sp

from fem.anisotropic import Regional
from fem.coarse_space import CORNERS_AND_EDGES, prolongation
from fem.elasticity import stiffness_matrix
from fem.end_states import EndStates
from fem.factor import Factor
from fem.linkage import PLATFORM, Linkage
from fem.material import Isotropic
from fem.reduction import Reduction
from fem.slices.solver import ChainFactor, ChainSolver
from fem.solvers import Solver, automatic
from meshes.solid import Floats, Ints

ROWS_AT_ONCE = 4000


@dataclass(frozen=True)
class LinearModel:
    """A linkage with its stiffness matrices, one for each member.

    known : stiffness matrix of its only member, where that is there already
    states : what is known of the stressed states of its bodies; models of one material on the same meshes may share it
    """

    linkage: Linkage
    material: Isotropic | Regional
    solver: Solver = automatic
    known: sp.csr_matrix | None = None
    states: EndStates = field(default_factory=EndStates)

    @cached_property
    def reduction(self) -> Reduction:
        return Reduction(self.linkage)

    @property
    def isotropic(self) -> Isotropic:
        """The material where it is one, and isotropic; ValueError where large strains cannot be had for it."""
        if isinstance(self.material, Regional):
            raise ValueError("load paths are made of one isotropic material, this part has regions or axes")
        return self.material

    @property
    def matrices(self) -> tuple[sp.csr_matrix, ...]:
        """Stiffness matrix of every member, made anew and not kept; members with the same space share one."""
        if self.known is not None:
            return (self.known,)
        made: dict[int, sp.csr_matrix] = {}
        for member in self.linkage.members:
            if id(member.space) not in made:
                made[id(member.space)] = stiffness_matrix(member.space, self.material)
        return tuple(made[id(member.space)] for member in self.linkage.members)

    @cached_property
    def reduced(self) -> sp.csr_matrix:
        """Stiffness in the linkage's unknowns, sparse symmetric."""
        return self.reduction.reduce(self.matrices, self.reduction.rest)

    def motions(self, driven: Sequence[str], held: Sequence[str], factor: Factor | None = None) -> Floats:
        """Unknowns, (size, len(driven)), for a unit value of each driven coordinate with the `held` ones at zero.

        All other unknowns are free of load; `factor` is that of their stiffness, made here if it is not given.
        Units: mm for translations, rad for rotations.
        """
        r = self.reduction
        free = r.others([*driven, *held])
        columns = r.platform(driven)
        motion = np.zeros((r.size, len(driven)))
        motion[columns, np.arange(len(driven))] = 1.0
        coupling = self.reduced[columns][:, free].toarray().T
        motion[free] = (factor or self.factor(free))(-coupling)
        return motion

    @property
    def has_coarse(self) -> bool:
        """Whether its cells have the coarse space that multigrid needs."""
        return {m.space.mesh.kind for m in self.linkage.members} <= set(CORNERS_AND_EDGES)

    def factor(self, free: Ints, few: bool = False) -> Factor:
        """The stiffness of the unknowns `free`, ready to solve; SolveError if they are not held. few: whether for few
        right-hand sides, which may take more each."""
        if self._by_chain is not None:
            factor: Factor = self._by_chain.part(free)
        else:
            coarse = (lambda: prolongation(self.reduction, free)) if self.has_coarse else None
            made = partial(automatic, few=few) if self.solver is automatic else self.solver
            factor = made(Part(self.reduced, free), coarse)
        factor.require_held()
        return factor

    @cached_property
    def _by_chain(self) -> ChainFactor | None:
        """Of all unknowns, where a chain of slices solves them: any of the generalised coordinates may be held then."""
        factor = self.solver(self.reduced) if isinstance(self.solver, ChainSolver) else None
        return factor if isinstance(factor, ChainFactor) else None

    @property
    def unit_motions(self) -> Floats:
        """Unknowns (size, 6) for a unit of each platform coordinate with the others at zero, mm and rad."""
        return self._units[0]

    @property
    def solved_by(self) -> str:
        """The solver that the unit motions took: "slice chain, quarter section", "pardiso", "SuperLU", .."""
        return self._units[1]

    @cached_property
    def _units(self) -> tuple[Floats, str]:
        factor = self.factor(self.reduction.others(PLATFORM), few=True)
        return self.motions(PLATFORM, (), factor), factor.name

    @cached_property
    def stiffness(self) -> Floats:
        """Cartesian stiffness at the platform point in the base frame, (6, 6), from one factorisation."""
        k = self.energy_products(self.unit_motions)
        return 0.5 * (k + k.T)

    def energy_products(self, motion: Floats) -> Floats:
        """Motionᵀ K motion of unknowns (size, c), (c, c); the error of the motions enters squared only."""
        # Extended precision: entries of 1e7 N/mm cancel to a few N where a bar bends. A few rows at a time, for a
        # whole matrix of such numbers is large.
        wide = motion.astype(np.longdouble)
        total = np.zeros((motion.shape[1], motion.shape[1]), dtype=np.longdouble)
        for start in range(0, len(motion), ROWS_AT_ONCE):
            rows = self.reduced[start : start + ROWS_AT_ONCE].astype(np.longdouble)
            total += wide[start : start + ROWS_AT_ONCE].T @ (rows @ wide)
        return np.asarray(total, dtype=float)


@dataclass(frozen=True, eq=False)
class Part:
    """Rows and columns `kept` (k,) of a sparse square matrix, copied only where they are asked for."""

    whole: sp.csr_matrix
    kept: Ints

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.kept), len(self.kept)

    def tocsr(self) -> sp.csr_matrix:
        return sp.csr_matrix(submatrix(self.whole, self.kept))


def submatrix(matrix: sp.csr_matrix, kept: Ints) -> sp.csr_matrix:
    """Rows and columns `kept` (k,), in rising order, of a sparse square matrix."""
    count = len(kept)
    if count and kept[-1] == count - 1:
        return matrix[:count, :count]
    return matrix[kept][:, kept]
