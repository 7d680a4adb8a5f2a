"""Small displacements of a linkage: its Cartesian 6x6 and its response to a driven platform coordinate."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.elasticity import stiffness_matrix
from fem.linkage import PLATFORM, Linkage
from fem.material import Isotropic
from fem.reduction import Reduction
from fem.solvers import Solver, direct
from meshes.solid import Floats


@dataclass(frozen=True)
class LinearModel:
    """A linkage with its stiffness matrices, one for each member."""

    linkage: Linkage
    material: Isotropic
    solver: Solver = direct

    @cached_property
    def reduction(self) -> Reduction:
        return Reduction(self.linkage)

    @cached_property
    def matrices(self) -> tuple[sp.csr_matrix, ...]:
        """Stiffness matrix of every member; members with the same space share one."""
        made: dict[int, sp.csr_matrix] = {}
        for member in self.linkage.members:
            if id(member.space) not in made:
                made[id(member.space)] = stiffness_matrix(member.space, self.material)
        return tuple(made[id(member.space)] for member in self.linkage.members)

    @cached_property
    def reduced(self) -> sp.csr_matrix:
        """Stiffness in the linkage's unknowns, sparse symmetric."""
        return self.reduction.reduce(self.matrices, self.reduction.rest)

    def motions(self, driven: Sequence[str], held: Sequence[str]) -> Floats:
        """Unknowns, (size, len(driven)), for a unit value of each driven coordinate with the `held` ones at zero.

        All other unknowns are free of load. Units: mm for translations, rad for rotations.
        """
        r = self.reduction
        free = r.others([*driven, *held])
        columns = r.platform(driven)
        motion = np.zeros((r.size, len(driven)))
        motion[columns, np.arange(len(driven))] = 1.0
        coupling = self.reduced[free][:, columns].toarray()
        inner = self.reduced[free][:, free].tocsr()
        factor = self.solver(inner)
        found = factor(-coupling)
        # One round of iterative refinement: the 6x6 mixes N/mm with N mm/rad, eleven orders of magnitude.
        motion[free] = found - factor(inner @ found + coupling)
        return motion

    @cached_property
    def stiffness(self) -> Floats:
        """Cartesian stiffness at the platform point in the base frame, (6, 6), from one factorisation."""
        k = self.energy_products(self.motions(PLATFORM, ()))
        return 0.5 * (k + k.T)

    def energy_products(self, motion: Floats) -> Floats:
        """Motionᵀ K motion of unknowns (size, c), (c, c); the error of the motions enters squared only."""
        # Extended precision: entries of 1e7 N/mm cancel to a few N where a bar bends.
        wide = motion.astype(np.longdouble)
        product = self.reduced.astype(np.longdouble) @ wide
        return np.asarray(wide.T @ product, dtype=float)
