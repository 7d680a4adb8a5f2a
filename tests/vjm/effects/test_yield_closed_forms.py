"""Yielding of a rectangular bar against moment and curvature in closed form.

W. Prager, P. G. Hodge, Theory of Perfectly Plastic Solids, Wiley 1951, chapter 2: of a rectangle whose outer
fibres yield at the curvature k_y and the moment M_y, M = M_y (3 - (k_y / k)²) / 2. With a tangent r E beyond the
yield strain, stresses are (1 - r) of that and r of the elastic ones.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from tests.vjm.load_paths import load_path
from vjm import refined, yielding
from vjm.effects import catalogue
from vjm.effects.base import Rig
from vjm.fibres import HARDENING, Fibres, lobatto
from vjm.mechanisms.bar import Bar
from vjm.refined import Refined

LENGTH, HALF_Y, HALF_Z, YOUNG = 310.0, 6.0, 9.0, 70e3
AREA = 4 * HALF_Y * HALF_Z
LIMIT = 2e-3
EI_Z = YOUNG * AREA * HALF_Y**2 / 3
K_Y, M_Y = LIMIT / HALF_Y, EI_Z * LIMIT / HALF_Y
LAYERS = 0.036
"""Seven fibres across stand for the height: the moment of a rectangle is theirs to so much, at 2.9 k_y."""


def stiffness() -> np.ndarray:
    """(6, 6) of a slender rectangular bar; its twist is of no matter here."""
    c = np.diag([1 / (YOUNG * AREA), 0, 0, 1e-7, 0, 0]) * LENGTH
    for shift, turn, sign, ei in ((1, 5, 1, EI_Z), (2, 4, -1, YOUNG * AREA * HALF_Z**2 / 3)):
        c[turn, turn] = LENGTH / ei
        c[shift, turn] = c[turn, shift] = sign * LENGTH**2 / (2 * ei)
        c[shift, shift] = LENGTH**3 / (3 * ei)
    return np.linalg.inv(c)


def bar(model: Refined | None = None) -> Rig:
    plain = Bar(LENGTH, stiffness(), bar=model, fibre_y=HALF_Y, fibre_z=HALF_Z)
    return catalogue()["material_yield"].apply(plain, {"strain": LIMIT})


def moment(curvature: float) -> float:
    """Of the rectangle, N·mm, curvature from zero on."""
    k = abs(curvature) / K_Y
    plastic = k if k < 1 else 1.5 - 0.5 / k**2
    return float(np.sign(curvature) * M_Y * ((1 - HARDENING) * plastic + HARDENING * k))


def moment_of_fibres(curvature: float) -> float:
    """Of the fibres across, N·mm."""
    fibres = Fibres(HALF_Y, HALF_Z, LIMIT)
    (y, _), weights = fibres.grid(HALF_Y / 3**0.5, HALF_Z / 3**0.5)
    strain = -y * curvature
    plastic, _ = fibres.plastic(strain, np.zeros(y.size))
    return float(-YOUNG * AREA * np.sum(weights * y * (strain - plastic)))


def test_fibres_carry_the_moment_of_a_rectangle() -> None:
    curvatures = K_Y * np.geomspace(0.5, 30.0, 200)
    shares = np.array([moment_of_fibres(k) / moment(k) for k in curvatures])
    np.testing.assert_allclose(shares, 1.0, atol=LAYERS)
    np.testing.assert_allclose(shares[curvatures < K_Y], 1.0, rtol=1e-12)
    assert moment(30 * K_Y) == pytest.approx(M_Y * (0.99 * (3 - 1 / 900) / 2 + 0.01 * 30))


@pytest.mark.parametrize("model", [None, Refined(1), Refined(6)])
@pytest.mark.parametrize("share", [0.99, 1.1, 1.3, 1.4])
def test_pure_bending(model: Refined | None, share: float) -> None:
    """Moment at the tip: every section has it, so the tip turns by curvature x length."""
    path = load_path(bar(model), share * M_Y * np.eye(6)[[5]], ())
    assert np.all(path.converged)
    bent = float(path.pose[0, 5]) / LENGTH
    assert moment_of_fibres(bent) == pytest.approx(share * M_Y, rel=1e-9)
    assert moment(bent) == pytest.approx(share * M_Y, rel=LAYERS)


@pytest.mark.parametrize(
    "share", [pytest.param(1.15, marks=pytest.mark.long), 1.3, pytest.param(1.45, marks=pytest.mark.long)]
)
def test_a_cantilever_under_a_force_at_its_tip(share: float) -> None:
    """Deflection: the curvature of the moment F a at the distance a from the tip, times a, integrated."""
    force = share * M_Y / LENGTH

    def deflection(law: Callable[[float], float]) -> float:
        def part(arm: float) -> float:
            return arm * float(brentq(lambda k: law(k) - force * arm, -K_Y, 60 * K_Y))

        return float(quad(part, 0.0, LENGTH, limit=400, epsrel=1e-6)[0])

    path = load_path(bar(), force * np.eye(6)[[1]], ())
    assert np.all(path.converged)
    elastic = force * LENGTH**3 / (3 * EI_Z)
    exact = deflection(moment_of_fibres)
    # The quadrature in the segment with the plastic zone, and levers that shorten by the square of the slope, 4e-3.
    assert path.pose[0, 1] == pytest.approx(exact, rel=6e-3)
    assert path.pose[0, 1] == pytest.approx(deflection(moment), rel=LAYERS)
    # Nor is this the elastic one: at 1.45 M_y the plastic part is a seventh of it.
    assert exact > elastic * (1.003 if share < 1.2 else 1.03)


def test_the_stations_resolve_the_edge_of_the_plastic_zone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever it ends within a segment, four times as many move the tip by a thousandth of the plastic part."""
    forces = np.linspace(1.05, 1.45, 9)[:, None] * M_Y / LENGTH * np.eye(6)[1]

    def deflection(it: Rig) -> np.ndarray:
        paths = [load_path(it, force[None], ()) for force in forces]
        assert all(path.converged.all() for path in paths)
        return np.array([path.pose[0, 1] for path in paths])

    found = deflection(bar())
    plastic = found - deflection(Bar(LENGTH, stiffness(), bar=Refined(6)))
    places, shares = lobatto(4 * yielding.STATIONS)
    for name, value in (("STATIONS", len(places)), ("_PLACES", places), ("_SHARES", shares)):
        monkeypatch.setattr(yielding, name, value)
    # What was made of the bar is remembered by its values, which the stations are none of.
    refined._limb.cache_clear()
    try:
        closer = deflection(bar())
    finally:
        refined._limb.cache_clear()
    np.testing.assert_allclose(closer, found, rtol=0, atol=1e-3 * plastic.max())


def test_unloading_is_elastic_and_leaves_a_set() -> None:
    """Down from 1.3 M_y to -0.6 M_y: straight, since the elastic range is 2 M_y wide; then it yields back."""
    loads = M_Y * np.array([1.3, 0.7, 0.0, -0.6, -1.2])
    path = load_path(bar(), loads[:, None] * np.eye(6)[5], ())
    turn = path.pose[:, 5]
    elastic = loads * LENGTH / EI_Z
    np.testing.assert_allclose(turn[1:4] - turn[0], elastic[1:4] - elastic[0], rtol=1e-9)
    assert turn[2] == pytest.approx(turn[0] - elastic[0], rel=1e-9)
    # Bauschinger: back at -1.2 M_y, 2.5 below the turning point, fibres yield again.
    assert turn[4] - turn[3] < 1.2 * (elastic[4] - elastic[3])


def test_below_the_limit_nothing_is_lost() -> None:
    """The same numbers as without, bit for bit, and the stiffness of the bar."""
    plain = Bar(LENGTH, stiffness(), bar=Refined(6))
    loads = np.array([[400.0, 2.0, 3.0, 100.0, 200.0, 0.3 * M_Y]])
    with_law, without = (load_path(it, loads, ()).pose for it in (bar(Refined(6)), plain))
    np.testing.assert_array_equal(with_law, without)


def test_tension_past_yield() -> None:
    """EA limit and a hundredth of the rest, and a curve that comes back parallel."""
    held = ("x", "y", "z", "rx", "ry", "rz")
    start = np.eye(6)[0] * LENGTH
    strain = np.array([0.5, 1.0, 3.0, 2.0]) * LIMIT
    path = load_path(bar(), start + np.outer(strain * LENGTH, np.eye(6)[0]), held)
    ea = YOUNG * AREA
    top = ea * LIMIT * (1 + 2 * HARDENING)
    np.testing.assert_allclose(
        path.load[:, 0], [ea * LIMIT / 2, ea * LIMIT, top, top - ea * LIMIT], rtol=1e-9
    )


@pytest.mark.parametrize(("edge", "radius"), [(6.0, 2.0), (6.0, 3.0), (6.0, 6.0 / 3**0.5), (6.0, 5.0)])
def test_fibres_have_the_radius_of_gyration_and_the_edges(edge: float, radius: float) -> None:
    places, weights = Fibres(edge, edge, LIMIT).grid(radius, 3.0)
    assert np.all(weights >= 0) and np.sum(weights) == pytest.approx(1)
    assert np.max(places[0]) == edge and np.min(places[0]) == -edge
    assert np.sum(weights * places[0] ** 2) == pytest.approx(radius**2)
    assert np.sum(weights * places[0] * places[1]) == pytest.approx(0, abs=1e-12)
