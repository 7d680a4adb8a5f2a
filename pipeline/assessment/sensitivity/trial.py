"""One bench, diagnosed under the criteria as they are and under each changed alone."""

from __future__ import annotations

from pipeline.assessment.challenge.cases import ALWAYS, Case
from pipeline.assessment.challenge.outcome import Score, campaign_of, judged, measured
from pipeline.assessment.study import Tried
from pipeline.attempt import Attempts
from pipeline.inference.model import Model
from pipeline.record import Record
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.law_criteria import GROUP
from pipeline.selection.searched import chosen
from vjm.effects import catalogue

FACTORS = (0.5, 2.0)
UNTOUCHED = ("plan", GROUP)
"""Groups of the criteria that no set of effects depends on: those of planned tests, and those of laws, which are looked
for after the answer."""
UNASKED = ("nominals", "certain", "noise", "bad readings", "doctor", "faults")
"""Groups that one search does not ask: what comes before it and after it, of tables and readings that are not as they
were declared and of sensors at fault. The benches of the challenge are exact."""


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


class Trial(Tried):
    """A case of the challenge: its answer, and every other one that a changed criterion leads to."""

    number: int
    answer: Verdict | None
    changes: tuple[Change, ...] = ()
    error: str = ""


def varied() -> tuple[str, ...]:
    """Names of the criteria that are changed."""
    return tuple(each.name for each in CRITERIA.of() if each.group not in (*UNTOUCHED, *UNASKED))


def trial(number: int, commit: str, code: str) -> Trial:
    """The answers to the case of that number; none where its bench finds no state."""
    try:
        it, found, _ = measured(number)
    except RuntimeError as error:
        return Trial(number=number, answer=None, error=str(error), commit=commit, code=code)
    cache = cached_fits(campaign_of(it, found, it.seed), Model(), catalogue())
    here = _answer(it, cache)
    changes = []
    for name in varied():
        for factor in FACTORS:
            other = _answer(it, cache.under(CRITERIA.times(name, factor)))
            if (other.verdict, other.sets) != (here.verdict, here.sets):
                changes.append(Change(criterion=name, factor=factor, answer=other))
    return Trial(number=number, answer=here, changes=tuple(changes), commit=commit, code=code)


def _answer(it: Case, cache: FitCache) -> Verdict:
    decision = chosen(cache, Attempts()).decision
    sets = tuple(dict.fromkeys((*decision.sets, *(each.without for each in decision.instead))))
    named = [tuple(sorted(names - {ALWAYS})) for names in sets]
    score = judged(it, decision.verdict, named)
    return Verdict(verdict=decision.verdict, sets=tuple(sorted(named)), score=score)
