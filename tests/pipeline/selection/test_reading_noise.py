"""A diagnosis of readings that are not what was declared ends as it would without."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.campaign.names import channel_columns
from pipeline.inference.driving import driving
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.bad_readings import BadReading, set_aside
from pipeline.selection.diagnosis import cached_fits, diagnose
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.noise_rounds import settled
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

IDS = ("axial_held_q+0", "swing_q+0", "swing_q+30", "lateral_q+0")
HIDDEN = ("modulus_error.scale", 0.97)


@cache
def plain() -> Campaign:
    return bench(*HIDDEN, IDS)


@cache
def plain_answer() -> Answer:
    return answer(plain())


def answer(it: Campaign) -> Answer:
    known = {n: catalogue()[n] for n in ("bar_geometric_nonlinearity", "modulus_error", "axis_flexibility")}
    return answered(diagnose(it, Model(), known))


def knocked(it: Campaign, number: int = 0) -> Campaign:
    test = it.tests[number]
    wrench = test.data.wrench.copy()
    wrench[3, 5] += 40.0 * it.noise.wrench[5]
    tests = list(it.tests)
    tests[number] = replace(test, data=replace(test.data, wrench=wrench))
    return replace(it, tests=tuple(tests))


def test_nothing_is_said_of_readings_as_declared() -> None:
    it = plain_answer()
    assert it.verdict == "identified" and "modulus_error" in it.added
    assert not it.set_aside and not it.noise and it.as_declared is None


def test_a_knocked_reading_is_set_aside_and_told() -> None:
    it, before = answer(knocked(plain())), plain_answer()
    (bad,) = it.set_aside
    assert (bad.test, bad.step, bad.column) == (IDS[0], 3, "mz_Nmm")
    assert (it.verdict, it.added) == (before.verdict, before.added)
    assert it.as_declared == "unknown"
    said = " ".join(it.sentences)
    assert "Set aside" in said and "mz_Nmm at step 3" in said and "the verdict would be unknown" in said


@pytest.mark.long
def test_a_sigma_that_is_wrong_by_two_does_not_decide() -> None:
    it = plain()
    wrench = it.noise.wrench.copy()
    wrench[3:] *= 0.5
    found = answer(replace(it, noise=replace(it.noise, wrench=wrench)))
    assert (found.verdict, found.added) == ("identified", plain_answer().added)
    columns = {each.column for each in found.noise}
    assert columns and columns <= {"mx_Nmm", "my_Nmm", "mz_Nmm"}
    for each in found.noise:
        assert abs(np.log(each.found / each.declared / 2.0)) < 4.0 * (each.relative_error or 0.0)
    assert any("scatters by" in said for said in found.sentences)


def test_sigmas_that_are_all_somewhat_too_small_are_told_as_what_they_may_be() -> None:
    """By a quarter: too little to count the scatter in their place, and more than noise leaves."""
    it = bench(ids=IDS, seed=3)
    found = answer(replace(it, noise=it.noise.times(np.full(12 + len(it.gauges), 0.8))))
    assert found.verdict == "unknown" and not found.noise
    (said,) = [said for said in found.sentences if "would explain it" in said]
    assert (
        f"sigmas that are {100.0 * (found.error[-1].fit - 1.0):.0f} % larger" in said
        and "Repeat one step" in said
    )
    assert not any("would explain it. Repeat" in said for said in plain_answer().sentences)


def test_a_search_without_a_reading_begins_where_the_one_with_it_ended() -> None:
    """A controlled reading at that, in whose row nothing is compared any more."""
    it, base, nothing = plain(), frozenset({"bar_geometric_nonlinearity"}), Model()
    wanted = [base, base | {"modulus_error"}]
    known = {name: catalogue()[name] for name in ("bar_geometric_nonlinearity", "modulus_error")}
    before = cached_fits(it, nothing, known)
    for names in wanted:
        before.fit(names)
    test = it.tests[1]
    (column, *_) = driving(test, it.gauges)
    bad = BadReading(test.id, int(test.data.steps[4]), channel_columns(it.gauges)[column], 20.0)
    cases = load_cases(set_aside(before.whole.campaign, (bad,)))
    assert len(cases.test) == len(before.whole.test)
    row = int(before.whole.first[1]) + 4
    assert before.whole.predicted[row].any() and not cases.predicted[row].any()
    near = before.whole.measured[row - 1 : row + 2 : 2, column]
    assert cases.measured[row, column] == pytest.approx(near.mean(), rel=1e-12)
    here, anew = (FitCache(cases, nothing, known, str, before=given) for given in (before, None))
    for names in wanted:
        assert here.fit(names).chi_square <= anew.fit(names).chi_square + 0.2
    assert here.evaluations < anew.evaluations


@pytest.mark.long
def test_a_reading_of_a_test_that_was_held_out_may_be_knocked_too() -> None:
    it = plain()
    held = replace(it, tests=(*it.tests[:-1], replace(it.tests[-1], role="holdout")))
    found = answer(knocked(held, len(it.tests) - 1))
    assert [(b.test, b.step, b.column) for b in found.set_aside] == [(it.tests[-1].id, 3, "mz_Nmm")]
    assert found.verdict == "identified" and "modulus_error" in found.added


@pytest.mark.long
def test_knocked_readings_are_set_aside_before_all_that_competes_is_fitted() -> None:
    known = {n: catalogue()[n] for n in ("bar_geometric_nonlinearity", "modulus_error", "axis_flexibility")}
    fits = cached_fits(knocked(plain()), Model(), known)

    def again(campaign: Campaign, before: FitCache) -> FitCache:
        return FitCache(load_cases(campaign), Model(), known, str, before=before)

    it = settled(fits, again, Attempts())
    assert [b.cell for b in it.readings.bad] == [(IDS[0], 3, "mz_Nmm")] and it.with_all == "unknown"
    assert all(len(names) <= 2 for names in fits.fits), "no pairs beside what is there or not"
    assert it.it.decision.sets == (frozenset({"bar_geometric_nonlinearity", "modulus_error"}),)
