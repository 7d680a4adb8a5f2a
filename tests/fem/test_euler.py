"""Critical loads by formula: textbook roots, and soft ends against beam-column elements with end springs."""

from __future__ import annotations

from math import cos, inf, pi, sin, tan

import numpy as np
import pytest
from scipy.linalg import eigh

from fem.beam import Segment
from fem.euler import Bending, bending_of, critical_compression, half_waves, torsional_load
from tests.fem import bar_p

# Half waves of a slender bar with ideal ends (Timoshenko & Gere, Theory of Elastic Stability, 2.2 to 2.4):
# clamped antisymmetric modes from tan u = u, u = 4.4934, 7.7253.
TEXTBOOK = {
    "free": (0.5, 1.5, 2.5, 3.5),
    "guided": (1.0, 2.0, 3.0, 4.0),
    "clamped": (2.0, 2 * 4.493409 / pi, 4.0, 2 * 7.725252 / pi),
    "pinned": (1.0, 2.0, 3.0, 4.0),
}


def column(supports: str, softness: float, elements: int = 24) -> np.ndarray:
    """Half waves of the lowest modes of a unit beam-column of Hermite elements with rotational end springs."""
    h = 1.0 / elements
    k, kg = np.zeros((2, 2 * elements + 2, 2 * elements + 2))
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]])
    bend = np.vstack([bend, -bend[0], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3
    push = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h]])
    push = np.vstack([push, -push[0], [3 * h, -h * h, -3 * h, 4 * h * h]]) / (30 * h)
    for e in range(elements):
        part = slice(2 * e, 2 * e + 4)
        k[part, part] += bend
        kg[part, part] += push
    # φ = 2 EI f / L of each spring, here EI = L = 1: spring stiffness 2 / φ between beam end and face.
    turned = {
        "free": (True, False),
        "guided": (True, True),
        "clamped": (True, True),
        "pinned": (False, False),
    }
    gone = {"free": [0], "guided": [0], "clamped": [0, -2], "pinned": [0, -2]}[supports]
    gone = [g % len(k) for g in gone]
    for place, held in zip((1, len(k) - 1), turned[supports], strict=True):
        if held and softness:
            k[place, place] += 2.0 / softness
        elif held:
            gone.append(place)
    kept = np.setdiff1d(np.arange(len(k)), gone)
    loads = eigh(k[np.ix_(kept, kept)], kg[np.ix_(kept, kept)], eigvals_only=True)
    return np.sqrt(loads[:4]) / pi


@pytest.mark.parametrize("supports", TEXTBOOK)
def test_ideal_ends(supports: str) -> None:
    found = [half_waves(supports, mode) for mode in (1, 2, 3, 4)]
    np.testing.assert_allclose(found, TEXTBOOK[supports], rtol=1e-6)
    # 24 Hermite elements: the fourth mode is 1e-4 high.
    np.testing.assert_allclose(found, column(supports, 0.0), rtol=3e-4)


@pytest.mark.parametrize("softness", [-0.05, 0.02, 0.3, 2.0])
@pytest.mark.parametrize("supports", TEXTBOOK)
def test_soft_ends(supports: str, softness: float) -> None:
    found = [half_waves(supports, mode, softness) for mode in (1, 2, 3, 4)]
    if softness > 0.0:
        # A negative spring is a stiffened end, which a row of elements cannot show.
        np.testing.assert_allclose(found, column(supports, softness), rtol=3e-4)
    ideal = np.array(TEXTBOOK[supports])
    if supports == "pinned":
        np.testing.assert_allclose(found, ideal)
    else:
        assert np.all((np.array(found) - ideal) * softness < 0.0), "softer ends must lower the load"


@pytest.mark.parametrize("softness", [-0.05, 0.0, 0.1, 1.0])
def test_characteristic_equations(softness: float) -> None:
    """Each root solves the equation that a beam-column with two end springs gives by hand."""
    for mode in (1, 2, 3, 4):
        u = pi / 2 * half_waves("free", mode, softness)
        assert cos(2 * u) == pytest.approx(softness * u * sin(2 * u), abs=1e-9)
        u = pi / 2 * half_waves("clamped", mode, softness)
        if mode % 2:
            assert sin(u) == pytest.approx(-softness * u * cos(u), abs=1e-8)
        else:
            assert u == pytest.approx((1 + softness * u * u) * tan(u), abs=1e-7)
        u = pi / 2 * half_waves("guided", mode, softness)
        expected = (cos(u), softness * u * sin(u)) if mode % 2 else (sin(u), -softness * u * cos(u))
        assert expected[0] == pytest.approx(expected[1], abs=1e-8)


def springs_in_series(EI: float, GA: float, length: float, f: float) -> np.ndarray:
    """(2, 2) tip compliance of push and turn: spring, beam, spring."""
    base = f * np.array([[length**2, length], [length, 1.0]])
    beam = np.array(
        [[length**3 / (3 * EI) + length / GA, length**2 / (2 * EI)], [length**2 / (2 * EI), length / EI]]
    )
    return base + beam + np.diag([0.0, f])


@pytest.mark.parametrize("f", [0.0, 3e-8, -1e-8])
@pytest.mark.parametrize("GA", [inf, 1.5e6])
def test_bending_of_a_bar_with_end_springs(f: float, GA: float) -> None:
    """EI, shear and softness come back from the 6x6 of springs in series, in both planes."""
    length, EI = 310.0, {"xy": 4.85e7, "xz": 1.97e8}
    compliance = np.diag([1e-5, 1.0, 1.0, 1e-4, 1.0, 1.0])
    for (push, turn, sign), plane in zip(((1, 5, 1.0), (2, 4, -1.0)), EI, strict=True):
        c = springs_in_series(EI[plane], GA, length, f)
        compliance[push, push], compliance[turn, turn] = c[0, 0], c[1, 1]
        compliance[push, turn] = compliance[turn, push] = sign * c[0, 1]
    for plane, rigidity in EI.items():
        found = bending_of(np.linalg.inv(compliance), length, plane, GA)
        assert pytest.approx(rigidity, rel=1e-9) == found.EI
        assert found.softness == pytest.approx(2 * rigidity * f / length, abs=1e-9)
        assert (found.GA, found.length) == (GA, length)


def test_bending_of_bar_p() -> None:
    """The solid's EI is E I; its ends are a little stiffer than the section (held contraction)."""
    for plane, moment, shear in (("xy", 692.8, 58.8), ("xz", 2812.1, 51.8)):
        found = bending_of(bar_p.model(2).stiffness, 310.0, plane, 70e3 / 2.66 * shear)
        assert pytest.approx(70e3 * moment, rel=2e-3) == found.EI
        assert -0.01 < found.softness < 0.0


def test_shear_lowers_the_load() -> None:
    """Engesser: 1/P = 1/P_Euler + 1/GA; without it Euler's own load."""
    slender = critical_compression(Bending(4.85e7, inf, 310.0, 0.0), "pinned", 1)
    assert slender == pytest.approx(pi**2 * 4.85e7 / 310.0**2)
    sheared = critical_compression(Bending(4.85e7, 1e5, 310.0, 0.0), "pinned", 1)
    assert 1 / sheared == pytest.approx(1 / slender + 1e-5)


def test_torsional_load_of_bar_p() -> None:
    """About 260 kN (the yardstick's theory), 12 % more for held warping at both ends of 310 mm."""
    s = Segment.of(bar_p.constants(), bar_p.MATERIAL, 310.0)
    polar = (2812.1 + 692.8) / 97.2
    assert torsional_load(s, 0.5, polar) == pytest.approx(260e3, rel=0.01)
    assert torsional_load(s, 2.0, polar) == pytest.approx((s.GJ + (2 * pi / 310) ** 2 * s.EIw) / polar)


def test_wrong_names() -> None:
    with pytest.raises(ValueError, match="supports are 'hinged', allowed are free, guided, clamped, pinned"):
        half_waves("hinged", 1)
    with pytest.raises(KeyError):
        bending_of(np.eye(6), 1.0, "yz")
