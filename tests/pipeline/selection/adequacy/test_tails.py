"""Long tails are told from the normal law and from single bad readings; normal scores say as much as the likelihood."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.stats import kstest, t

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.tails import Tails, _beyond, tails_of, without_tails
from pipeline.selection.criteria import CRITERIA
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import MIXED, bench
from vjm.effects import catalogue


@cache
def exact() -> Campaign:
    """The bench with a hundredth of a thousandth of its noise."""
    few = replace(
        SENSORS,
        displacement=1e-5 * SENSORS.displacement,
        wrench=1e-5 * SENSORS.wrench,
        gauges=1e-5 * SENSORS.gauges,
    )
    plan = [test for test in bench_plan(12) if test.id in MIXED]
    return replace(measure("exact", bench_rig(), plan, few, {}, 1, GAUGES), noise=bench().noise)


def noisy(degrees: float, seed: int) -> Campaign:
    """With noise of Student's law, of the declared sigma as scale."""
    it, generator = exact(), np.random.default_rng(seed)

    def more(values: np.ndarray, sigma: np.ndarray) -> np.ndarray:
        return np.asarray(values + sigma * generator.standard_t(degrees, size=values.shape))

    tests = []
    for test in it.tests:
        data, noise = test.data, it.noise
        data = replace(
            data,
            displacement=more(data.displacement, noise.displacement),
            wrench=more(data.wrench, noise.wrench),
            gauges=more(data.gauges, noise.gauges),
        )
        tests.append(replace(test, data=data))
    return replace(it, tests=tuple(tests))


def of(it: Campaign) -> Fit:
    return unfitted(Model().with_effects([catalogue()["bar_geometric_nonlinearity"]]), load_cases(it))


@pytest.mark.long
def test_students_noise_is_found_in_most_campaigns_and_normal_noise_never_taken_for_it() -> None:
    """Of 336 readings a third of campaigns may look as if single readings were bad: then nothing is said."""
    found = [it for seed in range(1, 13) if (it := tails_of(of(noisy(3.0, seed)), CRITERIA)) is not None]
    assert len(found) >= 8
    assert all(2.0 < it.degrees < 7.0 for it in found)
    assert not [seed for seed in range(1, 9) if tails_of(of(bench(seed=seed)), CRITERIA) is not None]


def test_single_bad_readings_are_no_tails() -> None:
    it = bench()
    wrench = it.tests[0].data.wrench.copy()
    for row, channel, size in ((2, 4, 40.0), (4, 2, -25.0), (6, 1, 60.0), (8, 5, 30.0)):
        wrench[row, channel] += size * it.noise.wrench[channel]
    test = replace(it.tests[0], data=replace(it.tests[0].data, wrench=wrench))
    assert tails_of(of(replace(it, tests=(test, *it.tests[1:]))), CRITERIA) is None


@pytest.mark.parametrize("seed", [1, 2])
def test_few_readings_of_which_some_are_bad_are_no_tails(seed: int) -> None:
    """Three bad ones of thirty to sixty: without the largest alone they would pass for long tails in a quarter."""
    generator = np.random.default_rng(seed)
    for count in (30, 60):
        passed = 0
        for _ in range(20):
            residual = generator.normal(size=count)
            residual[:3] = generator.uniform(4.0, 15.0, 3) * generator.choice((-1.0, 1.0), 3)
            passed += _beyond(residual) >= 0.0
        assert passed <= 1


@pytest.mark.parametrize("seed", [1, 2])
def test_sigmas_of_several_sizes_are_no_tails(seed: int) -> None:
    """Normal noise of which the load cell's is declared four times too large: the whole is no normal law either."""
    it = noisy(1e9, seed)
    wrong = replace(it, noise=replace(it.noise, wrench=4.0 * it.noise.wrench))
    assert tails_of(of(wrong), CRITERIA) is None


@pytest.mark.parametrize("degrees", [1.5, 3.0, 10.0, 100.0])
def test_scores_are_normal_and_follow_small_shifts_by_the_effective_sigma(degrees: float) -> None:
    """By draws: a shift of a reading moves the mean of its pseudo-value by as much."""
    law, generator = Tails(degrees, 0.7, 0.0), np.random.default_rng(7)
    draws = 0.7 * generator.standard_t(degrees, size=400_000)
    scores = law.scores(draws)
    assert kstest(scores[:20_000], "norm").pvalue > 0.01
    moved = law.scores(draws + 0.05)
    assert law.effective * np.mean(moved - scores) == pytest.approx(0.05, rel=0.02)
    # No less than the least that Fisher's information allows, and near it.
    best = 0.7 * np.sqrt((degrees + 3.0) / (degrees + 1.0))
    assert best <= law.effective < 1.35 * best


def test_scores_are_odd_and_rise_and_stay_finite() -> None:
    law = Tails(3.0, 1.0, 0.0)
    far = np.array([1e-9, 0.3, 5.0, 50.0, 1e6])
    assert np.all(np.diff(law.scores(far)) >= 0.0)
    assert np.allclose(law.scores(-far), -law.scores(far), rtol=1e-12, atol=0.0)
    assert law.scores(np.array([t.ppf(0.975, 3.0)]))[0] == pytest.approx(1.959964, rel=1e-6)


def test_a_campaign_without_tails_leaves_normal_noise() -> None:
    it = of(noisy(3.0, 2))
    law = tails_of(it, CRITERIA)
    assert law is not None
    again = of(without_tails(it, law))
    assert again.rms == pytest.approx(1.0, abs=0.12)
    assert np.abs(again.whitened).max() < 4.5 < np.abs(it.whitened).max()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("zeros", [0, 30, 38])
@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_readings_that_stand_still_leave_no_law_without_a_scale(zeros: int, size: float) -> None:
    """A display that shows the same as the model leaves zeros; the scale of the rest is one of theirs."""
    residual = np.random.default_rng(3).normal(size=40)
    residual[:zeros] = 0.0
    assert _beyond(size * residual) == pytest.approx(_beyond(residual), abs=1e-3)
