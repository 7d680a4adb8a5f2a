"""LIN against the closed form K_p of Eq. 11, solved for the control by hand."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import SENSORS, PlannedTest
from pipeline.campaign import BarRig, Gauge, Noise, Test
from pipeline.inference.frame_prediction import predict_frame
from pipeline.inference.linear_prediction import predict_linear
from pipeline.inference.load_cases import load_cases
from pipeline.inference.residual import residual
from pipeline.simulate import bench_rig
from tests.pipeline.bench import bench
from vjm import paper
from vjm.frames import rotate_stiffness, rotation_y
from vjm.reasons import Reason
from vjm.stiffness import closed_form

RNG = np.random.default_rng(5)


def by_hand(stiffness: np.ndarray, test: Test) -> np.ndarray:
    """(N, 12) displacements and wrenches with F = K t for what the control prescribes."""
    inputs = test.inputs(())
    forced = np.array([by == "force" for by in test.control])
    t, f = np.where(forced, 0.0, inputs), np.where(forced, inputs, 0.0)
    right = f[:, forced] - t[:, ~forced] @ stiffness[np.ix_(forced, ~forced)].T
    t[:, forced] = np.linalg.solve(stiffness[np.ix_(forced, forced)], right.T).T
    f[:, ~forced] = (t @ stiffness.T)[:, ~forced]
    return np.hstack([t, f])


def test_a_parallelogram_follows_the_closed_form_in_any_control() -> None:
    """Rounding of a Newton step, relative to the largest reading of each channel."""
    cases = load_cases(bench(gauges=False))
    found = predict_linear(cases)
    assert not found.lost.any()
    for number, test in enumerate(cases.campaign.tests):
        k = closed_form(paper.BAR_STIFFNESS, 80.0, test.q)
        expected = by_hand(rotate_stiffness(k, rotation_y(test.q)), test)
        rows = slice(cases.first[number], cases.first[number + 1])
        scale = np.abs(expected).max(axis=0) + np.repeat([1.0, 1e-2, 1e3, 1e5], 3)
        assert np.max(np.abs(found.values[rows, :12] - expected) / scale) < 1e-9, test.id


def test_a_bar_follows_its_own_stiffness() -> None:
    k = paper.BAR_STIFFNESS
    rig = BarRig(length=310.0, bar_stiffness=k)
    values = RNG.normal(size=(5, 6)) * [100.0, 0.1, 5.0, 1e-3, 200.0, 1e-3]
    control = ("force", "displacement", "force", "displacement", "force", "displacement")
    planned = [PlannedTest("mixed", 0.0, control, values, np.full(5, 20.0))]
    noise = Noise(SENSORS.displacement, SENSORS.wrench, np.zeros(0), 0.1)
    cases = load_cases(measure("bar", rig, planned, noise, {}, 1))
    found = predict_linear(cases)
    expected = by_hand(k, cases.campaign.tests[0])
    scale = np.abs(expected).max(axis=0)
    assert np.max(np.abs(found.values - expected) / scale) < 1e-9


def test_gauges_see_the_bar_bend_as_a_beam_does() -> None:
    """Ends clamped against turning, tip moved by y: the middle moves y / 2, by symmetry of the S-shaped bar.

    The paper's K_b is not symmetric about the middle: 1.2 % of K26 / K22 against L / 2 (physics of Eq. 12).
    """
    cases = load_cases(bench())
    number = [t.id for t in cases.campaign.tests].index("lateral_q+0")
    rows = slice(cases.first[number], cases.first[number + 1])
    found = predict_linear(cases)
    y = cases.measured[rows, 1]
    assert np.allclose(found.values[rows, 12], y / 2, atol=0.02 * np.abs(y).max())


def test_what_nothing_holds_is_lost_with_a_reason() -> None:
    """z by force: any stiffness comes from tension, of which LIN knows nothing; the bench itself holds."""
    values = np.zeros((6, 6))
    values[:, 0] = np.linspace(500.0, 3000.0, 6)
    control = ("force", "displacement", "force", "displacement", "displacement", "displacement")
    planned = [PlannedTest("pull", 0.0, control, values, np.full(6, 20.0))]
    noise = Noise(SENSORS.displacement, SENSORS.wrench, np.zeros(0), 0.1)
    cases = load_cases(measure("pull", bench_rig(), planned, noise, {}, 1))
    found = predict_linear(cases)
    assert found.lost.all() and set(found.reasons.values()) == {Reason.NOT_HELD}


def test_the_frame_as_drawn_is_within_the_noise_and_loses_what_buckles() -> None:
    cases = load_cases(bench())
    tangent = predict_linear(cases)
    found = predict_frame(cases, lambda: tangent)
    assert not found.lost.any()
    axial = (cases.test == 0)[:, None] & cases.predicted
    ratio = residual(cases, found).values[axial]
    # Chi-square of 84 readings: 1 ± 0.15 standard deviation; here without bending, where the tangent is LIN's own.
    assert np.mean(ratio**2) == pytest.approx(1.0, abs=0.45)
    test = cases.campaign.tests[0]
    wrench = test.data.wrench.copy()
    wrench[-3:, 0] = -4.2e4
    pushed = replace(test, data=replace(test.data, wrench=wrench))
    beyond = load_cases(replace(cases.campaign, tests=(pushed,)))
    lost = predict_frame(beyond, lambda: predict_linear(beyond))
    # 36.5 kN is the lowest critical load of the held linkage.
    assert lost.lost.tolist() == [False] * 9 + [True] * 3
    assert lost.reasons == dict.fromkeys([9, 10, 11], Reason.UNSTABLE)


def test_a_test_zeroed_at_its_first_row_starts_at_zero() -> None:
    campaign = bench()
    first = tuple(replace(test, zero="first_row") for test in campaign.tests)
    cases = load_cases(replace(campaign, tests=first, gauges=(Gauge("mid", 0.5, "y"),)))
    found = predict_linear(cases)
    starts = found.values[cases.first[:-1]]
    assert np.all(starts[cases.predicted[cases.first[:-1]]] == 0.0)
