"""Stress under unit loads against that of a beam, away from its ends; materials by region."""

from __future__ import annotations

import numpy as np
import pytest

from fem.anisotropic import Orthotropic, Regional
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.material import Isotropic
from fem.space import Space
from fem.von_mises import UnitStress, near_ends, unit_stress
from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.section import Rectangle
from meshes.solid import SolidMesh
from meshes.store import mesh_bar

WIDTH, HEIGHT, LENGTH = 6.0, 10.0, 60.0
STEEL = Isotropic(210e3, 0.3)


def mesh() -> SolidMesh:
    return mesh_bar(Bar(Rectangle(WIDTH, HEIGHT), LENGTH), Resolution(6.0, 2))


def stress_of(material: Isotropic | Regional) -> UnitStress:
    return unit_stress(LinearModel(single_bar(Space.of(mesh()), LENGTH), material))


def test_a_pulled_and_a_bent_bar_have_the_stress_of_a_beam() -> None:
    it = stress_of(STEEL)
    near, reach = near_ends(mesh(), it.at)
    assert reach == {"base": HEIGHT / 2, "tip": HEIGHT / 2}
    middle = np.abs(it.at[:, 0] - LENGTH / 2) < LENGTH / 5
    assert near[np.isin(it.at[:, 0], (0.0, LENGTH))].all() and not near[middle].any()
    np.testing.assert_allclose(it.values[0, middle], 1.0 / (WIDTH * HEIGHT), rtol=2e-3)
    # Pure bending: the largest at the outer fibre; the tip's force makes the moment (L - x) beside shear.
    for load, section in ((4, WIDTH * HEIGHT**2 / 6), (5, HEIGHT * WIDTH**2 / 6)):
        assert it.values[load, middle].max() == pytest.approx(1.0 / section, rel=5e-3)
    for load, section, axis, outer in (
        (1, HEIGHT * WIDTH**2 / 6, 1, 3.0),
        (2, WIDTH * HEIGHT**2 / 6, 2, 5.0),
    ):
        fibre = middle & (np.abs(np.abs(it.at[:, axis]) - outer) < 1e-9)
        np.testing.assert_allclose(it.values[load, fibre], (LENGTH - it.at[fibre, 0]) / section, rtol=0.03)
    # Saint-Venant's torsion of a rectangle of 10 to 6: coefficient 0.2266 (Timoshenko and Goodier, 3rd ed., table 1
    # of chapter 10, between 0.219 at 1.5 and 0.246 at 2).
    torsion = it.values[3, middle].max() / np.sqrt(3.0) * HEIGHT * WIDTH**2
    assert 1.0 / 0.246 < torsion < 1.0 / 0.208


def test_one_law_as_two_regions_gives_each_its_own_nodes_and_the_same_stress() -> None:
    same = Orthotropic(210e3, 210e3, 210e3, 0.3, 0.3, 0.3, *(3 * [STEEL.shear_modulus]))
    cells = np.zeros(len(mesh().cells), dtype=np.int64)
    whole, other = stress_of(STEEL), stress_of(Regional((same,), cells))
    np.testing.assert_allclose(other.at, whole.at)
    np.testing.assert_allclose(other.values, whole.values, rtol=1e-6, atol=1e-9 * whole.values.max())


def test_a_soft_half_carries_the_same_force() -> None:
    """In series both halves have the stress F/A, whatever they are made of; E alone must not enter it."""
    m = mesh()
    half = (m.points[m.cells].mean(axis=1)[:, 0] > LENGTH / 2).astype(np.int64)
    it = stress_of(Regional((STEEL, Isotropic(70e3, 0.3)), half))
    for x in (LENGTH / 3, 2 * LENGTH / 3):
        near = np.abs(it.at[:, 0] - x) < 1.0
        assert near.any()
        np.testing.assert_allclose(it.values[0, near], 1.0 / (WIDTH * HEIGHT), rtol=0.04)
