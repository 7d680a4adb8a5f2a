"""What is asked: rows between and beyond the fitted ones, read without noise, and judged with one tangent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.extrapolation.bench import between, beyond
from pipeline.assessment.extrapolation.correction import corrected
from pipeline.assessment.extrapolation.yardstick import true_model, yardstick
from pipeline.assessment.virtual.plan import bench_plan
from pipeline.discrepancy.regressors import regressors
from pipeline.inference.driving import driving
from pipeline.inference.load_cases import LOST, load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from tests.pipeline.assessment.extrapolation.stiff import STEPS, stiff
from vjm.effects import catalogue


def test_between_keeps_the_way_and_beyond_its_shape() -> None:
    test = bench_plan(8)[0]
    near, far = between(test), beyond(test)
    np.testing.assert_array_equal(near.values[::2], test.values)
    np.testing.assert_array_equal(near.temperature[::2], test.temperature)
    np.testing.assert_allclose(near.values[1::2], 0.5 * (test.values[1:] + test.values[:-1]))
    np.testing.assert_array_equal(far.values, 1.5 * test.values)
    np.testing.assert_array_equal(far.temperature, test.temperature)


def test_rows_inside_are_new_and_rows_outside_lie_beyond_the_fitted_range() -> None:
    it = stiff()
    tests, gauges = it.asked.campaign.tests, it.asked.campaign.gauges
    count = len(it.campaign.tests)
    assert it.inside.sum() == count * (STEPS - 1) and not (it.inside & it.outside).any()
    for k, fitted in enumerate(it.campaign.tests):
        _, done = driving(fitted, gauges)
        _, asked = driving(tests[count + k], gauges)
        out = it.outside[it.asked.test == count + k]
        assert 0 < out.sum() < out.size
        # The fitted loads were read with noise of at most a thousandth.
        assert np.abs(asked[out]).min() > 1.005 * np.abs(done).max()
        assert np.abs(asked[~out]).max() < 1.01 * np.abs(done).max()


def test_what_is_asked_has_no_noise_and_what_is_fitted_has() -> None:
    """The true virtual springs meet the exact bench to a twentieth of a sigma, the fitted readings to their noise."""
    it = stiff()
    best = true_model(it.case)
    error = yardstick(it).error(predict(best, it.asked, slopes=False))
    assert error.inside < 0.05 and error.outside < 0.1 and error.lost == 0
    noisy = load_cases(it.campaign)
    exact = it.asked.measured[it.asked.test < len(it.campaign.tests)]
    steps = np.concatenate(
        [np.arange(STEPS) * 2 + k * (2 * STEPS - 1) for k in range(len(it.campaign.tests))]
    )
    off = (noisy.measured - exact[steps]) / noisy.sigma
    # 24 steps of 13 sensors: the spread of a spread is 4 %.
    assert 0.85 < off.std() < 1.15


def test_a_lost_row_counts_as_such() -> None:
    it = stiff()
    yard = yardstick(it)
    gone = replace(yard.truth, lost=it.outside.copy())
    error = yard.error(gone)
    assert error.lost == it.outside.sum() and error.outside == pytest.approx(LOST)
    assert error.inside == pytest.approx(yard.error(yard.truth).inside)


def test_errors_are_in_units_of_noise_whatever_the_approach_believes() -> None:
    """The same error in units weighs the same beside any tangent."""
    it = stiff()
    yard = yardstick(it)
    soft = replace(yard.truth, by_inputs=3.0 * yard.truth.by_inputs)
    assert yard.error(soft) == yard.error(yard.truth)


def test_regressors_say_what_was_prescribed() -> None:
    it = stiff()
    table, noise = regressors(it.asked)
    assert table.shape == (len(it.asked.test), 21) and noise.shape == (21,)
    rows = it.asked.test == 0
    first = it.asked.campaign.tests[0]
    np.testing.assert_array_equal(table[rows, 7], first.data.wrench[:, 0])
    assert first.control[0] == "force" and np.all(table[rows, 15] == 1.0) and np.all(table[rows, 1] == 0.0)
    assert set(np.unique(table[:, 14])) <= {-1.0, 0.0, 1.0}


def test_a_correction_adds_what_was_learned_in_the_units_of_each_channel() -> None:
    """Learned with hindsight, the residual of the exact readings themselves: nothing is left of it."""
    it = stiff()
    model = Model().with_effects([catalogue()[ALWAYS]])
    there = predict(model, it.asked, slopes=False)
    whole = corrected(lambda own: lambda _: own.values, it.asked, there, it.asked, there)
    yard = yardstick(it)
    assert yard.error(there).outside > 3.0
    # Weighed with the tangent of the true model, 3 % stiffer: only rounding is left.
    assert yard.error(whole).outside < 1e-6
