"""Bars as built: bow, ends that give, lengthening, weight, slides; each against its closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.beams import BAR_P
from tests.vjm.load_paths import load_path
from tests.vjm.strategies import LENGTH, WIDTH
from vjm import paper
from vjm.bars import compliance_at_tip
from vjm.equilibrium import equilibrium, unloaded
from vjm.laws import Linear
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined
from vjm.stiffness import unloaded_stiffness

K_P = BAR_P.stiffness(LENGTH)
MODELS = [Lumped(), Lumped("middle"), Refined(1), Refined(6)]


def link(**changes: object) -> Link:
    return replace(Link(LENGTH, K_P), **changes)  # type: ignore[arg-type]


def bar(model: object, **changes: object) -> Bar:
    return Bar(LENGTH, K_P, bar=model).altered(lambda _, it: replace(it, **changes))  # type: ignore[arg-type]


@pytest.mark.parametrize("model", [Lumped(), Refined(6)])
@pytest.mark.parametrize("bow", [(0.8, 0.0), (0.0, 0.8), (0.5, -0.7)])
def test_a_bowed_bar_has_the_compliance_of_its_half_sine(model: object, bow: tuple[float, float]) -> None:
    """Unit loads at the tip: the moment about the axis at x is that of the straight bar plus height x force.

    The height is e sin(pi x / L): compliances ∫ y²/EI = e² L / (2 EI), ∫ y/EI = 2 e L / (pi EI), and
    ∫ y (L - x)/EI = e L² / (pi EI). Left out is the tilt of the sections, of the order of the slope squared.
    """
    found = compliance_at_tip(model.limb(link(bow=bow)))  # type: ignore[attr-defined]
    straight = np.linalg.inv(K_P)
    added = np.zeros((6, 6))
    for e, shift, turn, sign, ei in ((bow[0], 1, 5, 1.0, BAR_P.ei_z), (bow[1], 2, 4, -1.0, BAR_P.ei_y)):
        across = e * LENGTH**2 / (np.pi * ei)
        added[0, 0] += e**2 * LENGTH / (2 * ei)
        added[0, turn] = added[turn, 0] = sign * 2 * e * LENGTH / (np.pi * ei)
        added[0, shift] = added[shift, 0] = across
    # One per cent of the bow's part for six segments that are arcs; the half sine's are not quite.
    for k in range(6):
        np.testing.assert_allclose(
            (found - straight)[0, k], added[0, k], rtol=0.01, atol=1e-3 * abs(found[0, 0])
        )


@pytest.mark.parametrize("segments", [4, 6])
def test_a_bowed_strut_deflects_as_perry_says(segments: int) -> None:
    """Pinned about y, bow e along z: the middle moves by e P / (P_cr - P), J. Perry, W. E. Ayrton 1886."""
    e = 0.3
    strut = Bar(LENGTH, K_P, base="pinned", tip="pinned", bar=Refined(segments))
    strut = strut.altered(lambda _, it: replace(it, bow=(0.0, e)))
    critical = np.pi**2 * BAR_P.ei_y / LENGTH**2
    critical /= 1 + critical / BAR_P.ga_z
    gauge = strut.gauge(0.5, (0.0, 0.0, 1.0))
    targets = strut.unloaded_pose * [0, 1, 1, 1, 1, 1] - np.array([[0.3], [0.6]]) * critical * np.eye(6)[0]
    state = load_path(strut, targets, strut.held)
    assert np.all(state.converged)
    # Shear takes a small share of the bow's moment too; large deflection is of the order (e/L)².
    np.testing.assert_allclose(gauge.reading(state), e * np.array([0.3 / 0.7, 0.6 / 0.4]), rtol=0.012)


@pytest.mark.parametrize("model", MODELS)
def test_a_bowed_bar_stands_where_a_straight_one_does(model: object) -> None:
    mechanism = bar(model, bow=(0.6, -0.4))
    pose = mechanism.chains[0].chain.pose(mechanism.chains[0].rest)
    # Turns about two axes do not commute: 1e-7 rad and 1e-5 mm at slopes of 6e-3.
    np.testing.assert_allclose(pose[:3], mechanism.unloaded_pose[:3], atol=2e-5)
    np.testing.assert_allclose(pose[3:], 0.0, atol=2e-7)


@pytest.mark.parametrize("model", MODELS)
def test_ends_that_give_stand_in_series(model: object) -> None:
    generator = np.random.default_rng(3)
    gives = []
    for _ in range(2):
        a = generator.normal(size=(6, 6)) * np.sqrt(np.diag(np.linalg.inv(K_P)))[:, None] * 0.05
        gives.append(a @ a.T)
    lever = np.eye(6)
    lever[1, 5], lever[2, 4] = LENGTH, -LENGTH
    expected = np.linalg.inv(K_P) + lever @ gives[0] @ lever.T + gives[1]
    found = compliance_at_tip(model.limb(link(base_give=gives[0], tip_give=gives[1])))  # type: ignore[attr-defined]
    scale = 1 / np.sqrt(np.diag(expected))
    np.testing.assert_allclose(scale[:, None] * found * scale, scale[:, None] * expected * scale, atol=1e-9)


def test_a_base_that_tilts_turns_the_bar_and_not_its_shape() -> None:
    tilt = 1e-6
    give = np.zeros((6, 6))
    give[5, 5] = tilt
    moment = 100.0
    for model in (Refined(1), Refined(6)):
        straight, tilted = bar(model), bar(model, base_give=give)
        readings = []
        for it in (straight, tilted):
            state = equilibrium(it, moment * np.eye(6)[5], ())
            readings.append(it.gauge(0.5, (0.0, 1.0, 0.0)).reading(state))
        # The turn enters at the middle of the first segment's rotation; its own sag sees nothing of it.
        limit = 1e-9 if model.segments > 1 else 0.3 * tilt * moment * LENGTH
        assert readings[1] - readings[0] == pytest.approx(tilt * moment * LENGTH / 2, abs=limit)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("direction", [1, 2])
def test_a_heavy_cantilever_bends_as_it_should(model: object, direction: int) -> None:
    """w L⁴ / (8 EI) + w L² / (2 GA) and w L³ / (6 EI)."""
    w = 1e-5 * np.eye(3)[direction]
    it = replace(bar(model), line_load=w)
    state = equilibrium(it, np.zeros(6), ())
    ei, ga = ((BAR_P.ei_z, BAR_P.ga_y), (BAR_P.ei_y, BAR_P.ga_z))[direction - 1]
    deflection = 1e-5 * (LENGTH**4 / (8 * ei) + LENGTH**2 / (2 * ga))
    turn = 1e-5 * LENGTH**3 / (6 * ei) * (1.0 if direction == 1 else -1.0)
    moved = state.pose - it.unloaded_pose
    assert moved[direction] == pytest.approx(deflection, rel=2e-4)
    assert moved[{1: 5, 2: 4}[direction]] == pytest.approx(turn, rel=2e-4)
    # All of the weight arrives at the base: held at the tip, half of it at either end.
    held = equilibrium(it, it.unloaded_pose)
    assert held.load[direction] == pytest.approx(-0.5 * 1e-5 * LENGTH, rel=1e-3)


@pytest.mark.parametrize("model", MODELS)
def test_a_warm_bar_grows_freely_and_presses_when_held(model: object) -> None:
    it = bar(model, elongation=(("temperature_rise", 0.007),))
    free = equilibrium(it, np.zeros((2, 6)), (), drives={"temperature_rise": [0.0, 10.0]})
    np.testing.assert_allclose(free.pose[:, 0] - LENGTH, [0.0, 0.07], atol=1e-12)
    held = equilibrium(it, it.unloaded_pose, drives={"temperature_rise": 10.0})
    assert held.load[0] == pytest.approx(-0.07 * K_P[0, 0], rel=1e-9)


def test_a_longer_bar_follows_its_section() -> None:
    """The uniform bar's own stiffness at the new length."""
    short = link().lengthened(-40.0)
    # Shear does not follow the third power: 6e-3 of K33 for 13 % of the length.
    np.testing.assert_allclose(short.stiffness, BAR_P.stiffness(LENGTH - 40.0), rtol=8e-3)
    slender = Link(LENGTH, replace(BAR_P, ga_y=np.inf, ga_z=np.inf).stiffness(LENGTH)).lengthened(25.0)
    expected = replace(BAR_P, ga_y=np.inf, ga_z=np.inf).stiffness(LENGTH + 25.0)
    np.testing.assert_allclose(slender.stiffness, expected, rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize("q", [0.0, 0.4])
def test_a_longer_bar_1_tilts_the_platform(q: float) -> None:
    """Unloaded with z held: ry = -m / (d cos q), x moves by m / (2 cos q)."""
    m = 1e-3
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q)
    linkage = linkage.altered(lambda number, it: it.lengthened(m) if number == 0 else it)
    targets = np.where([False, False, True, False, False, False], linkage.unloaded_pose, 0.0)
    moved = equilibrium(linkage, targets, ("z",)).pose - linkage.unloaded_pose
    assert moved[4] == pytest.approx(-m / (WIDTH * np.cos(q)), rel=1e-4)
    assert moved[0] == pytest.approx(m / (2 * np.cos(q)), rel=1e-4)


@pytest.mark.parametrize("model", MODELS)
def test_a_slide_is_a_spring_along_the_bar(model: object) -> None:
    c = 3e4
    it = bar(model, slides=(Linear(np.array([[c]])),))
    compliance = np.linalg.inv(unloaded_stiffness(it))
    expected = np.linalg.inv(K_P)
    expected[0, 0] += 1 / c
    np.testing.assert_allclose(compliance, expected, rtol=1e-6, atol=1e-12)


def test_one_linkage_serves_all_angles() -> None:
    """The input q, one value for each load case, against linkages built at each angle."""
    hinge = Linear(np.array([[800.0]]))
    angles = np.radians([-30.0, 0.0, 20.0])
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, hinges=(hinge,))
    poses = [replace(linkage, q=q).unloaded_pose for q in angles]
    targets = np.array(poses) + [-0.02, 0.5, 1.0, 0.0, 0.0, 0.0]
    together = equilibrium(linkage, targets, drives={"q": angles})
    assert np.all(together.converged)
    for k, q in enumerate(angles):
        alone = equilibrium(replace(linkage, q=float(q)), targets[k])
        np.testing.assert_allclose(together.load[k], alone.load, rtol=1e-9, atol=1e-7)
        gauge = replace(linkage, q=float(q)).gauge(1, 0.5, (0.0, 0.0, 1.0))
        assert linkage.gauge(1, 0.5, (0.0, 0.0, 1.0)).reading(together)[k] == pytest.approx(
            float(gauge.reading(alone)), abs=1e-10
        )
    with pytest.raises(ValueError, match="inputs of this mechanism"):
        unloaded(linkage, {"angle": 0.0})
