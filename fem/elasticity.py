"""Linear elasticity of a solid: stiffness matrix, stress, and geometric stiffness of a stressed state.

Each weak form is a batched matrix product over scikit-fem's basis arrays. One product serves all: the
Gram matrix of the shape-function gradients, from which the isotropic law picks its terms.
"""

import numpy as np
import scipy.sparse as sp

from fem.anisotropic import Regional, regional_blocks, regional_stress
from fem.material import Isotropic
from fem.space import Space
from meshes.solid import Floats

IDENTITY = np.eye(3)


def gradient_gram(gradients: Floats, weights: Floats) -> Floats:
    """∫ ∂N_i/∂x_a ∂N_j/∂x_b dV, as (m, k, k, 3, 3) over i, j, a, b."""
    m, q, k, _ = gradients.shape
    flat = gradients.reshape(m, q, 3 * k)
    gram = np.swapaxes(flat * weights[:, :, None], 1, 2) @ flat
    return gram.reshape(m, k, 3, k, 3).transpose(0, 1, 3, 2, 4)


def isotropic_blocks(gram: Floats, material: Isotropic) -> Floats:
    """λ ∂_a N_i ∂_b N_j + μ ∂_b N_i ∂_a N_j + μ δ_ab ∇N_i·∇N_j, integrated, for the Gram blocks (..., 3, 3)."""
    mu = material.shear_modulus
    blocks = material.lame * gram + mu * np.swapaxes(gram, -1, -2)
    trace = mu * np.einsum("...cc->...", gram)
    for a in range(3):
        blocks[..., a, a] += trace
    return blocks


def stiffness_matrix(space: Space, material: Isotropic | Regional) -> sp.csr_matrix:
    """K of ∫ σ(u):ε(v) dV, (dofs, dofs) sparse, N/mm."""
    if isinstance(material, Regional):
        return regional_matrix(space, material)
    # The law is linear in the Gram matrix: applied to the sums it is applied once a block, not once a cell.
    gram = space.summed(lambda cells: gradient_gram(space.gradients[cells], space.weights[cells]))
    return space.pattern.matrix(isotropic_blocks(gram.reshape(-1, 3, 3), material))


def regional_matrix(space: Space, material: Regional) -> sp.csr_matrix:
    """K of several or of orthotropic materials, (dofs, dofs) sparse, N/mm: the law is applied in every cell."""

    def local(cells: slice) -> Floats:
        gram = gradient_gram(space.gradients[cells], space.weights[cells])
        blocks = regional_blocks(gram, material.tensors, material.of_cell[cells])
        return blocks.reshape(*blocks.shape[:3], 9)

    return space.pattern.matrix(space.summed(local).reshape(-1, 3, 3))


def stress(space: Space, material: Isotropic | Regional, u: Floats) -> Floats:
    """Cauchy stress of small displacements `u` at the integration points, (m, q, 3, 3) MPa."""
    gradient = space.displacement_gradient(u)
    strain = 0.5 * (gradient + np.swapaxes(gradient, -1, -2))
    if isinstance(material, Regional):
        return regional_stress(strain, material.tensors, material.of_cell)
    volumetric = np.einsum("...aa->...", strain)[..., None, None]
    return 2.0 * material.shear_modulus * strain + material.lame * volumetric * IDENTITY


def nodal_forces(gradients: Floats, weighted_stress: Floats) -> Floats:
    """∫ P ∇N_i dV, (m, k, 3), for `weighted_stress` = P times the integration weight, (m, q, 3, 3)."""
    m, q, k, _ = gradients.shape
    left = gradients.transpose(0, 2, 1, 3).reshape(m, k, 3 * q)
    return left @ weighted_stress.transpose(0, 1, 3, 2).reshape(m, 3 * q, 3)


def internal_forces(space: Space, sigma: Floats) -> Floats:
    """Nodal forces (dofs,) N that a stress `sigma` (m, q, 3, 3) MPa takes."""
    parts = [
        nodal_forces(space.gradients[cells], sigma[cells] * space.weights[cells][:, :, None, None])
        for cells in space.batches()
    ]
    return space.vector(np.concatenate(parts))


def scalar_geometric_blocks(gradients: Floats, weighted_stress: Floats) -> Floats:
    """∫ ∇N_i·σ·∇N_j dV, (m, k, k), for `weighted_stress` = σ times the integration weight, (m, q, 3, 3)."""
    m, q, k, _ = gradients.shape
    pushed = (gradients @ weighted_stress).transpose(0, 2, 1, 3).reshape(m, k, 3 * q)
    return pushed @ gradients.transpose(0, 1, 3, 2).reshape(m, 3 * q, k)


def nodal_geometric_stiffness(space: Space, sigma: Floats) -> sp.csr_matrix:
    """∫ ∇N_i·σ·∇N_j dV for the stress `sigma` (m, q, 3, 3) MPa, (nodes, nodes) sparse, N/mm.

    K_g of ∫ σ_ab ∂_a u·∂_b v dV has it for each of the three directions and nothing between them.
    """

    def local(cells: slice) -> Floats:
        weighted = sigma[cells] * space.weights[cells][:, :, None, None]
        return scalar_geometric_blocks(space.gradients[cells], weighted)[..., None]

    return space.pattern.nodal(space.summed(local)[:, 0])
