"""Every effect of the bench against its closed form, on slender bars: small loads, so that the forms are linear."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.frame.bench import Readings, Trial, run
from fem.frame.errors import Errors
from fem.frame.rig import Gauge, Rig
from fem.frame.so3 import exp, log
from meshes.solid import Floats
from tests.fem.frame.rigs import LENGTH, SLENDER, WIDTH, control, measure, parallelogram, steps

RIG = parallelogram()
AXIAL = 2 * SLENDER.EA / LENGTH
GUIDED = ("y", "z", "rx", "ry", "rz")
ALL = ("x", *GUIDED)


def x_per_force(effects: dict[str, float], load: float = 100.0, degrees: float = 0.0) -> float:
    """x under a force along x, the rest held, over that of the plain rig, mm/N."""
    one, plain = (measure(RIG, GUIDED, steps(x=load), degrees, e).displacement[0, 0] for e in (effects, {}))
    return float(one - plain) / load


def test_modulus_scales_forces() -> None:
    pose = steps(x=1e-3, y=2e-3, rx=1e-5, ry=-1e-5, rz=2e-5)
    plain = measure(RIG, ALL, pose, 20).wrench
    np.testing.assert_allclose(
        measure(RIG, ALL, pose, 20, {"modulus_error.scale": 0.93}).wrench, 0.93 * plain, rtol=1e-9
    )


def test_a_softer_second_bar_turns_the_platform() -> None:
    found = measure(RIG, ("y", "z", "rx", "rz"), steps(x=100.0), 0, {"bar_stiffness_asymmetry.ratio": 0.9})
    one, two = np.array([1.0, 1 / 0.9]) * 50.0 / SLENDER.EA * LENGTH
    # Second order: the product of 2e-5 rad and 2e-3 mm.
    assert found.displacement[0, 4] == pytest.approx((two - one) / WIDTH, rel=1e-4)
    assert found.displacement[0, 0] == pytest.approx((one + two) / 2, rel=1e-4)


@pytest.mark.parametrize("degrees", [0, 25])
def test_length_mismatch_tilts_the_platform(degrees: float) -> None:
    m, c = 0.05, np.cos(np.radians(degrees))
    found = measure(RIG, ("z",), steps(x=0.0), degrees, {"bar_length_mismatch.mismatch_mm": m}).displacement[
        0
    ]
    # Second order: m / d = 6e-4 relative, times tan q.
    assert found[4] == pytest.approx(-m / (WIDTH * c), rel=1e-3)
    assert found[0] == pytest.approx(m / (2 * c), rel=1e-3)
    np.testing.assert_allclose(found[[1, 2, 3, 5]], 0.0, atol=1e-12)


def test_mismatch_is_forced_where_the_tilt_is_held() -> None:
    m = 0.05
    found = measure(RIG, ("z", "ry"), steps(x=0.0), 0, {"bar_length_mismatch.mismatch_mm": m})
    assert found.displacement[0, 0] == pytest.approx(m / 2, rel=1e-3)
    assert found.wrench[0, 4] == pytest.approx(m / WIDTH * AXIAL * WIDTH**2 / 4, rel=1e-3)


@pytest.mark.parametrize("degrees", [0, 25])
def test_longer_bars_and_wider_bodies(degrees: float) -> None:
    q = np.radians(degrees)
    longer = measure(RIG, ("z",), steps(z=-0.1 * np.sin(q)), degrees, {"dimension_error.length_mm": 0.1})
    np.testing.assert_allclose(
        longer.displacement[0], [0.1 * np.cos(q), 0, -0.1 * np.sin(q), 0, 0, 0], atol=1e-12
    )
    turned = steps(ry=1e-6)
    wide, plain = (
        measure(RIG, ALL, turned, degrees, {"dimension_error.width_mm": w}).wrench[0, 4] for w in (2.0, 0.0)
    )
    assert wide / plain == pytest.approx((1.0 + 2.0 / WIDTH) ** 2, rel=1e-6)


@pytest.mark.parametrize(("plane", "EI"), [("y", SLENDER.about_z.EI), ("z", SLENDER.about_y.EI)])
def test_a_bow_softens_a_bar_along_its_axis(plane: str, EI: float) -> None:
    """A pinned half sine e under P: the shortening is P L/EA + P e² L / (2 EI); clamped, that of the mode shape."""
    bow, load = 0.2, 10.0
    rig = replace(RIG, kind="bar", base="pinned", tip="pinned")
    effects = {f"bar_initial_bow.bow_{plane}_mm": bow}
    bowed, plain = (measure(rig, (), steps(x=-load), 0, e).displacement[0, 0] for e in (effects, {}))
    if plane == "z":
        # e (1 + P/Pe): P / Pe is 5e-4 here.
        assert plain - bowed == pytest.approx(load * bow**2 * LENGTH / (2 * EI), rel=3e-3)
    else:
        # Clamped in this plane: the mean moment of the sine, 2 P e / π, is taken by the ends.
        mean = 1.0 - 8.0 / np.pi**2
        assert plain - bowed == pytest.approx(mean * load * bow**2 * LENGTH / (2 * EI), rel=1e-2)


def test_the_ends_of_a_bowed_bar_stay_nominal() -> None:
    found = measure(
        RIG, ("z",), steps(x=0.0), 15, {"bar_initial_bow.bow_y_mm": 0.4, "bar_initial_bow.bow_z_mm": 0.7}
    )
    np.testing.assert_allclose(found.displacement, 0.0, atol=1e-12)


def test_radial_compliance_adds_along_the_bars() -> None:
    c = 2e-6
    for degrees in (0.0, 30.0):
        # Two hinges in a row, two bars side by side; held in z, the bars' force is that of x over cos q.
        share = np.cos(np.radians(degrees)) ** 2
        found = x_per_force({"axis_flexibility.radial_mm_per_N": c}, 100.0, degrees)
        assert found == pytest.approx(2 * c / 2 / share, rel=1e-4)


def test_tilt_compliance_adds_in_bending() -> None:
    c = 1e-7
    effects = {"axis_flexibility.tilt_rad_per_Nmm": c}
    one, plain = (
        measure(RIG, ("x", "z", "rx", "ry", "rz"), steps(y=1.0), 0, e).displacement[0, 1]
        for e in (effects, {})
    )
    # A guided bar: half the force, a moment of F L / 2 and a hinge at each end.
    assert one - plain == pytest.approx(0.5 * LENGTH**2 / 4 * 2 * c, rel=1e-4)
    twist = measure(RIG, ALL, steps(rx=1e-6), 0, effects).wrench[0, 3] / 1e-6
    # rx at the platform: bars twist in a row with two hinges, and bend guided by d/2 with soft ends.
    each = 1.0 / (LENGTH / SLENDER.GJ + 2 * c)
    sway = 1.0 / (LENGTH**3 / (12 * SLENDER.about_z.EI) + LENGTH**2 / 2 * c)
    assert twist == pytest.approx(2 * each + sway * WIDTH**2 / 2, rel=1e-5)


def test_vanishing_compliance_is_a_rigid_axis() -> None:
    pose = steps(x=0.02, y=1.0, z=4.0, rx=1e-3, ry=1e-5, rz=2e-3)
    plain = measure(RIG, ALL, pose, 20).wrench
    effects = {"axis_flexibility.radial_mm_per_N": 1e-15, "axis_flexibility.tilt_rad_per_Nmm": 1e-17}
    tiny = measure(RIG, ALL, pose, 20, effects).wrench
    np.testing.assert_allclose(tiny, plain, rtol=1e-7, atol=1e-5)


def test_play_opens_between_tension_and_compression() -> None:
    play = 0.04
    loads = [50.0, -50.0, -100.0, 100.0, 0.1]
    x = measure(RIG, GUIDED, steps(x=loads), 0, {"joint_clearance.play_mm": play}).displacement[:, 0]
    rest = x - np.array(loads) / AXIAL
    # The stop gives F / 1e8, half the force in each bar; 0.1 N is inside, on two springs of 20 N/mm.
    np.testing.assert_allclose(rest[:4], [play, -play, -play, play], atol=1e-6)
    assert rest[4] == pytest.approx(0.1 / 40.0, rel=1e-6)


def test_friction_holds_until_it_slips() -> None:
    torque, presliding = 300.0, 1e-3
    effects = {"joint_friction.torque_Nmm": torque, "joint_friction.presliding_rad": presliding}
    travel = [0.1, 1.0, 2.0, 1.0, 0.0]
    held = ("x", *GUIDED)
    arc = -(np.array(travel) ** 2) / (2 * LENGTH)
    fz, plain = (measure(RIG, held, steps(x=list(arc), z=travel), 0, e).wrench[:, 2] for e in (effects, {}))
    # Four hinges; the bars turn by z / L. Before slip each spring is in a row with a bar that bends into an S.
    stick = 1.0 / (presliding / torque + LENGTH / (6 * SLENDER.about_y.EI))
    expected = np.array([4 * stick * 0.1 / LENGTH, *[4 * torque] * 2, *[-4 * torque] * 2]) / LENGTH
    # Second order: (z / L)² = 4e-5.
    np.testing.assert_allclose(fz - plain, expected, rtol=1e-4)


def test_hinge_springs_pull_back() -> None:
    k = 500.0
    effects = {"joint_torsional_stiffness.stiffness_Nmm_per_rad": k}
    for degrees in (0.0, 30.0):
        turn = 2e-3
        q = np.radians(degrees)
        shift = LENGTH * (exp(np.array([0, turn, 0])) - np.eye(3)) @ [np.cos(q), 0, -np.sin(q)]
        found = measure(RIG, ("z",), steps(z=shift[2]), degrees, effects)
        # Four springs turned; the force along z does its work through L cos q. Bars are 1e3 times stiffer.
        assert found.wrench[0, 2] == pytest.approx(-4 * k * turn / (LENGTH * np.cos(q + turn)), rel=2e-3)


def test_contact_is_hertz_in_a_row_with_the_bar() -> None:
    c = 3e-5
    for load in (-3000.0, 200.0):
        expected = c * np.sign(load) * abs(load / 2) ** (2 / 3)
        # Compression bends nothing here: straight bars, far from 36 kN.
        assert x_per_force({"contact_stiffening.c_mm_per_N23": c}, load) * load == pytest.approx(
            expected, rel=1e-6
        )


def test_base_compliance_is_a_spring_at_the_origin() -> None:
    names = [*(f"{a}_mm_per_N" for a in "xyz"), *(f"r{a}_rad_per_Nmm" for a in "xyz")]
    size = [1e-6, 2e-6, 3e-6, 1e-9, 2e-9, 3e-9]
    effects = {f"base_compliance.{n}": c for n, c in zip(names, size, strict=True)}
    load = np.array([0.3, 0.02, 0.0, 5.0, 8.0, 3.0])
    values = steps(**dict(zip(("x", "y", "rx", "ry", "rz"), load[[0, 1, 3, 4, 5]], strict=True)))
    soft, hard = (measure(RIG, ("z",), values, 0, e) for e in (effects, {}))
    arm = np.eye(6)
    arm[3:, :3] = np.cross([LENGTH, 0, 0], np.eye(3)).T
    base = np.diag(size) @ arm @ soft.wrench[0]
    expected = arm.T @ base
    # z is held: the linkage swings back by what the base lifts, free of force and of turn, at q = 0.
    expected[2] = 0.0
    moved = soft.displacement[0] - hard.displacement[0]
    # Second order: 0.3 N of tension over a critical load of 2 kN.
    np.testing.assert_allclose(moved, expected, rtol=1e-3, atol=1e-11)


def test_mounting_tilt_turns_the_whole_linkage() -> None:
    turn = np.array([1e-3, -2e-3, 3e-3])
    names = ("rx_rad", "ry_rad", "rz_rad")
    effects = {f"mounting_tilt.{n}": v for n, v in zip(names, turn, strict=True)}
    R = exp(turn)
    q = np.radians(20.0)
    nominal = RIG.platform(q)
    pose = np.array([0.01, 0.2, -0.1, 1e-4, 2e-5, 3e-4])
    position = R @ (nominal + pose[:3]) - nominal
    orientation = log(R @ exp(pose[3:]))
    tilted = measure(RIG, ALL, np.concatenate((position, orientation))[None], 20.0, effects).wrench[0]
    plain = measure(RIG, ALL, pose[None], 20.0).wrench[0]
    np.testing.assert_allclose(tilted, np.concatenate((R @ plain[:3], R @ plain[3:])), rtol=1e-8, atol=1e-6)


def test_load_cell_turned_and_offset() -> None:
    turn, r = np.array([0.02, -0.03, 0.05]), np.array([4.0, -2.0, 3.0])
    effects = {f"load_misalignment.r{a}_rad": v for a, v in zip("xyz", turn, strict=True)}
    effects |= {f"load_offset.{a}_mm": v for a, v in zip("xyz", r, strict=True)}
    pose = steps(x=0.01, y=1.0, z=0.5, rx=1e-3, ry=1e-5, rz=2e-3)
    true = measure(RIG, ALL, pose, 20).wrench[0]
    read = measure(RIG, ALL, pose, 20, effects).wrench[0]
    R = exp(turn)
    expected = np.concatenate((R.T @ true[:3], R.T @ (true[3:] - np.cross(r, true[:3]))))
    np.testing.assert_allclose(read, expected, rtol=1e-9)
    assert np.abs(read - true).max() > 1.0


def test_a_controlled_force_is_a_reading() -> None:
    effects = {"load_misalignment.rz_rad": 0.05, "load_offset.y_mm": 2.0}
    found = measure(RIG, ("z", "rx", "ry", "rz"), steps(x=-200.0, y=3.0), 0, effects)
    np.testing.assert_allclose(found.wrench[0, :2], [-200.0, 3.0], atol=1e-9)
    true = exp(np.array([0, 0, 0.05])) @ found.wrench[0, :3]
    plain = measure(RIG, ("z", "rx", "ry", "rz"), steps(x=true[0], y=true[1]), 0)
    np.testing.assert_allclose(found.displacement, plain.displacement, atol=1e-10)


def test_bars_grow_with_temperature() -> None:
    alpha, warm = 2.3e-5, np.array([20.0, 30.0, 15.0])
    effects = {"thermal_expansion.alpha_per_K": alpha}
    free = measure(RIG, ("z",), steps(x=[0.0] * 3), 0, effects, temperature=warm)
    np.testing.assert_allclose(free.displacement[:, 0], alpha * (warm - 20.0) * LENGTH, atol=1e-12)
    # Held, they push: EA alpha dT, of which the longer bar keeps all but alpha dT.
    held = measure(RIG, ALL, steps(x=[0.0] * 3), 0, effects, temperature=warm)
    np.testing.assert_allclose(
        held.wrench[:, 0], -2 * SLENDER.EA * alpha * (warm - 20.0), rtol=1e-3, atol=1e-6
    )


def test_weights_are_dead_loads() -> None:
    rig = replace(RIG, gravity=(0.0, -2.0, 0.0), line_weight=0.01, platform_weight=7.0)
    held = measure(rig, ALL, steps(x=0.0))
    bars = 0.01 * 2 * LENGTH
    np.testing.assert_allclose(held.wrench[0, 1], 7.0 + bars / 2, rtol=1e-6)
    assert held.wrench[0, 5] == pytest.approx(-0.01 * 2 * LENGTH**2 / 12, rel=1e-6)
    effects = {"self_weight.fy_N": -7.0, "self_weight.line_y_N_per_mm": -0.01}
    np.testing.assert_allclose(measure(RIG, ALL, steps(x=0.0), 0, effects).wrench, held.wrench, atol=1e-9)
    # A cantilever under its own weight: w L⁴ / (8 EI).
    bar = Rig("bar", LENGTH, SLENDER)
    sag = measure(bar, (), steps(x=0.0), 0, {"self_weight.line_y_N_per_mm": -1e-3}).displacement[0, 1]
    assert sag == pytest.approx(-1e-3 * LENGTH**4 / (8 * SLENDER.about_z.EI), rel=1e-5)


def test_a_bar_yields_at_its_outer_fibre() -> None:
    rig = replace(RIG, kind="bar")
    limit = 1e-3
    first = limit * SLENDER.about_z.EI / rig.fibre_y
    loads = [0.99 * first, 1.0, 1.3 * first, 0.0]
    effects = {"material_yield.strain": limit}
    turn, elastic = (measure(rig, (), steps(rz=loads), 0, e).displacement[:, 5] for e in (effects, {}))
    # The second keeps the rounding of the first, some thousand times larger.
    np.testing.assert_allclose(turn[:2], elastic[:2], rtol=1e-9, atol=1e-11 * elastic[0])
    assert turn[2] > 1.02 * elastic[2]
    # Unloading is elastic: what stays is what was lost.
    assert turn[3] == pytest.approx(turn[2] - elastic[2], rel=1e-6)


OF_MACHINES = ("actuator_compliance", "link_compliance")
OF_LINKAGES = {p: v for p, v in Errors().values().items() if p.split(".")[0] not in OF_MACHINES}
NULLS: list[dict[str, float]] = [{path: value} for path, value in OF_LINKAGES.items() if np.isfinite(value)]


def a_bench(errors: Errors) -> list[Readings]:
    values: Floats = steps(x=[-500.0, 300.0], y=[2.0, -1.0], z=[5.0, 0.0], rx=[1e-3, 2e-3], rz=[1e-3, 2e-3])
    gauge = Gauge("mid", 2, 0.5, (0.0, 1.0, 0.0))
    return run(RIG, errors, [Trial(0.3, control(*GUIDED), values, np.array([20.0, 35.0]))], [gauge])


def test_null_values_change_nothing() -> None:
    plain = a_bench(Errors())[0]
    for null in NULLS:
        found = a_bench(Errors.of(null))[0]
        np.testing.assert_array_equal(found.displacement, plain.displacement)
        np.testing.assert_array_equal(found.wrench, plain.wrench)
    high = a_bench(Errors.of({"material_yield.strain": 1.0}))[0]
    np.testing.assert_allclose(high.wrench, plain.wrench, rtol=1e-12, atol=1e-9)


def test_every_effect_does_something() -> None:
    plain = a_bench(Errors())[0]
    for path, value in OF_LINKAGES.items():
        size = 2e-4 if path == "material_yield.strain" else value + (0.2 if value else 1e-4)
        extra = {"joint_friction.torque_Nmm": 200.0} if path == "joint_friction.presliding_rad" else {}
        base = a_bench(Errors.of(extra))[0] if extra else plain
        found = a_bench(Errors.of({path: size, **extra}))[0]
        change = (
            np.abs(found.wrench - base.wrench).max() + np.abs(found.displacement - base.displacement).max()
        )
        # The load cell's offset needs a moment to be read; all do here, weights of bars least.
        assert change > 1e-6, path


@pytest.mark.parametrize("path", ["actuator_compliance.mm_per_N", "link_compliance.scale"])
def test_a_linkage_has_no_drives_and_no_links(path: str) -> None:
    with pytest.raises(ValueError, match="actuator_compliance and link_compliance need a machine"):
        a_bench(Errors.of({path: 0.5}))
