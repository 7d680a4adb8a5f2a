"""The closed-form beam: textbook cantilever, segments in a row, restrained warping."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from fem.beam import (
    Segment,
    one_end_warping_factor,
    segment_compliance,
    stepped_stiffness,
    twist_compliance,
    uniform_stiffness,
)
from fem.material import Isotropic
from tests.fem import bar_p

PLAIN = Segment(310.0, 6.8e6, 1.97e8, 4.85e7, 9.4e6, 1.55e6, 1.36e6)
WARPING = Segment(310.0, 6.8e6, 1.97e8, 4.85e7, 9.4e6, 1.55e6, 1.36e6, 1.7e9)


def test_uniform_cantilever() -> None:
    """The textbook's 12 EI/L³, 6 EI/L², 4 EI/L; a push along +y turns the tip about +z, along +z about -y."""
    length, ea, ei_y, ei_z, gj = 310.0, 6.8e6, 1.97e8, 4.85e7, 9.4e6
    expected = np.diag(
        [
            ea / length,
            12 * ei_z / length**3,
            12 * ei_y / length**3,
            gj / length,
            4 * ei_y / length,
            4 * ei_z / length,
        ]
    )
    expected[1, 5] = expected[5, 1] = -6 * ei_z / length**2
    expected[2, 4] = expected[4, 2] = 6 * ei_y / length**2
    found = uniform_stiffness(length, ea, ei_y, ei_z, gj)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-9)
    assert np.linalg.inv(found)[5, 1] > 0 > np.linalg.inv(found)[4, 2]


def test_shear_adds_its_own_compliance() -> None:
    slender = Segment(310.0, 6.8e6, 1.97e8, 4.85e7, 9.4e6)
    difference = np.linalg.inv(stepped_stiffness([PLAIN])) - np.linalg.inv(stepped_stiffness([slender]))
    expected = np.diag([0.0, 310.0 / 1.55e6, 310.0 / 1.36e6, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(difference, expected, atol=1e-12)


@pytest.mark.parametrize("parts", [(0.5, 0.5), (0.1, 0.6, 0.3)])
def test_parts_of_a_bar_are_the_bar(parts: tuple[float, ...]) -> None:
    segments = [
        Segment(310.0 * p, *(getattr(PLAIN, n) for n in ("EA", "EIy", "EIz", "GJ", "GAy", "GAz")))
        for p in parts
    ]
    np.testing.assert_allclose(stepped_stiffness(segments), stepped_stiffness([PLAIN]), rtol=1e-10, atol=1e-6)


def test_rigid_stub_moves_the_point() -> None:
    """A rigid segment beyond the tip is a lever, one before the base nothing."""
    rigid = Segment(40.0, inf, inf, inf, inf)
    beyond = np.linalg.inv(stepped_stiffness([PLAIN, rigid]))
    lever = np.eye(6)
    lever[4, 2], lever[5, 1] = -40.0, 40.0
    np.testing.assert_allclose(beyond, lever.T @ segment_compliance(PLAIN) @ lever, rtol=1e-10, atol=1e-15)
    np.testing.assert_allclose(
        stepped_stiffness([rigid, PLAIN]), stepped_stiffness([PLAIN]), rtol=1e-10, atol=1e-6
    )


@pytest.mark.parametrize("free_end", [False, True])
def test_restrained_warping(free_end: bool) -> None:
    """Against the differential equation GJ θ - EIw θ'' = T (Vlasov), θ the twist per length, solved numerically."""
    s = WARPING

    def slope(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.stack([y[1], (s.GJ * y[0] - 1.0) / s.EIw, y[0]])

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array([a[0], b[1] if free_end else b[0], a[2]])

    x = np.linspace(0.0, s.length, 200)
    solution = solve_bvp(slope, ends, x, np.stack([np.full_like(x, 1 / s.GJ), 0 * x, x / s.GJ]), tol=1e-8)
    assert solution.success
    twist = float(solution.y[2, -1])
    ours = twist_compliance(s) * (one_end_warping_factor(s) if free_end else 1.0)
    assert ours == pytest.approx(twist, rel=1e-6)


def test_without_warping_stiffness_the_ends_do_not_matter() -> None:
    assert twist_compliance(PLAIN) == PLAIN.length / PLAIN.GJ
    assert one_end_warping_factor(PLAIN) == 1.0
    barely = Segment(310.0, 6.8e6, 1.97e8, 4.85e7, 9.4e6, EIw=1.0)
    assert twist_compliance(barely) == pytest.approx(PLAIN.length / PLAIN.GJ, rel=1e-5)


def test_bar_p_segment() -> None:
    """Rigidities are modulus times constants: EA 6.804e6 N, EI_z 4.85e7, EI_y 1.968e8 N·mm² by hand."""
    s = Segment.of(bar_p.constants(), bar_p.MATERIAL, 310.0)
    np.testing.assert_allclose((s.EA, s.EIz, s.EIy), (70e3 * 97.2, 70e3 * 692.8, 70e3 * 2812.1), rtol=1e-4)
    assert pytest.approx(70e3 / 2.66 * 357.4, rel=2e-3) == s.GJ


@pytest.mark.parametrize(
    ("E", "nu", "sentence"),
    [
        (0.0, 0.3, "E is 0 MPa, allowed is above 0"),
        (float("nan"), 0.3, "E is nan MPa, allowed is above 0"),
        (1.0, 0.5, "nu is 0.5, allowed is above -1 and below 0.5"),
        (1.0, -1.0, "nu is -1, allowed is above -1 and below 0.5"),
    ],
)
def test_bad_material(E: float, nu: float, sentence: str) -> None:
    with pytest.raises(ValueError) as caught:
        Isotropic(E, nu)
    assert str(caught.value) == sentence


def test_elastic_constants() -> None:
    """λ + 2μ/3 is the bulk modulus E / (3 (1 - 2ν))."""
    m = Isotropic(70e3, 0.33)
    assert m.shear_modulus == pytest.approx(70e3 / 2.66)
    assert m.lame + 2 * m.shear_modulus / 3 == pytest.approx(70e3 / (3 * 0.34))
