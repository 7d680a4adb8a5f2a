"""Effects on the linkage against closed forms at small loads; bars as built are in `tests/vjm/test_as_built.py`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.load_paths import load_path
from vjm import paper
from vjm.clearance import CENTRING
from vjm.effects import catalogue
from vjm.frames import Array
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import TrueMoment

LENGTH, WIDTH, K = paper.LENGTH, paper.WIDTH, paper.BAR_STIFFNESS
EFFECTS = catalogue()
GUIDED = ("y", "z", "rx", "ry", "rz")
ANGLES = [0.0, 0.5]


def linkage(name: str = "", q: float = 0.0, **values: float) -> Parallelogram:
    plain = Parallelogram(LENGTH, WIDTH, K, q, sensors=(TrueMoment(),))
    built = EFFECTS[name].apply(plain, {**EFFECTS[name].nulls, **values}) if name else plain
    assert isinstance(built, Parallelogram)
    return built


def displaced(it: Parallelogram, held: tuple[str, ...], **columns: Array) -> Array:
    """(S, 12) pose from nominal and wrench along a path; columns by coordinate, forces where it is not held."""
    names = ("x", "y", "z", "rx", "ry", "rz")
    steps = len(next(iter(columns.values())))
    mask = np.array([n in held for n in names])
    targets = np.tile(np.where(mask, it.unloaded_pose, 0.0), (steps, 1))
    for name, column in columns.items():
        targets[:, names.index(name)] += column
    path = load_path(it, targets, held)
    assert np.all(path.converged)
    return path.readings[:, :12] - np.append(it.unloaded_pose, np.zeros(6))


@pytest.mark.parametrize("q", ANGLES)
@pytest.mark.parametrize("refined", [False, True])
def test_play_is_a_dead_band(q: float, refined: bool) -> None:
    """Along x, z held: 2 K11 cos² q outside, two soft springs inside, ± play / cos q between the branches."""
    play = 0.02
    it = linkage("joint_clearance", q, play_mm=play)
    it = it.refined() if refined else it
    loads = np.array([4.0, 800.0, -800.0, 0.2])
    x = displaced(it, GUIDED, x=loads)[:, 0]
    along = loads / (2 * np.cos(q))
    inside = np.abs(along) <= CENTRING * play
    slide = np.where(inside, along / CENTRING, np.sign(along) * play)
    # The stops give F / 1e8, the centring spring carries 0.4 N of them; turning of the bars is of second order.
    expected = (along / K[0, 0] + slide) / np.cos(q)
    np.testing.assert_allclose(x, expected, rtol=2e-4, atol=1e-5)


@pytest.mark.parametrize("q", ANGLES)
def test_contact_follows_the_power_two_thirds(q: float) -> None:
    c = 8e-5
    loads = np.array([-1500.0, -10.0, 60.0, 1500.0])
    soft, hard = (
        displaced(it, GUIDED, x=loads)[:, 0]
        for it in (linkage("contact_stiffening", q, c_mm_per_N23=c), linkage(q=q))
    )
    along = loads / (2 * np.cos(q))
    expected = c * np.sign(along) * np.abs(along) ** (2 / 3) / np.cos(q)
    # Second order: the bars turn by x tan q / L, 1e-4 here.
    np.testing.assert_allclose(soft - hard, expected, rtol=1e-3)


@pytest.mark.parametrize("q", ANGLES)
def test_hinge_springs_carry_a_force_along_z(q: float) -> None:
    """Four springs turn by z / (L cos q): F = 4 k z / (L cos q)² with x free of force."""
    k = 900.0
    z = np.array([0.02, -0.05])
    found = displaced(
        linkage("joint_torsional_stiffness", q, stiffness_Nmm_per_rad=k), ("y", "z", "rx", "ry", "rz"), z=z
    )
    np.testing.assert_allclose(found[:, 8], 4 * k * z / (LENGTH * np.cos(q)) ** 2, rtol=1e-3)


@pytest.mark.parametrize("q", [pytest.param(0.0, marks=pytest.mark.long), 0.5])
def test_friction_encloses_an_area(q: float) -> None:
    """A full swing of ± a turn t: the loop takes 4 hinges x 4 T (t - presliding - bend), and slides at F = 4 T / arm.

    bend = T L / 6 E I: the friction at its two ends bends a bar by that much before the hinges slide.
    """
    torque, slip, amplitude = 250.0, 0.002, 4.0
    once = amplitude * np.interp(np.linspace(0, 1, 161), [0, 0.25, 0.75, 1.0], [0, 1, -1, 0])
    z = np.concatenate([once, once[1:]])
    it = linkage("joint_friction", q, torque_Nmm=torque, presliding_rad=slip)
    found = displaced(it, ("y", "z", "rx", "ry", "rz"), z=z)
    # One closed loop, from the first turning point to the same a swing later.
    loop = slice(40, 201)
    force, place = found[loop, 8], found[loop, 2]
    area = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(place)))
    ends = [np.arcsin((LENGTH * np.sin(q) - s * amplitude) / LENGTH) for s in (1, -1)]
    turn = 0.5 * (ends[1] - ends[0])
    bend = torque * LENGTH / (6 * K[2, 2] * LENGTH**3 / 12)
    # The trapezium misses the corners where the slide begins, 2e-4 of the area at 160 steps.
    assert area == pytest.approx(4 * 4 * torque * (turn - slip - bend), rel=5e-4)
    middle = int(np.argmin(np.abs(z[:60] - 0.5 * amplitude)))
    arm = np.sqrt(LENGTH**2 - (LENGTH * np.sin(q) - z[middle]) ** 2)
    assert found[middle, 8] == pytest.approx(4 * torque / arm, rel=1e-3)


@pytest.mark.parametrize("ratio", [0.8, 1.25])
def test_a_softer_bar_turns_the_platform(ratio: float) -> None:
    """Half of a force along x in each bar: bar 1 stretches by F / 2 K11, bar 2 by that over the ratio."""
    load = np.array([50.0])
    found = displaced(linkage("bar_stiffness_asymmetry", ratio=ratio), ("y", "z", "rx", "rz"), x=load)[0]
    one, two = load[0] / (2 * K[0, 0]), load[0] / (2 * K[0, 0] * ratio)
    # Second order: a turn of 1e-5 and the force of the bars across.
    assert found[4] == pytest.approx((one - two) * -1.0 / WIDTH, rel=1e-3)
    assert found[0] == pytest.approx((one + two) / 2, rel=1e-3)


@pytest.mark.parametrize("q", ANGLES)
def test_warm_bars_lift_the_platform(q: float) -> None:
    """With z held, longer bars move it by alpha T L / cos q along x."""
    alpha, rise = 1.2e-5, np.array([0.0, 25.0])
    it = linkage("thermal_expansion", q, alpha_per_K=alpha)
    target = np.where(np.arange(6) == 2, it.unloaded_pose, 0.0)
    path = load_path(it, np.tile(target, (2, 1)), ("z",), drives={"temperature_rise_K": rise})
    grown = alpha * rise * LENGTH
    # Second order: grown / L times tan² q.
    np.testing.assert_allclose(
        path.pose[:, 0] - it.unloaded_pose[0], grown / np.cos(q), rtol=1e-3, atol=1e-12
    )


def test_cell_and_mounting_change_what_is_read() -> None:
    """A force along x: the offset reads no moment of its own point, a turn by rz reads y = -rz x."""
    load = np.array([-400.0])
    offset = displaced(linkage("load_offset", y_mm=2.0, z_mm=-3.0), GUIDED, x=load)[0]
    plain = displaced(linkage(), GUIDED, x=load)[0]
    np.testing.assert_allclose(
        offset[9:] - plain[9:], -np.cross([0.0, 2.0, -3.0], [load[0], 0.0, 0.0]), atol=1e-9
    )
    turned = displaced(linkage("load_misalignment", rz_rad=0.01), ("x", *GUIDED), x=plain[:1])[0]
    np.testing.assert_allclose(turned[6:8], load[0] * np.array([np.cos(0.01), -np.sin(0.01)]), rtol=1e-9)
    tilted = displaced(linkage("mounting_tilt", rz_rad=1e-4), ("z",), x=np.zeros(1))[0]
    np.testing.assert_allclose(tilted[:6], [0, LENGTH * 1e-4, 0, 0, 0, 1e-4], atol=2e-6)


def test_dead_weight_is_carried_and_not_read() -> None:
    """Held in y, a weight of the platform shows as what the cell exerts against it."""
    found = displaced(linkage("self_weight", platform_y_N=6.0), ("x", *GUIDED), x=np.zeros(1))[0]
    np.testing.assert_allclose(found[6:9], [0.0, -6.0, 0.0], atol=1e-9)


def test_a_gauge_moves_with_a_base_that_gives() -> None:
    """The base turns by c m about z: a gauge on the bar sees that at its station, as the platform does at the tip."""
    give, moment = 2e-7, 300.0
    it = replace(linkage(), gauge_at=(GaugeAt(1, 0.4, (0.0, 1.0, 0.0)),))
    soft = EFFECTS["base_compliance"].apply(it, {**EFFECTS["base_compliance"].nulls, "rz_rad_per_Nmm": give})
    target = np.where(np.arange(6) == 2, it.unloaded_pose, moment * np.eye(6)[5])
    after, before = (load_path(rig, target[None], ("z",)).readings[0] for rig in (soft, it))
    # 3e-4 of turn by the bars' own bending makes this second order.
    assert after[12] - before[12] == pytest.approx(give * moment * 0.4 * LENGTH, rel=1e-3)
    assert after[1] - before[1] == pytest.approx(give * moment * LENGTH, rel=1e-3)
