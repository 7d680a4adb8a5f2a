"""Displacement space of a solid mesh: shape-function gradients at the integration points, and block assembly.

Unknown 3 n + a is the displacement of node n along axis a of the mesh's own frame.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from meshes.discrete import discretise
from meshes.solid import Floats, Ints, SolidMesh


@dataclass(frozen=True)
class BlockPattern:
    """Where the 3x3 block of every pair of local nodes goes in the global block matrix."""

    order: Ints
    starts: Ints
    indices: Ints
    indptr: Ints

    @staticmethod
    def of(connectivity: Ints, nodes: int) -> "BlockPattern":
        """Pattern for cells (m, k) over `nodes` nodes."""
        keys = (connectivity[:, :, None] * nodes + connectivity[:, None, :]).ravel()
        order = np.argsort(keys, kind="stable")
        ordered = keys[order]
        starts = np.flatnonzero(np.concatenate(([True], ordered[1:] != ordered[:-1])))
        rows, columns = np.divmod(ordered[starts], nodes)
        indptr = np.searchsorted(rows, np.arange(nodes + 1))
        return BlockPattern(order, starts, columns, indptr)


@dataclass(frozen=True)
class Space:
    """Quadratic displacement space.

    gradients : (m, q, k, 3) of the k shape functions at q points in m cells, 1/mm
    weights   : (m, q) integration weights, mm³
    connectivity : (m, k) node of each local function
    """

    mesh: SolidMesh
    gradients: Floats
    weights: Floats
    connectivity: Ints

    @staticmethod
    def of(mesh: SolidMesh) -> "Space":
        """The space of a mesh; ValueError if the mesh cannot carry it."""
        discrete = discretise(mesh)
        basis = discrete.basis
        gradients = np.stack([function[0].grad for function in basis.basis], axis=-1)
        return Space(
            mesh,
            np.ascontiguousarray(gradients.transpose(1, 2, 3, 0)),
            np.asarray(basis.dx),
            discrete.connectivity,
        )

    @property
    def dofs(self) -> int:
        return self.mesh.dofs

    @cached_property
    def pattern(self) -> BlockPattern:
        return BlockPattern.of(self.connectivity, len(self.mesh.points))

    def matrix(self, local: Floats) -> sp.csr_matrix:
        """Sum local blocks (m, k, k, 3, 3) into the sparse (dofs, dofs) matrix."""
        p = self.pattern
        blocks = np.add.reduceat(local.reshape(-1, 9)[p.order], p.starts, axis=0).reshape(-1, 3, 3)
        return sp.bsr_matrix((blocks, p.indices, p.indptr), shape=(self.dofs, self.dofs)).tocsr()

    def vector(self, local: Floats) -> Floats:
        """Sum local nodal vectors (m, k, 3) into a (dofs,) vector."""
        nodes = self.connectivity.ravel()
        flat = local.reshape(-1, 3)
        count = len(self.mesh.points)
        sums = [np.bincount(nodes, flat[:, a], count) for a in range(3)]
        return np.stack(sums, axis=1).ravel().astype(float)

    def displacement_gradient(self, u: Floats) -> Floats:
        """∂u_a/∂X_b at the integration points, (m, q, 3, 3), of nodal displacements `u`, (dofs,) mm."""
        local = u.reshape(-1, 3)[self.connectivity]
        return np.swapaxes(local, 1, 2)[:, None] @ self.gradients
