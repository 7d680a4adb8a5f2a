"""Torsion constants of meshed sections: closed forms, a bracket by the dual problem, and what they do to K_b."""

from __future__ import annotations

import numpy as np
import pytest

from fem.beam import Segment, stepped_stiffness
from fem.mesh_limit import limit, swept_limit
from fem.section_torsion import torsion_constant, torsion_limit, torsion_mended
from fem.slices.stiffness import chain_stiffness
from meshes.extrusion import drawn, section_mesh, stepped_thickness
from meshes.plane import PlaneMesh, halved
from meshes.resolution import Resolution
from meshes.section import ISection, Rectangle, Tube
from tests.fem import bar_p
from tests.meshes.brought import finest


def test_rectangle_and_tube() -> None:
    """Timoshenko & Goodier, Theory of Elasticity, section 109: a b³ (1/3 - 0.21 b/a (1 - (b/a)⁴/12)) to 1 %, here its
    series; a ring has its polar moment."""
    a, b = 10.0, 6.0
    terms = [np.tanh(n * np.pi * a / (2 * b)) / n**5 for n in range(1, 40, 2)]
    exact = a * b**3 / 3 * (1 - 192 / np.pi**5 * b / a * sum(terms))
    found = torsion_constant(section_mesh(Rectangle(a, b), Resolution(0.5)))
    assert found == pytest.approx(exact, rel=2e-5) and found > exact
    tube = torsion_constant(section_mesh(Tube(12.0, 2.0), Resolution(1.0)))
    assert tube == pytest.approx(np.pi / 2 * (6.0**4 - 4.0**4), rel=1e-3)


def test_place_and_turn_of_the_section_change_nothing() -> None:
    flat = section_mesh(bar_p.SECTION, Resolution(3.0))
    c, s = np.cos(0.4), np.sin(0.4)
    moved = PlaneMesh(flat.points @ [[c, s], [-s, c]] + [30.0, -20.0], flat.cells)
    assert torsion_constant(moved) == pytest.approx(torsion_constant(flat), rel=1e-10)


def test_halved_meshes_are_nested() -> None:
    """Four times the cells, no node twice, the nodes of before among them, and J from above: it falls."""
    flat = section_mesh(bar_p.SECTION, Resolution(6.0))
    fine = halved(flat)
    assert len(fine.cells) == 4 * len(flat.cells)
    assert len(np.unique(fine.points.round(9), axis=0)) == len(fine.points) == len(np.unique(fine.cells))
    before, after = ({tuple(p) for p in (mesh.points.round(6) + 0.0).tolist()} for mesh in (flat, fine))
    assert before < after
    assert torsion_constant(fine) < torsion_constant(flat)


def test_limit_lies_in_the_bracket_of_both_problems() -> None:
    """Of the section's coarse meshes 5 and 2 % too stiff: to 0.1 %, and within its own error."""
    flat = section_mesh(bar_p.SECTION, Resolution(6.0))
    found = torsion_limit((flat, halved(flat)))
    value, half = finest.torsion()
    assert half < 2e-4 * value
    assert found.levels[1] > 1.003 * value
    assert abs(found.value - value) < 1e-3 * value
    assert abs(found.value - value) < found.error + half


def test_mending_changes_the_compliance_of_a_torque_alone() -> None:
    """Of a bar whose shear axis lies beside its middle, so that torsion and bending couple."""
    segment = Segment(300.0, 7e6, 2e8, 5e7, 1e7)
    carried = np.eye(6)
    carried[:3, 3:] = [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [0.0, -3.0, 0.0]]
    carried[1, 3], carried[2, 3] = -2.0, 1.5
    wanted, given = (
        carried.T @ stepped_stiffness([Segment(s.length, s.EA, s.EIy, s.EIz, s.GJ)]) @ carried
        for s in (Segment(300.0, 7e6, 2e8, 5e7, 0.9e7), segment)
    )
    assert abs(given[3, 2]) > 1e-3 * np.sqrt(given[3, 3] * given[2, 2])
    np.testing.assert_allclose(torsion_mended(given, 0.9), wanted, rtol=1e-12, atol=1e-9 * wanted.max())


def test_a_sweep_reaches_the_limit_where_powers_of_h_do_not() -> None:
    """Two coarse meshes of bar P: K44 to 0.3 % and within its band, 1 % off by the power that bending follows."""
    flat = section_mesh(ISection(12.0, 2.2, 15.5, 4.0), Resolution(6.0))
    flats = (flat, halved(flat))
    coarse, fine = (
        chain_stiffness(
            drawn(f, "hexahedron27", stepped_thickness(bar_p.LENGTH, [2 * 2**level] * 5)), bar_p.MATERIAL
        )
        for level, f in enumerate(flats)
    )
    reference = finest.bar_p()[3, 3]
    found = swept_limit(coarse, fine, torsion_limit(flats))
    assert found.value[3, 3] == pytest.approx(reference, rel=3e-3)
    assert abs(found.value[3, 3] - reference) < found.error[3, 3] < 5e-3 * reference
    plain = limit(coarse, fine, 3.0).value
    assert abs(plain[3, 3] / reference - 1.0) > abs(found.value[3, 3] / reference - 1.0)
    rest = ~np.eye(6, dtype=bool) | (np.arange(6) != 3)
    np.testing.assert_array_equal(found.value[rest], plain[rest])
