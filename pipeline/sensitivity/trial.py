"""One bench, diagnosed under the criteria as they are and under each changed alone."""

from __future__ import annotations

from pipeline.attempt import Attempts
from pipeline.challenge.cases import ALWAYS, Case
from pipeline.challenge.outcome import Score, campaign_of, judged, measured
from pipeline.diagnose.chosen import chosen
from pipeline.diagnose.diagnosis import fit_cache
from pipeline.diagnose.shelf import Shelf
from pipeline.inference.model import Model
from pipeline.record import Record
from pipeline.selection.criteria import CRITERIA
from vjm.effects import catalogue

FACTORS = (0.5, 2.0)
UNTOUCHED = "plan"
"""Group of the criteria that no verdict depends on."""


class Verdict(Record):
    """An answer. sets: without what every bench has, each sorted."""

    verdict: str
    sets: tuple[tuple[str, ...], ...]
    score: Score


class Change(Record):
    """An answer that is not the one of the criteria as they are."""

    criterion: str
    factor: float
    answer: Verdict


class Trial(Record):
    """A case of the challenge: its answer, and every other one that a changed criterion leads to."""

    number: int
    answer: Verdict | None
    changes: tuple[Change, ...] = ()
    error: str = ""
    commit: str
    code: str


def varied() -> tuple[str, ...]:
    """Names of the criteria that are changed."""
    return tuple(each.name for each in CRITERIA.of() if each.group != UNTOUCHED)


def trial(number: int, commit: str, code: str) -> Trial:
    """The answers to the case of that number; none where its bench finds no state."""
    try:
        it, found, _ = measured(number)
    except RuntimeError as error:
        return Trial(number=number, answer=None, error=str(error), commit=commit, code=code)
    shelf = fit_cache(campaign_of(it, found, it.seed), Model(), catalogue())
    here = _answer(it, shelf)
    changes = []
    for name in varied():
        for factor in FACTORS:
            other = _answer(it, shelf.under(CRITERIA.times(name, factor)))
            if (other.verdict, other.sets) != (here.verdict, here.sets):
                changes.append(Change(criterion=name, factor=factor, answer=other))
    return Trial(number=number, answer=here, changes=tuple(changes), commit=commit, code=code)


def _answer(it: Case, shelf: Shelf) -> Verdict:
    ruling = chosen(shelf, Attempts()).ruling
    sets = tuple(dict.fromkeys((*ruling.sets, *(each.without for each in ruling.instead))))
    named = [tuple(sorted(names - {ALWAYS})) for names in sets]
    score = judged(it, ruling.verdict, named)
    return Verdict(verdict=ruling.verdict, sets=tuple(sorted(named)), score=score)
