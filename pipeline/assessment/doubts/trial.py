"""One bench with one doubt, diagnosed and judged."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np

from pipeline.assessment.challenge.dirty.dirt import Dirt
from pipeline.assessment.challenge.dirty.shown import shown
from pipeline.assessment.doubts.answers import in_words, sets_of, told
from pipeline.assessment.doubts.benches import SEED, Drawn, rig_of, table
from pipeline.assessment.doubts.kinds import KINDS
from pipeline.inference.model import Model
from pipeline.record import Record
from pipeline.selection.diagnosis import diagnose
from vjm.effects import catalogue


class Trial(Record):
    """A bench. kind: of doubt. hidden: names of effects that it has. sets: in words. wrong: why the answer is not as it
    should be, empty where it is. error: why there is no answer. seconds: of the diagnosis."""

    kind: str
    number: int
    hidden: tuple[str, ...] = ()
    verdict: str = ""
    sets: str = ""
    wrong: str = ""
    error: str = ""
    seconds: float = 0.0
    commit: str
    code: str

    @property
    def right(self) -> bool:
        """Whether the answer is as it should be."""
        return not self.wrong and not self.error


def drawn_for(kind: str, number: int) -> Drawn:
    """What a kind of doubt makes of the bench of that number; every other one has an effect hidden, or is of the other
    sort."""
    generator = np.random.default_rng([SEED, number, 2])
    return KINDS[kind].draw(rig_of(number), generator, bool(number % 2))


def trial(kind: str, number: int, commit: str, code: str) -> Trial:
    """The bench of that number with a kind of doubt."""
    common = {"kind": kind, "number": number, "commit": commit, "code": code}
    of = drawn_for(kind, number)
    try:
        it, campaign, knocks = table(number, of, f"{kind} {number}")
        began = process_time()
        answer = diagnose(campaign, Model(), catalogue())
        seconds = round(process_time() - began, 2)
        said = told(answer, campaign, knocks, shown(campaign, knocks))
        if KINDS[kind].beside:
            clear = replace(of, dirt=Dirt.of_bar(of.dirt.bar), knocked=0)
            without = diagnose(table(number, clear, f"bench {number}")[1], Model(), catalogue())
            said = replace(said, beside=(without.verdict, sets_of(without)))
    except (RuntimeError, ArithmeticError, ValueError) as error:
        return Trial(**common, error=f"{type(error).__name__}: {error}")
    return Trial(
        **common,
        hidden=it.effects,
        verdict=said.verdict,
        sets=in_words(said.sets),
        wrong=KINDS[kind].judged(said),
        seconds=seconds,
    )
