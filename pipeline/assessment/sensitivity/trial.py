"""One bench, diagnosed under the criteria as they are and under each changed alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from pipeline.answer.of_diagnosis import answer_of
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.dirty import outcome as dirty
from pipeline.assessment.challenge.dirty.dirt import read_dirty
from pipeline.assessment.challenge.dirty.judged import judged as judged_dirty
from pipeline.assessment.challenge.outcome import campaign_of, judged, measured
from pipeline.assessment.sensitivity.watched import watched
from pipeline.assessment.study import Tried
from pipeline.attempt import Attempts
from pipeline.inference.model import Model
from pipeline.record import Record
from pipeline.selection.criteria import CRITERIA, Criteria
from pipeline.selection.diagnosis import cached_fits, diagnose
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.law_criteria import GROUP
from pipeline.selection.searched import chosen
from vjm.effects import catalogue

UNTOUCHED = ("plan", "nominals", GROUP)
"""Groups of the criteria that no set of effects depends on: those of planned tests, those by which a number that was
written is told as moved, and those of laws, which are looked for after the answer."""
OF_TABLES = ("certain", "noise", "bad readings", "doctor", "faults")
"""Groups that are asked before a search and after it, of tables and readings that are not as they were declared and of
sensors at fault: on dirty benches. The benches of the clean challenge are exact, and one search asks the others."""
Programme = Literal["clean", "dirty"]


class Verdict(Record):
    """An answer. sets: without what every bench has, each sorted. certain: what is there whatever the verdict. table:
    what is said of the table: mistakes, noise, readings set aside."""

    verdict: str
    sets: tuple[tuple[str, ...], ...]
    score: str
    certain: tuple[str, ...] = ()
    table: tuple[str, ...] = ()


class Change(Record):
    """An answer that is not the one of the criteria as they are."""

    criterion: str
    factor: float
    answer: Verdict


class Trial(Tried):
    """A case of a programme of the challenge: its answer, and every other one that a changed criterion leads to."""

    programme: Programme = "clean"
    number: int
    answer: Verdict | None
    changes: tuple[Change, ...] = ()
    error: str = ""


Ask = Callable[[Criteria], Verdict]


def varied(programme: Programme) -> tuple[str, ...]:
    """Names of the criteria that are changed on its benches."""
    of_tables = programme == "dirty"
    return tuple(
        each.name
        for each in CRITERIA.of()
        if each.group not in UNTOUCHED and (each.group in OF_TABLES) == of_tables
    )


def trial(programme: Programme, number: int, commit: str, code: str) -> Trial:
    """The answers to the case of that number; none where its bench finds no state."""
    try:
        ask = _clean(number) if programme == "clean" else _dirty(number)
    except RuntimeError as error:
        return Trial(
            programme=programme, number=number, answer=None, error=str(error), commit=commit, code=code
        )
    here, changes = varied_alone(ask, varied(programme))
    return Trial(programme=programme, number=number, answer=here, changes=changes, commit=commit, code=code)


def varied_alone(ask: Ask, names: tuple[str, ...]) -> tuple[Verdict, tuple[Change, ...]]:
    """An answer, and those that differ from it with one criterion halved or doubled. One that decided nothing on the
    way to the answer is not asked about again."""
    criteria, noted = watched(names)
    here = ask(criteria)
    others = ((name, factor, ask(CRITERIA.times(name, factor))) for name, factor in sorted(noted))
    return here, tuple(Change(criterion=n, factor=f, answer=it) for n, f, it in others if it != here)


def _clean(number: int) -> Ask:
    """One search. Sets are fitted once, but where fits depend on what is changed."""
    it, found, _ = measured(number)
    first: list[FitCache] = []

    def ask(criteria: Criteria) -> Verdict:
        if first:
            # What was fitted for the first that was asked is known to all others.
            here = first[0].under(criteria)
        else:
            here = cached_fits(campaign_of(it, found, it.seed), Model(), catalogue()).under(criteria)
            first.append(here)
        decision = chosen(here, Attempts()).decision
        sets = tuple(dict.fromkeys((*decision.sets, *(each.without for each in decision.instead))))
        named = [tuple(sorted(names - {ALWAYS})) for names in sets]
        score = judged(it, decision.verdict, named)
        return Verdict(verdict=decision.verdict, sets=tuple(sorted(named)), score=score)

    return ask


def _dirty(number: int) -> Ask:
    """A whole diagnosis."""
    it, found, _ = dirty.measured(number)
    campaign, _ = read_dirty(f"dirty case {number}", it.bench, it.dirt, found, it.seed)

    def ask(criteria: Criteria) -> Verdict:
        try:
            answer = diagnose(campaign, Model(), catalogue(), criteria=criteria)
        except (RuntimeError, ArithmeticError, ValueError) as error:
            return Verdict(verdict="failed", sets=(), score="failed", table=(str(error),))
        record = answer_of(answer)
        sets = tuple(tuple(sorted(set(names) - {ALWAYS})) for names in answer.possible)
        sure = tuple(n for n in answer.certain if n != ALWAYS)
        aside = (f"{each.column} of {each.test}, step {each.step}" for each in record.set_aside)
        return Verdict(
            verdict=answer.verdict,
            sets=tuple(sorted(sets)),
            score=judged_dirty(it, answer.verdict, sets, sure, bool(answer.doctor)),
            certain=sure,
            table=(
                *(each.hypothesis for each in record.doctor),
                *(f"noise of {each.column}" for each in record.noise),
                *aside,
            ),
        )

    return ask
