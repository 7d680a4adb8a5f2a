"""One bench under changed criteria: the same fits chosen anew are the fits made anew; the page says what changed."""

from __future__ import annotations

import pytest

from pipeline.assessment.challenge import cases
from pipeline.assessment.challenge.dirty import cases as dirty_cases
from pipeline.assessment.challenge.outcome import campaign_of, measured
from pipeline.assessment.sensitivity.__main__ import STUDY
from pipeline.assessment.sensitivity.page import page
from pipeline.assessment.sensitivity.trial import OF_TABLES, UNTOUCHED, Change, Trial, Verdict, varied
from pipeline.assessment.sensitivity.watched import watched
from pipeline.attempt import Attempts
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.searched import chosen
from tests.pipeline.assessment.challenge.small import first
from vjm.effects import catalogue

SMALL = first("single", "modulus_error", 0.02)


def small() -> FitCache:
    it, found, _ = measured(SMALL)
    names = ("modulus_error", "load_offset", "dimension_error", "bar_geometric_nonlinearity")
    known = {name: catalogue()[name] for name in names}
    return cached_fits(campaign_of(it, found, it.seed), Model(), known)


@pytest.mark.parametrize(
    "name",
    ["exclusion", *(pytest.param(it, marks=pytest.mark.long) for it in ("false_alarm", "far", "plausible"))],
)
def test_fits_that_are_kept_lead_to_the_answer_of_fits_made_anew(name: str) -> None:
    criteria = CRITERIA.times(name, 2.0)
    first_time = small()
    chosen(first_time, Attempts())
    begun = first_time.evaluations
    kept = first_time.under(criteria)
    again, anew = chosen(kept, Attempts()), small()
    anew.criteria = criteria
    fresh = chosen(anew, Attempts())
    assert (again.decision.verdict, again.decision.sets) == (fresh.decision.verdict, fresh.decision.sets)
    # Nothing is fitted twice, but where the criterion is one of the fits'.
    assert (kept.known is None) == (name == "plausible")
    assert first_time.evaluations == begun


def test_the_page_counts_what_a_change_gains_and_loses() -> None:
    right = Verdict(verdict="identified", sets=(("modulus_error",),), score="right")
    wrong = Verdict(verdict="identified", sets=(("load_offset",),), score="wrong")
    change = Change(criterion="exclusion", factor=0.5, answer=wrong)
    trials = [
        Trial(number=3, answer=right, changes=(change,), commit="abc", code="d"),
        Trial(number=13, answer=right, commit="abc", code="d"),
        Trial(number=23, answer=None, error="no state", commit="abc", code="d"),
    ]
    text = page(trials)
    assert "| exclusion | 5 chi-square | 1 | -1 | +1 | – |  |  |" in text
    assert "- clean case 3, right as modulus_error:\n  wrong as load_offset with exclusion ÷2" in text
    assert "2 clean benches, 0 dirty ones" in text
    assert all(f"**{each.name}**" in text for each in CRITERIA.of())


def test_every_criterion_of_an_answer_has_a_row_in_the_table_of_its_benches() -> None:
    text = page([])
    search, of_tables = text.index("## Asked in a search"), text.index("## Asked of tables")
    for each in CRITERIA.of():
        row = text.find(f"| {each.name} | ")
        assert (row < 0) == (each.group in UNTOUCHED), each.name
        assert row < 0 or ((row > of_tables) == (each.group in OF_TABLES) and row > search)
    assert {each.group for each in CRITERIA.of()} >= {*OF_TABLES, *UNTOUCHED}


def test_dirty_benches_are_in_a_table_of_their_own_with_what_is_said_of_the_table() -> None:
    sets = (("load_offset",),)
    answer = Verdict(
        verdict="unknown", sets=sets, score="certain", certain=("load_offset",), table=("noise of x_mm",)
    )
    missed = Verdict(verdict="unknown", sets=sets, score="undecided")
    change = Change(criterion="certain_sigmas", factor=2.0, answer=missed)
    text = page(
        [Trial(programme="dirty", number=3, answer=answer, changes=(change,), commit="abc", code="d")]
    )
    assert "| certain_sigmas | 10 sigma | – |  |  | 1 | -1 | 0 |" in text
    assert "- dirty case 3, certain as load_offset; certain load_offset; noise of x_mm:" in text
    assert "0 clean benches, 1 dirty ones" in text


def test_the_benches_are_of_every_kind() -> None:
    rounds = {"clean": cases.ROUND, "dirty": dirty_cases.ROUND}
    for programme, kinds in rounds.items():
        met = {kinds[number % len(kinds)] for name, number in STUDY.tasks(60) if name == programme}
        assert met == {*kinds}


def test_a_bench_asked_with_watched_criteria_answers_as_without() -> None:
    plain, seen = small(), small()
    seen.criteria, noted = watched(varied("clean"))
    one, other = (chosen(it, Attempts()).decision for it in (plain, seen))
    assert (one.verdict, one.sets) == (other.verdict, other.sets)
    assert 0 < len(noted) < 2 * len(varied("clean"))
