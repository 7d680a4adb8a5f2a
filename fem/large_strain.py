"""Total-Lagrangian solid: nodal forces and tangent at finite displacements, Saint Venant-Kirchhoff law.

With g_i = F ∇N_i the tangent is  λ g_i⊗g_j + μ g_j⊗g_i + μ (∇N_i·∇N_j) F Fᵀ + (∇N_i·S·∇N_j) I.
"""

import numpy as np
import scipy.sparse as sp

from fem.elasticity import IDENTITY, gradient_gram, nodal_forces
from fem.material import Isotropic
from fem.space import Space
from meshes.solid import Floats


def force_and_tangent(space: Space, material: Isotropic, u: Floats) -> tuple[Floats, sp.csr_matrix]:
    """Nodal forces (dofs,) N and tangent (dofs, dofs) N/mm of nodal displacements `u`, (dofs,) mm."""
    force = np.empty((*space.connectivity.shape, 3))
    deformation = IDENTITY + space.displacement_gradient(u)

    def local(cells: slice) -> Floats:
        gradients, weights, f = space.gradients[cells], space.weights[cells], deformation[cells]
        weighted = second_piola(f, material) * weights[:, :, None, None]
        force[cells] = nodal_forces(gradients, f @ weighted)
        return tangent_blocks(gradients, weights, f, weighted, material)

    tangent = space.pattern.matrix(space.summed(local).reshape(-1, 3, 3))
    return space.vector(force), tangent


def deformed_forces(space: Space, material: Isotropic, u: Floats) -> Floats:
    """The nodal forces alone, (dofs,) N."""
    deformation = IDENTITY + space.displacement_gradient(u)
    parts = []
    for cells in space.batches():
        f = deformation[cells]
        weighted = second_piola(f, material) * space.weights[cells][:, :, None, None]
        parts.append(nodal_forces(space.gradients[cells], f @ weighted))
    return space.vector(np.concatenate(parts))


def second_piola(f: Floats, material: Isotropic) -> Floats:
    """Second Piola-Kirchhoff stress, (..., 3, 3) MPa, of deformation gradients `f`."""
    strain = 0.5 * (np.swapaxes(f, -1, -2) @ f - IDENTITY)
    trace = np.einsum("...aa->...", strain)[..., None, None]
    return material.lame * trace * IDENTITY + 2.0 * material.shear_modulus * strain


def tangent_blocks(
    gradients: Floats, weights: Floats, f: Floats, weighted_stress: Floats, material: Isotropic
) -> Floats:
    """Integrated tangent, (m, k, k, 3, 3) over i, j, a, b."""
    gram = gradient_gram(gradients @ np.swapaxes(f, -1, -2), weights)
    blocks = material.lame * gram + material.shear_modulus * np.swapaxes(gram, -1, -2)
    m, q, k, _ = gradients.shape
    left = gradients.transpose(0, 2, 1, 3).reshape(m, k, 3 * q)
    right = np.ascontiguousarray(gradients.transpose(0, 1, 3, 2)).reshape(m, 3 * q, k)
    left_cauchy = (f @ np.swapaxes(f, -1, -2)) * (material.shear_modulus * weights[:, :, None, None])
    geometric = (gradients @ weighted_stress).transpose(0, 2, 1, 3).reshape(m, k, 3 * q) @ right
    for a in range(3):
        for b in range(a, 3):
            scale = np.repeat(left_cauchy[:, :, a, b], 3, axis=1)
            product = (left * scale[:, None, :]) @ right
            blocks[..., a, b] += product
            if a != b:
                blocks[..., b, a] += product
        blocks[..., a, a] += geometric
    return blocks
