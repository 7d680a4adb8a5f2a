"""Errors by test and channel against numbers computed by hand on planted differences."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.compare.error import Discrepancy
from pipeline.inference.load_cases import INPUTS, LoadCases, load_cases
from pipeline.inference.predicted import Prediction, no_slides, no_stops
from tests.pipeline.bench import bench
from vjm.reasons import Reason

RNG = np.random.default_rng(8)


def planted(cases: LoadCases, difference: np.ndarray, inputs: float = 0.0) -> Prediction:
    """A prediction that falls short of the measurements by this much (R, C); `inputs`: its tangent everywhere."""
    rows, channels = cases.measured.shape
    return Prediction(
        np.nan_to_num(cases.measured) - difference,
        np.full((rows, channels, INPUTS), inputs),
        np.zeros((rows, channels, 0)),
        np.zeros((rows, INPUTS)),
        no_stops(rows),
        no_slides(rows),
        np.zeros(rows, dtype=bool),
        {},
        (),
    )


def noise(cases: LoadCases) -> np.ndarray:
    return RNG.normal(size=cases.measured.shape) * cases.sigma


def test_a_difference_of_two_sigmas_is_two_everywhere() -> None:
    cases = load_cases(bench())
    found = Discrepancy(cases, planted(cases, np.broadcast_to(2.0 * cases.sigma, cases.measured.shape)))
    assert found.rms(cases.fitted) == pytest.approx(2.0, rel=1e-9)
    for test in found.tests():
        assert test.rms == pytest.approx(2.0, rel=1e-9)
        assert all(c.sigmas == pytest.approx(2.0, rel=1e-9) for c in test.channels.values())
    channels = found.channels(cases.fitted)
    assert channels["mid"].rms == pytest.approx(2e-3, rel=1e-9) and channels["mid"].unit == "mm"
    assert channels["my"].rms == pytest.approx(100.0, rel=1e-9) and channels["my"].unit == "Nmm"
    # Held-out tests are apart.
    assert sum(c.readings for c in channels.values()) == cases.predicted[cases.fitted].sum()


def test_noise_of_the_inputs_stands_in_the_sigma_of_every_channel() -> None:
    """All inputs act on a channel with the same slope: variance sigma² + slope² x sum of theirs."""
    cases = load_cases(bench())
    found = Discrepancy(cases, planted(cases, np.zeros(cases.measured.shape), inputs=3.0))
    variance = cases.sigma**2 + 9.0 * np.sum(cases.input_sigma**2, axis=1, keepdims=True)
    assert np.allclose(found.sigma[cases.predicted], np.sqrt(variance)[cases.predicted], rtol=1e-9)


def test_noise_is_called_noise_and_half_as_much_again_is_not() -> None:
    """1785 residuals: the chance of such a chi-square by noise times 2.25 is nil; of noise it is uniform, seeded."""
    cases = load_cases(bench(steps=24))
    plain = Discrepancy(cases, planted(cases, noise(cases)))
    size, order = plain.size(), plain.order()
    assert size is not None and size.p_value > 0.01 and order is not None and order.p_value > 0.01
    large = Discrepancy(cases, planted(cases, 1.5 * noise(cases))).size()
    assert large is not None and large.p_value < 1e-12
    smooth = np.cumsum(noise(cases), axis=0) / 10.0
    along = Discrepancy(cases, planted(cases, smooth)).order()
    assert along is not None and along.p_value < 1e-12


def test_an_unknown_zero_is_no_misfit() -> None:
    """An offset of the x sensor in a test whose zeros are unknown, and the same in one whose are known."""
    campaign = bench()
    tests = tuple(replace(t, zero="fitted") if t.id == "axial_held_q+0" else t for t in campaign.tests)
    cases = load_cases(replace(campaign, tests=tests))
    offset = np.zeros(cases.measured.shape)
    offset[:, 0] = 0.5
    found = Discrepancy(cases, planted(cases, offset))
    by_name = {test.test: test for test in found.tests()}
    assert by_name["axial_held_q+0"].rms == pytest.approx(0.0, abs=1e-6)
    assert by_name["axial_held_q+30"].channels["x"].sigmas == pytest.approx(500.0, rel=1e-6)
    known = Discrepancy(load_cases(campaign), planted(load_cases(campaign), offset))
    # One zero a sensor that is read, those of the inputs included, which here do nothing.
    assert found.degrees == known.degrees - int(cases.predicted[0].sum())


def test_lost_rows_are_told_and_count() -> None:
    cases = load_cases(bench())
    plain = planted(cases, np.zeros(cases.measured.shape))
    lost = np.zeros(len(cases.test), dtype=bool)
    lost[9:12] = lost[14] = True
    reasons = dict.fromkeys([9, 10, 11], Reason.UNSTABLE) | {14: "stopped"}
    found = Discrepancy(cases, replace(plain, lost=lost, reasons=reasons))
    first, second = found.lost()
    assert (first.rows, first.of, first.step) == (3, 12, 9)
    assert first.sentence == "axial_held_q+0: no prediction from step 9 on: " + first.reason
    assert first.reason == Reason.UNSTABLE
    assert "in 1 of 12 rows, first step 2" in second.sentence and second.reason == "stopped"
    # A quarter of the readings at 30 sigma, the rest at zero.
    assert found.tests()[0].rms == pytest.approx(15.0, rel=1e-9)
    assert found.tests()[0].channels["x"].sigmas == pytest.approx(0.0, abs=1e-9)
