"""Laws that every elastic body keeps, on distorted cells of all three kinds; and scikit-fem's own weak form."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp
import skfem
from scipy.spatial import cKDTree
from skfem.models.elasticity import linear_elasticity

from fem import space
from fem.elasticity import nodal_geometric_stiffness, stiffness_matrix, stress
from fem.material import Isotropic
from fem.reduction import node_dofs
from fem.rigid_motions import rigid_motions
from fem.solvers import direct
from fem.space import Space
from meshes.discrete import ELEMENTS, INTEGRATION_ORDER, as_skfem
from meshes.solid import SolidMesh

# Any displacement gradient without special directions.
GRADIENT = np.array([[1.0, 0.4, -0.3], [0.2, -0.7, 0.5], [0.9, 0.1, 0.6]]) * 1e-3


def test_patch(small: SolidMesh, small_space: Space, material: Isotropic) -> None:
    """A linear field on the surface is reproduced inside, with constant stress (Hooke's law by hand)."""
    k = stiffness_matrix(small_space, material)
    surface = np.unique(np.concatenate([small.face_nodes(name) for name in small.faces]))
    held = node_dofs(surface)
    inner = np.setdiff1d(np.arange(small.dofs), held)
    assert len(inner) > 10
    exact = (small.points @ GRADIENT.T).ravel()
    u = exact.copy()
    u[inner] = direct(k[inner][:, inner])(-(k[inner][:, held] @ exact[held]))
    assert np.abs(u - exact).max() < 1e-10 * np.abs(exact).max()
    strain = (GRADIENT + GRADIENT.T) / 2
    e, nu = material.E, material.nu
    expected = e / (1 + nu) * (strain + nu / (1 - 2 * nu) * np.trace(strain) * np.eye(3))
    assert np.abs(stress(small_space, material, u) - expected).max() < 1e-9 * np.abs(expected).max()


def test_rigid_motions_give_no_force(small: SolidMesh, small_space: Space, material: Isotropic) -> None:
    k = stiffness_matrix(small_space, material)
    motions = rigid_motions(small.points)
    motions = motions / np.abs(motions).max(axis=0)
    assert np.abs(k @ motions).max() < 1e-10 * np.abs(k).max()


@pytest.mark.parametrize(
    "small",
    ["hexahedron20", "hexahedron27", pytest.param("tetra10", marks=pytest.mark.long)],
    indirect=True,
)
def test_stiffness_is_symmetric_with_six_zero_eigenvalues(small_space: Space, material: Isotropic) -> None:
    k = stiffness_matrix(small_space, material).toarray()
    assert np.abs(k - k.T).max() < 1e-12 * np.abs(k).max()
    eigenvalues = np.linalg.eigvalsh(k)
    assert np.abs(eigenvalues[:6]).max() < 1e-10 * eigenvalues[-1]
    # The seventh is the softest bending of a short bar: five orders below the stiffest, far above rounding.
    assert eigenvalues[6] > 1e-6 * eigenvalues[-1]


def test_stiffness_equals_scikit_fem(small: SolidMesh, small_space: Space, material: Isotropic) -> None:
    """Our batched products against `BilinearForm` with vector elements, entry by entry."""
    basis = skfem.Basis(
        as_skfem(small), skfem.ElementVector(ELEMENTS[small.kind]()), intorder=INTEGRATION_ORDER
    )
    form = linear_elasticity(material.lame, material.shear_modulus)
    theirs = form.assemble(basis).tocoo()
    component = np.full(basis.N, -1)
    for dofs in (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs):
        for row, numbers in enumerate(dofs):
            component[numbers] = row % 3
    assert component.min() == 0
    distance, node = cKDTree(small.points).query(basis.doflocs.T)
    assert distance.max() < 1e-9
    ours = 3 * node + component
    renumbered = sp.csr_matrix((theirs.data, (ours[theirs.row], ours[theirs.col])), shape=theirs.shape)
    difference = stiffness_matrix(small_space, material) - renumbered
    assert abs(difference).max() < 1e-12 * abs(renumbered).max()


def test_geometric_stiffness_is_stress_times_slopes(small: SolidMesh, small_space: Space) -> None:
    """For linear fields u, v in a constant stress, u K_g v = V tr(G_u σ G_vᵀ); rigid translations feel nothing."""
    sigma = np.array([[-50.0, 7.0, 3.0], [7.0, 20.0, -4.0], [3.0, -4.0, 11.0]])
    kg = nodal_geometric_stiffness(
        small_space, np.broadcast_to(sigma, (*small_space.weights.shape, 3, 3)).copy()
    )
    other = GRADIENT[::-1] - 2e-3 * np.eye(3)
    u, v = (small.points @ g.T for g in (GRADIENT, other))
    expected = small_space.weights.sum() * np.trace(GRADIENT @ sigma @ other.T)
    np.testing.assert_allclose(np.sum(u * (kg @ v)), expected, rtol=1e-10)
    assert np.abs(kg @ np.ones(len(small.points))).max() < 1e-10 * abs(kg).max()


def test_batches_do_not_change_the_matrix(
    small_space: Space, material: Isotropic, monkeypatch: object
) -> None:
    """Cells are taken a few at a time: the seams must not show."""
    whole = stiffness_matrix(small_space, material)
    assert len(small_space.weights) < space.CELLS_AT_ONCE
    monkeypatch.setattr(space, "CELLS_AT_ONCE", 3)  # type: ignore[attr-defined]
    assert abs(stiffness_matrix(small_space, material) - whole).max() < 1e-13 * abs(whole).max()
