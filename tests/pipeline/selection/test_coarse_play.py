"""A play read with sensors as coarse as it is large, under loads that hardly press its stops."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from pipeline.assessment.coverage.cases import BASE
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, bench_plan
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.selection.adequacy.patterns import scores
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import diagnose
from pipeline.simulate import bench_rig, scaled
from tests.pipeline.selection.bench import COARSE
from vjm.effects import catalogue

PLAY = 0.1


@cache
def cases(steps: int, seed: int) -> LoadCases:
    plan = scaled(bench_plan(steps), bench_rig(), 0.02)
    hidden = {"joint_clearance.play_mm": PLAY}
    return load_cases(measure("coarse", bench_rig(), plan, COARSE, hidden, seed, GAUGES))


@cache
def fitted(steps: int, seed: int) -> Fit:
    known = [catalogue()[name] for name in (BASE, "joint_clearance")]
    return fit(Model().with_effects(known).at(np.array([PLAY])), cases(steps, seed))


@pytest.mark.parametrize("seed", [pytest.param(it, marks=pytest.mark.long) for it in (1, 2)])
def test_readings_by_which_rows_chose_their_sides_are_no_pattern(seed: int) -> None:
    assert abs(scores(fitted(10, seed), CRITERIA)[0].score) < 4.0


@pytest.mark.long
@pytest.mark.parametrize("effect", ["bar_stiffness_asymmetry", "modulus_error"])
def test_one_effect_more_never_ends_worse(effect: str) -> None:
    """At the same numbers rows on other sides leave a few units more or less: a fit could climb by them."""
    tests, less = cases(10, 1), fitted(10, 1)
    model = less.model.with_effects([catalogue()[effect]])
    more = best_fit(model, tests, [effect], less.prediction)
    assert more.chi_square < less.chi_square + 1e-3
    assert more.evaluations < 20


@pytest.mark.long
def test_a_play_beside_bars_that_bend_too_little_to_be_seen() -> None:
    """Loads of a fiftieth show no geometric stiffness, and gauges between the ends of a lumped bar read its bent axis
    without it: nothing but the play is named."""
    found = diagnose(cases(24, 5).campaign, Model(), catalogue())
    assert found.verdict == "identified"
    assert set(found.sets[0]) == {"joint_clearance"}
    assert abs(found.fit.model.values[0] - PLAY) < 3.0 * found.fit.std[0]
