"""Where fits begin: what one start misses, several find, and none is made without need."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.stats import chi2, norm

from pipeline.assessment.coverage.trial import campaign
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import SENSORS, PlannedTest
from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import intervals, profile_likelihood
from pipeline.inference.levenberg_marquardt import levenberg_marquardt
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import _edge, _Ladder, _rungs, _valleys, best_fit
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual
from pipeline.inference.settings import LADDER, PROFILE
from pipeline.inference.solvers import ALL
from pipeline.simulate import bench_rig
from tests.pipeline.bench import bench
from vjm.effects import catalogue
from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars

EFFECTS = catalogue()
BENT = Model().with_effects([EFFECTS["bar_geometric_nonlinearity"]])
LOADS = (400.0, 2000.0, 4000.0, 1500.0, -300.0, -2000.0, -4000.0, -1000.0)


@cache
def cases(effect: str, value: float) -> LoadCases:
    return load_cases(bench(effect, value))


@cache
def pulled_and_pushed(play: float) -> LoadCases:
    """Along the bars at loads far from zero, where a reading of the load tells on which side of the play it is."""
    values = np.zeros((len(LOADS), 6))
    values[:, 0] = LOADS
    control = ("force", *["displacement"] * 5)
    plan = [PlannedTest(f"axial {q:g}", q, control, values, np.full(len(LOADS), 20.0)) for q in (0.0, 30.0)]
    return load_cases(measure("play", bench_rig(), plan, SENSORS, {"joint_clearance.play_mm": play}, 5))


def holds(model: Model, tests: LoadCases, new: tuple[str, ...], name: str, value: float) -> None:
    """The 99.99 % interval holds the truth: one in 10000 benches of noise would not."""
    best = best_fit(model.with_effects([EFFECTS[e] for e in new]), tests, new)
    free = [each.name for each in best.model.free]
    k = free.index(name)
    assert abs(best.model.values[k] - value) < 4.0 * best.std[k]
    it = intervals(profile_likelihood(best, tests))[k]
    assert it.low is not None and it.high is not None and it.low < best.model.values[k] < it.high
    # Far from kinks and bounds half an interval is 1.96 standard errors; these by differences of solved predictions.
    half = norm.ppf(0.975) * std_by_differences(best, tests)[k]
    assert it.high - it.low == pytest.approx(2.0 * half, rel=PROFILE.nearly)


def std_by_differences(best: Fit, tests: LoadCases) -> np.ndarray:
    """(P,) standard errors from central differences of the residuals, the inputs as the best fit has them."""
    near = best.prediction
    columns = []
    for k, each in enumerate(best.model.free):
        step = np.zeros(len(best.model.free))
        step[k] = 1e-3 * abs(each.parameter.typical)
        sides = []
        for sign in (1.0, -1.0):
            model = best.model.at(best.model.values + sign * step)
            there = predict(model, tests, slopes=False, start=near, shift=near.shift)
            sides.append(Fit(model, there, residual(tests, there), 1).whitened)
        columns.append((sides[0] - sides[1]) / (2.0 * step[k]))
    slopes = np.stack(columns, axis=1)
    return np.asarray(np.sqrt(np.diag(np.linalg.inv(slopes.T @ slopes))))


@pytest.mark.long
@pytest.mark.parametrize("play", [0.003, 0.03, 0.3])
def test_play_of_any_size_is_found_beside_a_number_that_is_smooth(play: float) -> None:
    """From a tenth of the typical size to thirty times, beyond the end of the ladder's first rungs."""
    new = ("joint_clearance", "modulus_error")
    holds(Model(), pulled_and_pushed(play), new, "joint_clearance.play_mm", play)


def test_a_play_that_no_size_helps_is_absent() -> None:
    """Of bars that are stiffer than their model: a play makes it softer still."""
    values = np.zeros((len(LOADS), 6))
    values[:, 0] = LOADS
    control = ("force", *["displacement"] * 5)
    plan = [PlannedTest("axial", 0.0, control, values, np.full(len(LOADS), 20.0))]
    hidden = {"modulus_error.scale": 1.05}
    stiff = load_cases(measure("stiff", bench_rig(), plan, SENSORS, hidden, 5))
    model = Model().with_effects([EFFECTS["joint_clearance"]])
    best, bare = best_fit(model, stiff, ("joint_clearance",)), fit(Model(), stiff)
    assert best.model.names == ("joint_clearance",) and not best.model.free
    assert best.chi_square == bare.chi_square
    assert best.model.terms[0].values == {"play_mm": 0.0}


def ladder(*valley: float) -> _Ladder:
    """Of the play; heights are those of a valley at a play, mm, in logarithms, 1 everywhere else."""
    model = Model().with_effects([EFFECTS["joint_clearance"]])

    def height(at: Mapping[str, float]) -> float:
        (play,) = at.values()
        return min((abs(np.log(play / each)) for each in valley), default=1.0)

    it = _Ladder(list(model.free), height)
    it.climb()
    return it


def test_below_the_first_rung_a_size_is_looked_for_that_helps() -> None:
    it = ladder(1e-4)
    count = len(it.heights)
    it.dig(ground=0.5)
    assert min(it.heights) < 0.5 and it.places == sorted(it.places, key=lambda at: list(at.values()))
    # The valley is two rungs below; nothing more is looked at once a rung leaves less than the model without.
    assert len(it.heights) == count + 2


def test_below_the_first_rung_nothing_is_looked_for_where_another_is_best_or_helps() -> None:
    for it in (ladder(0.03), ladder(1e-3)):
        count = len(it.heights)
        it.dig(ground=0.5)
        assert len(it.heights) == count


def test_the_ladder_goes_on_while_that_helps_and_keeps_valleys_only() -> None:
    heights: list[float] = []
    for size in _rungs(heights):
        heights.append(abs(np.log(size / 100.0)))
    # 100 is the seventh rung; the eighth is worse and ends it.
    assert len(heights) == len(LADDER.sizes) + 3


def test_valleys_are_rungs_that_are_lower_than_those_beside_them() -> None:
    assert _valleys([60.0, 50.0, 70.0, 40.0, 90.0], 100) == [3, 1]
    assert _valleys([50.0, 50.0, 60.0], 100) == [1]
    # Four times noise: a rise by less than one square of the mean is none.
    assert _valleys([400.0, 403.0, 401.0, 500.0], 100) == [0]
    assert _valleys([400.0, 405.5, 401.0, 500.0], 100) == [0, 2]
    assert _valleys([100.0, 103.0, 101.0, 120.0], 100) == [0, 2]


def test_the_foot_of_a_ladder_is_no_valley_where_another_is_much_lower() -> None:
    assert _valleys([LADDER.foot * 50.0, 90.0, 50.0, 90.0], 100) == [2, 0]
    assert _valleys([LADDER.foot * 50.0 + 1.0, 90.0, 50.0, 90.0], 100) == [2]
    assert _valleys([50.0, 90.0, LADDER.foot * 50.0 + 1.0, 90.0], 100) == [0, 2], (
        "what is not the foot may be"
    )


@cache
def yielding(strain: float) -> LoadCases:
    return load_cases(campaign((("material_yield.strain", strain),), 3, 8))


@pytest.mark.long
@pytest.mark.parametrize("strain", [0.00215, 0.0026])
def test_a_strain_of_yielding_between_two_sizes_of_the_ladder_is_found(strain: float) -> None:
    """At the larger of the two nothing yields, at the smaller one so much that the plain model fits better."""
    best = best_fit(BENT.with_effects([EFFECTS["material_yield"]]), yielding(strain), ("material_yield",))
    assert chi2.sf(best.chi_square, best.degrees) > 1e-3
    assert best.std[0] < 0.02 * strain, "the yielding shows"
    assert abs(best.model.values[0] - strain) < 4.0 * best.std[0]


@pytest.mark.long
def test_no_step_of_a_fit_goes_most_of_the_way_to_where_an_effect_is_strongest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    model, tried = BENT.with_effects([EFFECTS["material_yield"]]), [0.0026]
    evaluated = Objective.at

    def seen(aim: Objective, values: np.ndarray, *how: Any, **more: Any) -> Evaluation:
        tried.append(float(values[0]))
        return evaluated(aim, values, *how, **more)

    monkeypatch.setattr(Objective, "at", seen)
    aim = Objective(model.at(np.array(tried)), yielding(0.00215).by_role[0][1])
    end = levenberg_marquardt(aim.at(aim.model.bounded), None, np.inf, ALL)
    assert end.there.values[0] == pytest.approx(0.00215, rel=0.01)
    low = model.free[0].bounds[0]
    assert all(value >= low + 0.499 * (before - low) for before, value in pairwise(tried))
    assert min(tried) < low + 0.501 * (max(tried) - low), "the first step would have gone farther"


def test_the_edge_of_a_ladder_is_looked_at_only_where_an_effect_does_not_show_before_it() -> None:
    assert _edge([10.0, 10.0, 10.0, 90.0]) == 3
    assert _edge([10.0, 10.0, 7.0, 90.0]) == 0
    assert _edge([10.0, 15.0, 90.0]) == 0
    assert _edge([10.0, 10.0, 10.0]) == 0


def test_a_smooth_effect_that_is_there_is_fitted_once() -> None:
    tests = cases("modulus_error.scale", 0.95)
    model = BENT.with_effects([EFFECTS["modulus_error"]])
    assert best_fit(model, tests, ("modulus_error",)).evaluations == fit(model, tests).evaluations
    holds(BENT, tests, ("modulus_error",), "modulus_error.scale", 0.95)


class Late(Effect):
    """Stiffens from a tenth on: null is flat, and nothing there says so."""

    name = title = equation = signature = limits = source = "late"
    parameters = (Parameter("more", "1", 0.0, 0.2, -1.0, 1.0, "excess of the stiffness, and a tenth"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        scale = 1.0 + max(abs(values["more"]) - 0.1, 0.0)
        return for_bars(rig, lambda link: link.stiffened(scale))


def test_an_effect_without_a_slope_at_null_is_found_from_its_typical_size() -> None:
    tests = cases("modulus_error.scale", 1.09)
    model = BENT.with_effects([Late()])
    alone, best = fit(model, tests), best_fit(model, tests, ("late",))
    assert abs(alone.model.values[0]) < 0.1 and not best.prediction.lost.any()
    assert best.chi_square < alone.chi_square - 100.0 and best.evaluations > alone.evaluations
    assert abs(best.model.values[0] - 0.19) < 4.0 * best.std[0]
