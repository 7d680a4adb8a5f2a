"""How equilibria are found: quadratic convergence, independence of the path, reciprocity, reasons of failure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.frame import newton
from fem.frame.bench import Trial, run
from fem.frame.control import DISPLACEMENT, FORCE, Targets
from fem.frame.control import GAUGE as GAUGE_0
from fem.frame.errors import Errors
from fem.frame.history import settled, unloaded_bars
from fem.frame.linkages import Setup, model
from fem.frame.rig import Gauge, Rig
from fem.frame.section import uniform
from tests.fem.frame.rigs import ORTHOGLIDE, control, measure, parallelogram, steps

RIG = parallelogram(ORTHOGLIDE)
GUIDED = ("y", "z", "rx", "ry", "rz")
ALL = ("x", *GUIDED)
SMOOTH = {
    "bar_length_mismatch.mismatch_mm": 0.1,
    "bar_initial_bow.bow_y_mm": 0.3,
    "bar_initial_bow.bow_z_mm": 0.2,
    "axis_flexibility.radial_mm_per_N": 1e-6,
    "axis_flexibility.tilt_rad_per_Nmm": 1e-7,
    "joint_torsional_stiffness.stiffness_Nmm_per_rad": 500.0,
    "base_compliance.x_mm_per_N": 1e-6,
    "base_compliance.rx_rad_per_Nmm": 1e-8,
    "base_compliance.ry_rad_per_Nmm": 1e-9,
    "base_compliance.rz_rad_per_Nmm": 1e-8,
    "mounting_tilt.rz_rad": 2e-3,
    "load_misalignment.ry_rad": 0.01,
    "load_offset.x_mm": 3.0,
    "self_weight.line_y_N_per_mm": -0.01,
    "self_weight.fz_N": -20.0,
}
GAUGE = Gauge("mid", 1, 0.3, (0.0, 1.0, 0.0))


def test_newtons_method_converges_quadratically(monkeypatch: pytest.MonkeyPatch) -> None:
    """Steps from an equilibrium to a target δ away leave an out-of-balance of the order δ², then δ⁴.

    With every smooth effect at once and mixed control, a gauge among it.
    """
    frame = model([Setup(RIG, 0.3, Errors.of(SMOOTH))], [GAUGE])
    first = settled(frame, np.array([[False, False, True, False, False, False]]))
    kind = np.array([[FORCE, GAUGE_0, DISPLACEMENT, FORCE, DISPLACEMENT, DISPLACEMENT]])
    value = np.array([[-1500.0, 0.8, 9.0, 1000.0, 2e-4, 3e-3]])
    warm = unloaded_bars(frame, frame.reference_temperature)
    there = newton.equilibrium(frame, warm, first.state, Targets(kind, value), np.ones(1), first.gauge)
    assert there.code[0] == newton.CONVERGED
    for iterations, parts, order in ((1, (1e-2, 1e-3), 2), (2, (0.4, 0.2), 4)):
        monkeypatch.setattr(newton, "ITERATIONS", iterations)
        left = []
        for part in parts:
            goal = Targets(kind, value * (1.0 + part))
            left.append(
                newton.equilibrium(frame, warm, there.state, goal, np.ones(1), first.gauge).residual[0]
            )
        assert left[1] > 100.0, "the out-of-balance is not above rounding"
        found = np.log(left[0] / left[1]) / np.log(parts[0] / parts[1])
        # Measured 2.00 and 3.88; a tangent wrong by 1e-4 gives 2.5 for the second.
        assert found == pytest.approx(order, abs=0.3)


@pytest.mark.parametrize("effects", [{}, SMOOTH], ids=["plain", "smooth effects"])
def test_conservative_effects_do_not_remember(effects: dict[str, float]) -> None:
    end = {"x": -800.0, "y": 3.0, "z": 8.0, "rx": 0.01, "ry": 1e-4, "rz": 5e-3}
    direct = steps(**end)
    around = np.concatenate(([[500.0, -4.0, -6.0, 0, 0, 0], [900.0, 2.0, 3.0, -0.01, -1e-4, 0.01]], direct))
    one = measure(RIG, GUIDED, direct, 15, effects)
    two = measure(RIG, GUIDED, around, 15, effects)
    np.testing.assert_allclose(two.displacement[-1], one.displacement[-1], atol=1e-9)
    np.testing.assert_allclose(two.wrench[-1], one.wrench[-1], rtol=1e-9, atol=1e-5)


def test_work_around_a_closed_path_is_nothing() -> None:
    """Forces of a conservative frame: their work along a closed path of the platform vanishes."""
    angle = np.linspace(0.0, 2 * np.pi, 25)
    pose = steps(y=list(2.0 * np.sin(angle)), rz=list(1e-2 * (1 - np.cos(angle))))
    wrench = measure(RIG, ALL, pose, 20, {"bar_initial_bow.bow_y_mm": 0.3}).wrench
    # rz alone turns the platform: its moment is the generalised force; the trapezoidal rule is exact on a circle.
    rate = np.stack((2.0 * np.cos(angle), 1e-2 * np.sin(angle)), axis=-1)
    power = (wrench[:, [1, 5]] * rate).sum(1)
    assert abs(power[1:].mean()) < 1e-7 * np.abs(power).max()


def test_maxwells_reciprocity_under_load() -> None:
    """The tangent about a loaded state whose platform did not turn is symmetric in forces and moments."""
    state = np.array([-0.06, 2.0, 4.0, 0.0, 0.0, 0.0])
    size = np.array([1e-4] * 3 + [1e-6] * 3)
    trials = [
        Trial(0.2, control(*ALL), np.stack((state, state + s * d))) for d in np.diag(size) for s in (1, -1)
    ]
    found = run(RIG, Errors.of({"bar_initial_bow.bow_y_mm": 0.3}), trials)
    wrench = np.array([r.wrench[1] for r in found]).reshape(6, 2, 6)
    stiffness = (wrench[:, 0] - wrench[:, 1]) / (2 * size[:, None])
    moment = found[0].wrench[0, 3:]
    # The generalised force of a rotation vector is m - ½ θ x m near θ = 0; rows are displacements here.
    skew = 0.5 * np.array(
        [[0, moment[2], -moment[1]], [-moment[2], 0, moment[0]], [moment[1], -moment[0], 0]]
    )
    stiffness[3:, 3:] += skew
    root = np.sqrt(np.abs(np.diag(stiffness)))
    scaled = stiffness / np.outer(root, root)
    np.testing.assert_allclose(scaled, scaled.T, atol=1e-6)


def test_a_batch_is_its_members() -> None:
    trials = [
        Trial(
            q, control(*GUIDED), steps(x=[-300.0 * k, 400.0], y=[float(k), -1.0], z=[2.0, 5.0])[: 1 + k % 2]
        )
        for k, q in enumerate((-0.4, 0.0, 0.3))
    ]
    together = run(RIG, Errors.of(SMOOTH), trials, [GAUGE])
    for trial, found in zip(trials, together, strict=True):
        alone = run(RIG, Errors.of(SMOOTH), [trial], [GAUGE])[0]
        assert len(found.reason) == len(trial.values)
        np.testing.assert_allclose(found.wrench, alone.wrench, rtol=1e-9, atol=1e-6)
        np.testing.assert_allclose(found.displacement, alone.displacement, atol=1e-10)
        np.testing.assert_allclose(found.gauges, alone.gauges, atol=1e-10)


def test_what_cannot_be_held_is_said_and_spoils_no_other() -> None:
    runaway = Trial(0.0, control("y", "rx", "ry", "rz"), steps(z=[1.0, 0.0]))
    fine = Trial(0.0, control(*GUIDED), steps(x=[-500.0, 10.0]))
    lost, found = run(RIG, Errors(), [runaway, fine])
    assert found.converged.all() and not lost.converged.any()
    assert lost.reason[0] and "before" in lost.reason[1]
    assert np.isnan(lost.wrench).all()


def test_too_much_load_on_a_column_is_unstable() -> None:
    found = measure(RIG, ("z", "rx", "ry", "rz"), steps(x=[-5000.0, -12000.0]))
    np.testing.assert_array_equal(found.negative, [0, 1])


def test_gauge_as_input() -> None:
    kinds = ("force", "mid", "displacement", "force", "force", "force")
    driven = Trial(0.1, kinds, steps(x=[-100.0, 50.0], y=[0.3, -0.2], z=[3.0, 1.0]))
    gauge = Gauge("mid", 2, 0.5, (0.0, 1.0, 0.0))
    found = run(RIG, Errors.of(SMOOTH), [driven], [gauge])[0]
    assert found.converged.all(), found.reason
    np.testing.assert_allclose(found.gauges[:, 0], [0.3, -0.2], atol=1e-8)
    values = steps(x=[-100.0, 50.0], y=list(found.wrench[:, 1]), z=[3.0, 1.0])
    again = measure(RIG, ("z",), values, np.degrees(0.1), SMOOTH, gauges=(gauge,))
    # Newton's limit of 1e-5 N over the softest 20 N/mm.
    np.testing.assert_allclose(again.displacement, found.displacement, atol=1e-6)


def test_gauges_follow_the_bar() -> None:
    stations = [Gauge(f"g{s}", 1, s, (0.0, 1.0, 0.0)) for s in (0.0, 0.25, 0.4, 1.0)]
    rig = replace(RIG, bar=parallelogram().bar, kind="bar", tip="guided")
    found = measure(rig, (), steps(y=0.5), gauges=tuple(stations))
    s = np.array([g.station for g in stations])
    # A guided bar: w (3 s² - 2 s³); second order, (1/310)² of it.
    np.testing.assert_allclose(
        found.gauges[0], found.displacement[0, 1] * (3 * s**2 - 2 * s**3), rtol=1e-4, atol=1e-12
    )


def test_a_gauge_is_zero_in_the_unloaded_state() -> None:
    effects = {
        "bar_initial_bow.bow_y_mm": 0.7,
        "mounting_tilt.rx_rad": 5e-3,
        "bar_length_mismatch.mismatch_mm": 0.2,
    }
    gauge = Gauge("mid", 1, 0.5, (0.0, 1.0, 0.0))
    found = measure(RIG, ("z",), steps(z=0.0), 0, effects, gauges=(gauge,))
    np.testing.assert_allclose(found.gauges, 0.0, atol=1e-9)


def test_a_load_reversed_through_the_play_turns_no_element_over() -> None:
    """Short stiff bars with play on a soft base, pulled with 10 kN and pushed with 10 kN at the next step: Newton's
    method may end with one element of each bar pointing backwards, 28 mm away, in balance and stable."""
    bar = uniform(EA=9474782.27, EIy=662925701.17, EIz=149158282.76, GJ=35797987.86)
    rig = Rig("parallelogram", 186.4, bar, 58.2)
    effects = {
        "joint_clearance.play_mm": 0.006148,
        "base_compliance.x_mm_per_N": 7.3646e-07,
        "base_compliance.y_mm_per_N": 1.58618e-06,
        "base_compliance.z_mm_per_N": 1.35196e-06,
        "base_compliance.rx_rad_per_Nmm": 3.8043e-10,
        "base_compliance.ry_rad_per_Nmm": 3.9475e-10,
        "base_compliance.rz_rad_per_Nmm": 7.9734e-10,
    }
    forces = [0.0, 20985.46, 31478.19, 10492.73, -10492.73, -31478.19, -20985.46, 0.0]
    found = measure(rig, GUIDED, steps(x=forces), -30.0, effects)
    x = found.displacement[:, 0]
    assert found.negative.max() == 0
    np.testing.assert_allclose(x[[3, 2]], -x[[4, 5]], rtol=5e-3)
