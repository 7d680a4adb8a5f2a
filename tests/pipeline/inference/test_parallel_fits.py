"""Fits, intervals and a whole diagnosis are the same on one processor and on two."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answer_of
from pipeline.answer.record import Answer
from pipeline.assessment.coverage.cases import BASE, typical
from pipeline.assessment.coverage.trial import campaign
from pipeline.inference import parallel_fits as sent
from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import intervals, profile_likelihood
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.inference.objective import Objective
from pipeline.inference.parallel_fits import fits_at_once
from pipeline.processors import may_use
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.inference import manipulators
from vjm import work
from vjm.effects import catalogue

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forks are made on Linux alone")
HIDDEN = typical(["joint_friction"])
CASES = load_cases(campaign(tuple(HIDDEN.items()), 2, 8))
ROUGH = Model().with_effects([catalogue()[name] for name in (BASE, "joint_friction")])


@pytest.fixture
def two() -> Iterator[None]:
    may_use(2)
    yield
    may_use(1)


def begun() -> list[Model]:
    return [ROUGH.at(np.array([torque, 2e-3])) for torque in (200.0, 600.0, 1200.0)]


def fits() -> list[Fit]:
    return fits_at_once([(it, partial(fit, it, CASES)) for it in begun()], CASES)


@pytest.mark.long
def test_a_fit_comes_back_as_it_was_made(two: None) -> None:
    begin = work.spent()
    alone = [fit(it, CASES) for it in begun()]
    taken = work.spent() - begin
    both = fits()
    assert work.spent() - begin == pytest.approx(2.0 * taken, rel=1e-12) and taken > 0.0
    for here, other in zip(alone, both, strict=True):
        assert other.chi_square == here.chi_square and other.evaluations == here.evaluations
        assert other.model.names == here.model.names and not other.prediction.lost.any()
        np.testing.assert_array_equal(other.model.values, here.model.values)
        np.testing.assert_array_equal(other.jacobian, here.jacobian)
        # Fits that follow go on from its states, with what its laws remember.
        again, same = (Objective(it.model, CASES).at(it.model.values, it.prediction) for it in (other, here))
        np.testing.assert_array_equal(again.prediction.values, same.prediction.values)
        np.testing.assert_array_equal(again.residual.values, same.residual.values)


@pytest.mark.long
def test_that_the_work_ran_out_is_sent_and_the_fit_not_begun_again(
    two: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert not any(each.ended for each in fits())
    monkeypatch.setattr("pipeline.inference.fit.WORK", 0.0)
    assert all(each.ended for each in fits())
    # At its bound it would be looked for a second time.
    model = Model().with_effects([catalogue()[name] for name in (BASE, "joint_torsional_stiffness")])
    alone, best = fit(model, CASES), best_fit(model, CASES, ["joint_torsional_stiffness"])
    assert best.ended and best.evaluations == alone.evaluations


@pytest.mark.long
def test_a_fit_of_a_whole_manipulator_comes_back_as_well(two: None) -> None:
    whole = load_cases(manipulators.campaign())
    soft = Model().with_effects([catalogue()["modulus_error"]])
    begun = [soft.at(np.array([scale])) for scale in (1.0, 0.9)]
    found = fits_at_once([(it, partial(fit, it, whole)) for it in begun], whole)
    for it, other in zip(begun, found, strict=True):
        here = fit(it, whole)
        assert other.chi_square == here.chi_square
        np.testing.assert_array_equal(other.model.values, here.model.values)
        for mine, its in zip(here.prediction.states, other.prediction.states, strict=True):
            np.testing.assert_array_equal(its.unknowns, mine.unknowns)


def test_laws_are_not_sent(two: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """One of a user's own may be made of what no other process knows; then all would be fitted here again."""
    made = []
    numbers = sent._numbers

    def counted(call: partial[Fit]) -> object:
        made.append(call)
        return numbers(call)

    monkeypatch.setattr(sent, "_numbers", counted)
    assert len(fits()) == 3 > len(made)


@pytest.mark.long
def test_intervals_are_those_of_one_processor(two: None) -> None:
    best = fits()[0]
    both = profile_likelihood(best, CASES)
    found = intervals(both)
    may_use(1)
    alone = profile_likelihood(best, CASES)
    assert intervals(alone) == found and alone.evaluations == both.evaluations > 0


@pytest.mark.long
def test_a_diagnosis_is_that_of_one_processor(two: None) -> None:
    tests = campaign((("modulus_error.scale", 0.95),), 3, 8)

    def answer() -> Answer:
        return answer_of(diagnose(tests, Model(), catalogue())).model_copy(update={"seconds": 0.0})

    both = answer()
    may_use(1)
    assert answer() == both and both.verdict == "identified"
