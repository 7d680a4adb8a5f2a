"""Stiffness matrices of layers that differ in their thickness only, from one integration."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.elasticity import gradient_gram, isotropic_blocks
from fem.material import Isotropic
from fem.part_space import layer_space
from fem.space import Space
from meshes.layers import Layer
from meshes.solid import Floats


@dataclass(frozen=True, eq=False)
class LayerMatrix:
    """∫ ∂N_i/∂x_a ∂N_j/∂x_b dV of a layer 1 mm thick, `gram` (blocks, 3, 3), and the material."""

    space: Space
    material: Isotropic
    gram: Floats

    @staticmethod
    def of(layer: Layer, material: Isotropic) -> "LayerMatrix":
        """The integration over a layer; ValueError if its mesh cannot carry the displacements."""
        space = layer_space(layer.mesh)
        gram = space.summed(lambda cells: gradient_gram(space.gradients[cells], space.weights[cells]))
        return LayerMatrix(space, material, gram.reshape(-1, 3, 3))

    def stiffness(self, thickness: float) -> sp.csr_matrix:
        """Stiffness of the layer `thickness` mm thick, (dofs, dofs) sparse, N/mm.

        A layer drawn along x keeps its derivatives across when it is drawn longer; one along x is divided by the
        thickness, and the volume grows with it: each block by thickness to the power 1 less its derivatives along x.
        """
        along = np.array([1.0, 0.0, 0.0])
        scale = thickness ** (1.0 - along[:, None] - along)
        return self.space.pattern.matrix(isotropic_blocks(self.gram * scale, self.material))
