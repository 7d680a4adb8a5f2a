"""A solid mesh as scikit-fem sees it, with the map from its scalar unknowns to our nodes."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
import skfem

from meshes.solid import Ints, SolidMesh

ELEMENTS = {
    "hexahedron20": skfem.ElementHexS2,
    "hexahedron27": skfem.ElementHex2,
    "tetra10": skfem.ElementTetP2,
}
FUNCTIONS = [0, 4, 3, 1, 7, 5, 2, 6, 16, 11, 8, 15, 12, 19, 10, 17, 9, 14, 13, 18, 20, 24, 22, 23, 25, 21, 26]
"""Nodes of a hexahedron, as VTK counts them, of scikit-fem's functions in their order: corners, edges, faces, middle.
Written here, as scikit-fem's own list brings the whole of meshio with it."""
# Full integration with positive weights: 27 points in a hexahedron, 14 in a tetrahedron.
INTEGRATION_ORDER = 5


@dataclass(frozen=True)
class Discrete:
    """scikit-fem's scalar basis of a solid mesh, and `nodes[k]`: our node of its unknown k."""

    basis: skfem.Basis
    nodes: Ints

    @property
    def connectivity(self) -> Ints:
        """(m, k) node of each local function in each cell."""
        return np.ascontiguousarray(self.nodes[self.basis.element_dofs].T)

    def face_mass(self, x: float) -> sp.csr_matrix:
        """∫ N_i N_j dA over the boundary face at `x` mm, sparse over our nodes, mm².

        Raises ValueError if no boundary facet lies there.
        """
        mesh = self.basis.mesh
        extent = float(np.ptp(mesh.p[0]))
        facets = mesh.facets_satisfying(lambda p: np.abs(p[0] - x) < 1e-6 * extent, boundaries_only=True)
        if not len(facets):
            raise ValueError(f"no face of the mesh lies at x = {x:g} mm")
        face = skfem.FacetBasis(mesh, self.basis.elem, facets=facets, intorder=INTEGRATION_ORDER)
        mass = skfem.BilinearForm(lambda u, v, _: u * v).assemble(face).tocoo()
        shape = (len(self.nodes), len(self.nodes))
        return sp.csr_matrix((mass.data, (self.nodes[mass.row], self.nodes[mass.col])), shape=shape)


def discretise(mesh: SolidMesh) -> Discrete:
    """Build the scalar basis of the quadratic element that belongs to the mesh kind.

    Raises ValueError if a cell is inside out or the unknowns do not sit on the nodes of the mesh.
    """
    basis = skfem.Basis(as_skfem(mesh), ELEMENTS[mesh.kind](), intorder=INTEGRATION_ORDER)
    determinant = basis.mapping.detDF(basis.X)
    if np.any(determinant * np.sign(determinant[:, :1]) <= 0.0):
        raise ValueError("the mesh has a cell of zero or negative volume, allowed are cells right side out")
    cells = mesh.cells if mesh.kind == "tetra10" else mesh.cells[:, FUNCTIONS[: mesh.cells.shape[1]]]
    node = np.zeros(basis.N, dtype=np.int64)
    node[basis.element_dofs] = cells.T
    extent = float(np.ptp(mesh.points, axis=0).max())
    off = np.abs(basis.doflocs[:, basis.element_dofs].T - mesh.points[cells]).max()
    if off > 1e-6 * extent or len(np.unique(node)) != len(mesh.points):
        raise ValueError(
            "the mesh has mid-edge nodes off the middle of straight edges, which this cell does not take"
        )
    return Discrete(basis, node)


def as_skfem(mesh: SolidMesh) -> skfem.Mesh:
    """The scikit-fem mesh: straight-edged for 20-node cells, curved for 27-node hexahedra and 10-node tetrahedra."""
    if mesh.kind == "hexahedron27":
        return skfem.MeshHex2(
            np.ascontiguousarray(mesh.points.T),
            np.ascontiguousarray(mesh.cells.T[FUNCTIONS]),
            validate=False,
        )
    if mesh.kind == "tetra10":
        return skfem.MeshTet2(
            np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.cells.T), validate=False
        )
    corners, numbering = np.unique(mesh.cells[:, :8], return_inverse=True)
    cells = numbering.reshape(-1, 8).T[FUNCTIONS[:8]]
    return skfem.MeshHex(
        np.ascontiguousarray(mesh.points[corners].T), np.ascontiguousarray(cells), validate=False
    )
