"""Displacement space of a solid mesh: shape-function gradients at the integration points, and assembly.

Unknown 3 n + a is the displacement of node n along axis a of the mesh's own frame.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np

from fem.pattern import SymmetricPattern
from meshes.solid import Floats, Ints, SolidMesh

# Bounds the memory of a batch to a few hundred megabytes whatever the mesh.
CELLS_AT_ONCE = 4000


@dataclass(frozen=True)
class Space:
    """Quadratic displacement space.

    gradients : (m, q, k, 3) of the k shape functions at q points in m cells, 1/mm
    weights   : (m, q) integration weights, mm³
    connectivity : (m, k) node of each local function, in rising order
    """

    mesh: SolidMesh
    gradients: Floats
    weights: Floats
    connectivity: Ints

    @staticmethod
    def of(mesh: SolidMesh) -> "Space":
        """The space of a mesh; ValueError if the mesh cannot carry it."""
        # Late: scikit-fem takes half a second to import, which a chain of slices does without.
        from meshes.discrete import discretise

        discrete = discretise(mesh)
        basis = discrete.basis
        order = np.argsort(discrete.connectivity, axis=1)
        gradients = np.empty((*basis.dx.shape, order.shape[1], 3))
        for k, function in enumerate(basis.basis):
            gradients[:, :, k] = np.moveaxis(function[0].grad, 0, -1)
        return Space(
            mesh,
            np.take_along_axis(gradients, order[:, None, :, None], axis=2),
            np.asarray(basis.dx),
            np.take_along_axis(discrete.connectivity, order, axis=1),
        )

    @property
    def dofs(self) -> int:
        return self.mesh.dofs

    @cached_property
    def pattern(self) -> SymmetricPattern:
        return SymmetricPattern.of(self.connectivity, len(self.mesh.points))

    def batches(self) -> Iterator[slice]:
        """Slices over the cells."""
        for start in range(0, len(self.weights), CELLS_AT_ONCE):
            yield slice(start, start + CELLS_AT_ONCE)

    def summed(self, local: Callable[[slice], Floats]) -> Floats:
        """(count, c) of `pattern`, for values (m, k, k, c) of the cells in a slice, symmetric in the node pairs."""
        first, second = np.triu_indices(self.connectivity.shape[1])
        parts = (self.pattern.summed(cells, local(cells)[:, first, second]) for cells in self.batches())
        return reduce(np.add, parts)

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
