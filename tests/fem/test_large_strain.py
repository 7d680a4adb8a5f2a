"""Total-Lagrangian solid: force from energy, tangent from force, frame indifference, small-displacement limit."""

from __future__ import annotations

import numpy as np
import pytest

from fem.elasticity import nodal_geometric_stiffness, stiffness_matrix, stress
from fem.large_strain import force_and_tangent, second_piola
from fem.material import Isotropic
from fem.rotation import rotation
from fem.space import Space
from meshes.solid import SolidMesh


def energy(space: Space, material: Isotropic, u: np.ndarray) -> float:
    """∫ λ/2 (tr E)² + μ E:E dV with Green's strain E (Saint Venant-Kirchhoff), N·mm."""
    f = np.eye(3) + space.displacement_gradient(u)
    green = 0.5 * (np.swapaxes(f, -1, -2) @ f - np.eye(3))
    trace = np.einsum("mqaa->mq", green)
    density = material.lame / 2 * trace**2 + material.shear_modulus * np.sum(green**2, axis=(-1, -2))
    return float(np.sum(density * space.weights))


def large(mesh: SolidMesh) -> np.ndarray:
    """Smooth and large: strains of a few per cent, turns of half a radian, plus noise."""
    x = mesh.points / 40.0
    bent = (
        np.stack([0.1 * x[:, 0] - x[:, 2] * x[:, 0], 0.5 * x[:, 0] * x[:, 2], 0.5 * x[:, 0] ** 2], axis=1)
        * 20.0
    )
    noise = np.random.default_rng(4).standard_normal(mesh.points.shape)
    return np.asarray((bent + 0.05 * noise).ravel())


def test_force_is_the_gradient_of_the_energy(
    small: SolidMesh, small_space: Space, material: Isotropic
) -> None:
    u = large(small)
    force, _ = force_and_tangent(small_space, material, u)
    rng = np.random.default_rng(5)
    for _ in range(4):
        way = rng.standard_normal(len(u))
        h = 1e-5
        rise = energy(small_space, material, u + h * way) - energy(small_space, material, u - h * way)
        size = np.abs(force * way).sum()
        assert abs(rise / (2 * h) - force @ way) < 1e-7 * size


def test_tangent_is_the_derivative_of_the_force(
    small: SolidMesh, small_space: Space, material: Isotropic
) -> None:
    u = large(small)
    _, tangent = force_and_tangent(small_space, material, u)
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    rng = np.random.default_rng(6)
    for _ in range(4):
        way = rng.standard_normal(len(u))
        h = 1e-5
        plus, minus = (force_and_tangent(small_space, material, u + s * h * way)[0] for s in (1, -1))
        expected = tangent @ way
        assert np.abs((plus - minus) / (2 * h) - expected).max() < 1e-7 * np.abs(expected).max()


def test_a_finite_rotation_changes_nothing_but_the_frame(
    small: SolidMesh, small_space: Space, material: Isotropic
) -> None:
    u = large(small)
    turn = rotation(np.array([0.7, -1.9, 0.4]))
    placed = small.points + u.reshape(-1, 3)
    turned = (placed @ turn.T + np.array([3.0, -2.0, 8.0]) - small.points).ravel()
    force, tangent = force_and_tangent(small_space, material, u)
    other, other_tangent = force_and_tangent(small_space, material, turned)
    expected = (force.reshape(-1, 3) @ turn.T).ravel()
    assert np.abs(other - expected).max() < 1e-11 * np.abs(expected).max()
    way = np.random.default_rng(7).standard_normal((len(u) // 3, 3))
    a = (tangent @ way.ravel()).reshape(-1, 3) @ turn.T
    b = (other_tangent @ (way @ turn.T).ravel()).reshape(-1, 3)
    assert np.abs(a - b).max() < 1e-10 * np.abs(a).max()
    # A rigid rotation alone carries no force.
    rigid = (small.points @ turn.T - small.points).ravel()
    free, _ = force_and_tangent(small_space, material, rigid)
    assert np.abs(free).max() < 1e-10 * abs(tangent).max()


def test_small_displacements_are_linear(small: SolidMesh, small_space: Space, material: Isotropic) -> None:
    k = stiffness_matrix(small_space, material)
    still, tangent = force_and_tangent(small_space, material, np.zeros(small.dofs))
    assert np.abs(still).max() == 0.0
    assert abs(tangent - k).max() < 1e-12 * abs(k).max()
    u = np.random.default_rng(8).standard_normal(small.dofs)
    force, _ = force_and_tangent(small_space, material, 1e-8 * u)
    linear = 1e-8 * (k @ u)
    assert np.abs(force - linear).max() < 1e-6 * np.abs(linear).max()


def test_tangent_grows_by_the_geometric_stiffness(
    small: SolidMesh, small_space: Space, material: Isotropic
) -> None:
    """Stretch by ε: dK/dε at ε = 0 contains K_g of the stress. Seen on a rigid turn, which K itself does not feel."""
    strain = 1e-6
    u = (strain * small.points * [1.0, -material.nu, -material.nu]).ravel()
    _, tangent = force_and_tangent(small_space, material, u)
    kg = nodal_geometric_stiffness(small_space, stress(small_space, material, u))
    spin = np.cross([0.2, 0.5, -0.8], small.points).ravel()
    # Work of the turn on the stretched body: force of K is zero, K_g's is of first order in the strain.
    work = np.sum(spin.reshape(-1, 3) * (kg @ spin.reshape(-1, 3)))
    carried = spin @ (tangent @ spin)
    assert carried == pytest.approx(work, rel=1e-3)


def test_stress_of_a_uniaxial_stretch() -> None:
    """By hand: F = diag(1.1, 1, 1), E11 = 0.105, S11 = (λ + 2μ) E11, S22 = λ E11."""
    m = Isotropic(70e3, 0.33)
    s = second_piola(np.diag([1.1, 1.0, 1.0])[None, None], m)[0, 0]
    green = (1.1**2 - 1) / 2
    expected = np.diag([m.lame + 2 * m.shear_modulus, m.lame, m.lame]) * green
    np.testing.assert_allclose(s, expected, rtol=1e-12)
