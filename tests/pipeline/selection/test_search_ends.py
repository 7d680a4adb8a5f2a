"""A search that has taken too long ends with what it found, says so, and names nothing."""

from dataclasses import replace

import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.assessment.coverage.trial import campaign
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.inference.model import Model
from pipeline.selection import diagnosis
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis, diagnose
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.verdict import ENDED, UNSURE_OF_TABLE
from tests.pipeline.selection.test_reading_noise import knocked, plain
from vjm.effects import catalogue
from vjm.work import TooMuch

TESTS = campaign((("modulus_error.scale", 0.95),), 3, 8)


def found(most: float) -> Diagnosis:
    return diagnose(TESTS, Model(), catalogue(), criteria=replace(CRITERIA, search_work=most))


@pytest.mark.long
def test_what_was_not_compared_with_all_is_not_named(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = found(CRITERIA.search_work)
    # Its table is right: the look for mistakes, which takes of the same work, is not what ends.
    monkeypatch.setattr(diagnosis, "suspicions", lambda _: ())
    assert whole.verdict == "identified" and not whole.found.ended
    for most in (0.0, 50.0):
        it = found(most)
        assert it.found.ended
        assert it.verdict == "unknown" and len(it.cache.fits) <= len(whole.cache.fits)
        said = " ".join(answered(it).sentences)
        assert "The search ended" in said or "the search ended" in said


KNOWN = {n: catalogue()[n] for n in ("bar_geometric_nonlinearity", "modulus_error", "axis_flexibility")}


def test_nothing_is_named_where_the_table_was_not_looked_at_to_the_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def too_long(_: FitCache) -> None:
        raise TooMuch("it would take too long")

    assert diagnose(plain(), Model(), KNOWN).verdict == "identified"
    monkeypatch.setattr(diagnosis, "suspicions", too_long)
    # A knocked reading beside it is left as it is, and the reason is still there.
    for table in (plain(), knocked(plain())):
        it = answered(with_laws(diagnose(table, Model(), KNOWN)))
        assert not it.laws
        assert it.verdict == "unknown" and it.added and not it.certain
        assert UNSURE_OF_TABLE in it.sentences[0]
        assert any(
            "the look for mistakes of the table could not be worked out" in said for said in it.not_done
        )


def test_single_effects_that_explain_a_table_which_was_not_looked_at_are_no_alternatives() -> None:
    """One of them would be said to be right, and the table may be wrong."""
    here = diagnose(plain(), Model(), KNOWN)
    first = here.decision.sets[0]
    two = replace(here.decision, verdict="ambiguous", sets=(first, frozenset({"axis_flexibility"})))
    it = two.of_one(UNSURE_OF_TABLE)
    assert (it.verdict, it.sets, it.because) == ("unknown", (first,), UNSURE_OF_TABLE)
    left = replace(here.decision, verdict="unknown").of_one(UNSURE_OF_TABLE)
    assert not left.because and left.unlooked == UNSURE_OF_TABLE


def test_no_second_search_is_begun_once_the_work_of_one_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    known = {**KNOWN, "bar_initial_bow": catalogue()["bar_initial_bow"]}
    monkeypatch.setattr(FitCache, "worn_out", True)
    # As declared the knocked reading leaves what nothing explains; that is said, and no name is given.
    it = answered(diagnose(knocked(plain()), Model(), known))
    assert it.verdict == "unknown" and not it.set_aside
    right = diagnose(plain(), Model(), known)
    assert right.verdict == "identified" and ENDED not in right.decision.because
