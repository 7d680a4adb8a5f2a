"""Torsion constants in closed form against Saint-Venant's problem on a mesh, and against tables."""

from __future__ import annotations

import pytest

from fem.section_constants import section_constants
from fem.torsion import torsion_constant
from meshes.section import ISection, Rectangle, Round, Section, Tube


@pytest.mark.parametrize(
    "section", [Rectangle(6.0, 10.0), Rectangle(10.0, 6.0), Round(8.0), Tube(16.0, 2.0), Rectangle(1.0, 20.0)]
)
def test_closed_forms_are_those_of_the_mesh(section: Section) -> None:
    size = min(section.size) / 8.0
    assert torsion_constant(section) == pytest.approx(section_constants(section, 0.3, size).J, rel=2e-4)


def test_a_square_and_a_thin_strip_have_their_known_constants() -> None:
    """Timoshenko and Goodier, section 109: 0.1406 a⁴; a strip b t³ / 3 less 0.63 t⁴ / 3."""
    assert torsion_constant(Rectangle(100.0, 100.0)) == pytest.approx(0.1406e8, rel=3e-4)
    assert torsion_constant(Rectangle(0.5, 50.0)) == pytest.approx(
        (50.0 * 0.125 - 0.630 * 0.0625) / 3.0, rel=1e-5
    )


def test_a_section_without_a_closed_form_is_meshed() -> None:
    section = ISection(flange_width=12.0, flange_thickness=2.2, height=15.5, web=4.0)
    assert torsion_constant(section) == section_constants(section, 0.3).J
