"""Section constants against closed forms, thin-walled formulas and the yardstick."""

from __future__ import annotations

from math import pi, tanh

import numpy as np
import pytest

from fem.section_constants import section_constants
from fem.thin_walled import i_section_constants, rectangle_constants
from meshes.section import ISection, Rectangle, Round, Section, Tube
from tests.fem import bar_p

SECTIONS = [Rectangle(6.0, 10.0), bar_p.SECTION, Round(10.0), Tube(12.0, 2.0)]


def rectangle_torsion(long: float, short: float) -> float:
    """J of a rectangle by Saint-Venant's series (Timoshenko & Goodier, Theory of Elasticity, section 109)."""
    series = sum(tanh(n * pi * long / (2 * short)) / n**5 for n in range(1, 60, 2))
    return long * short**3 * (1 / 3 - 64 / pi**5 * short / long * series)


@pytest.mark.parametrize("section", SECTIONS, ids=lambda s: type(s).__name__)
def test_area_and_moments(section: Section) -> None:
    c = section_constants(section, 0.3)
    # Quadratic arcs over a fiftieth of the section.
    np.testing.assert_allclose((c.area, c.Iy, c.Iz), (section.area, *section.second_moments), rtol=1e-5)


def test_round_and_tube() -> None:
    """J is the polar moment, nothing warps; shear area of a round by Renton's energy, a thin tube's is A / 2."""
    nu = 0.33
    c = section_constants(Round(10.0), nu)
    assert pytest.approx(pi * 10**4 / 32, rel=1e-5) == c.J
    assert c.Iw < 1e-9 * 10**6
    shear = 6 * (1 + nu) ** 2 / (7 + 14 * nu + 8 * nu**2) * pi * 25
    assert c.shear_area_y == pytest.approx(shear, rel=1e-4)
    assert c.shear_area_z == pytest.approx(shear, rel=1e-4)
    tube = section_constants(Tube(12.0, 2.0), nu)
    assert pytest.approx(pi * (12**4 - 8**4) / 32, rel=1e-5) == tube.J
    thin = section_constants(Tube(100.0, 0.5), 0.0, size=1.0)
    assert thin.shear_area_y == pytest.approx(thin.area / 2, rel=1e-3)


@pytest.mark.parametrize("ratio", [1.0, 1.5, 3.0])
def test_torsion_of_rectangles(ratio: float) -> None:
    """Saint-Venant's series; the square is the textbook's 0.1406 a⁴."""
    c = section_constants(Rectangle(6.0, 6.0 * ratio), 0.3)
    assert pytest.approx(rectangle_torsion(6.0 * ratio, 6.0), rel=2e-5) == c.J
    if ratio == 1.0:
        assert pytest.approx(0.1406 * 6.0**4, rel=5e-4) == c.J


def test_shear_area_of_a_rectangle() -> None:
    """5/6 A without lateral contraction; with it less for a force along the short side, hardly along the long one."""
    c = section_constants(Rectangle(6.0, 18.0), 0.0)
    np.testing.assert_allclose((c.shear_area_y, c.shear_area_z), 5 / 6 * 108.0, rtol=1e-5)
    contracting = section_constants(Rectangle(6.0, 18.0), 0.33)
    assert contracting.shear_area_z == pytest.approx(5 / 6 * 108.0, rel=1e-3)
    assert contracting.shear_area_y < 0.95 * 5 / 6 * 108.0


def test_bar_p() -> None:
    """The yardstick's constants. Its shear area 59.7 mm² is that of nu = 0; at the bar's own nu = 0.33 it is 58.8."""
    c = bar_p.constants()
    assert c.area == pytest.approx(97.20, rel=1e-4)
    assert pytest.approx(2812.1, rel=1e-4) == c.Iy
    assert pytest.approx(692.8, rel=1e-4) == c.Iz
    # The yardstick's J and Iw come from a coarser section mesh; J falls and Iw rises as the mesh is refined.
    assert pytest.approx(357.4, rel=2e-3) == c.J
    assert pytest.approx(24105, rel=2e-3) == c.Iw
    assert c.shear_area_z == pytest.approx(51.8, rel=1e-3)
    assert c.shear_area_y == pytest.approx(58.8, rel=1e-3)
    assert section_constants(bar_p.SECTION, 0.0).shear_area_y == pytest.approx(59.7, rel=1.5e-3)


def test_constants_converge_with_the_mesh() -> None:
    """A Poisson energy from below or above: J and Iw move less than 0.1 % when the elements are halved."""
    one, two = (section_constants(bar_p.SECTION, 0.33, size) for size in (0.4, 0.2))
    np.testing.assert_allclose(
        (one.J, one.Iw, one.shear_area_y), (two.J, two.Iw, two.shear_area_y), rtol=1e-3
    )
    assert one.J >= two.J


def test_a_turned_section_exchanges_its_axes() -> None:
    a, b = (section_constants(Rectangle(*size), 0.33) for size in ((6.0, 10.0), (10.0, 6.0)))
    np.testing.assert_allclose((a.Iy, a.Iz), (b.Iz, b.Iy), rtol=1e-12)
    np.testing.assert_allclose((a.J, a.Iw), (b.J, b.Iw), rtol=1e-6)
    np.testing.assert_allclose((a.shear_area_y, a.shear_area_z), (b.shear_area_z, b.shear_area_y), rtol=1e-6)


def test_thin_walled_i_section() -> None:
    """A really thin one agrees to a few per cent, but for the web's shear area; stocky bar P misses more."""
    section = ISection(40.0, 1.0, 40.0, 1.0)
    exact, hand = section_constants(section, 0.0, size=0.25), i_section_constants(section)
    np.testing.assert_allclose((exact.area, exact.Iy, exact.Iz), (hand.area, hand.Iy, hand.Iz), rtol=1e-9)
    assert pytest.approx(exact.J, rel=0.03) == hand.J
    assert pytest.approx(exact.Iw, rel=0.03) == hand.Iw
    # Web times depth takes the shear stress as constant over the web: 12 % high here, 3 % for bar P.
    assert hand.shear_area_z == pytest.approx(exact.shear_area_z, rel=0.12)
    assert hand.shear_area_y == pytest.approx(exact.shear_area_y, rel=0.05)
    stocky = i_section_constants(bar_p.SECTION)
    assert pytest.approx(bar_p.constants().J, rel=0.04) == stocky.J
    # Bar P is not thin: its flanges are 5.5 times as wide as thick.
    assert pytest.approx(bar_p.constants().Iw, rel=0.30) == stocky.Iw
    assert stocky.shear_area_z == pytest.approx(bar_p.constants().shear_area_z, rel=0.03)


def test_thin_walled_rectangle() -> None:
    for size in ((6.0, 10.0), (10.0, 6.0), (7.0, 7.0)):
        hand = rectangle_constants(Rectangle(*size))
        # Roark's polynomial is within half a per cent of the series.
        assert pytest.approx(rectangle_torsion(max(size), min(size)), rel=5e-3) == hand.J
        assert hand.shear_area_y == hand.shear_area_z == pytest.approx(5 / 6 * size[0] * size[1])
