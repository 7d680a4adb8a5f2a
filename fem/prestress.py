"""The stressed state of a linkage and its geometric stiffness."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.factor import Factor
from fem.linear import LinearModel
from fem.linkage import PLATFORM
from fem.reduction import Placement, Reduction
from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class GeometricStiffness:
    """K_g of a linkage as far as it multiplies columns (n, r) of its unknowns, or of some of them.

    nodal     : of each member, sparse (nodes, nodes) N/mm: of one direction, for it is alike in all three
    spreads   : of each member, sparse (dofs, n): node displacements of the unknowns
    curvature : (n, n) sparse, of the rigid faces: what nodal forces do as a face turns
    """

    nodal: tuple[sp.csr_matrix, ...]
    spreads: tuple[sp.csr_matrix, ...]
    curvature: sp.csr_matrix

    @staticmethod
    def of(
        r: Reduction, nodal: Sequence[sp.csr_matrix], curvature: Floats, at: Placement
    ) -> "GeometricStiffness":
        """In all unknowns; curvature: (generalised, generalised)."""
        inner = sp.csr_matrix((r.starts[-1], r.starts[-1]))
        corner = sp.block_diag((inner, curvature), format="csr")
        return GeometricStiffness(tuple(nodal), r.spreads(at), sp.csr_matrix(corner))

    def within(self, kept: Ints) -> "GeometricStiffness":
        """Of the unknowns `kept` alone, in rising order."""
        spreads = tuple(sp.csr_matrix(s[:, kept]) for s in self.spreads)
        return GeometricStiffness(self.nodal, spreads, sp.csr_matrix(self.curvature[kept][:, kept]))

    def __matmul__(self, motion: Floats) -> Floats:
        out = self.curvature @ motion
        for nodal, spread in zip(self.nodal, self.spreads, strict=True):
            u = spread @ motion
            force = nodal @ u.reshape(nodal.shape[0], -1)
            out += spread.T @ force.reshape(u.shape)
        return np.asarray(out)


@dataclass(frozen=True, eq=False)
class Prestress:
    """A state of small displacements and what it adds to the stiffness.

    displacements : node displacements (dofs,) of each member in its own frame, mm
    wrench        : (6,) exerted on the platform at its point, base frame, N and N·mm
    geometric     : geometric stiffness in the linkage's unknowns, as a product
    """

    displacements: tuple[Floats, ...]
    wrench: Floats
    geometric: GeometricStiffness


def prestress(
    model: LinearModel, driven: str, held: Sequence[str], factor: Factor | None = None
) -> Prestress:
    """Drive one platform coordinate by a unit, mm or rad, with the `held` ones at zero and the rest free of load.

    `factor` as in `LinearModel.motions`.
    """
    return stressed(model, model.motions([driven], held, factor)[:, 0])


def stressed(model: LinearModel, motion: Floats) -> Prestress:
    """The state of a small `motion` (size,) of all unknowns, inner nodes free of load."""
    r = model.reduction
    fields = r.fields(motion, r.rest)
    members = zip(model.linkage.members, fields, strict=True)
    states = [model.states.of(member.space, model.material, u) for member, u in members]
    curvature = r.curvature([state.forces for state in states], r.rest)
    geometric = GeometricStiffness.of(r, [state.geometric for state in states], curvature, r.rest)
    wrench = np.asarray(model.reduced @ motion)[r.platform(PLATFORM)]
    return Prestress(fields, wrench, geometric)
