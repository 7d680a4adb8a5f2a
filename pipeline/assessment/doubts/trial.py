"""One bench or machine with one doubt, diagnosed and judged."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np

from pipeline.assessment.challenge.dirty.dirt import Dirt
from pipeline.assessment.challenge.dirty.shown import shown
from pipeline.assessment.doubts.answers import Told, in_words, sets_of, told
from pipeline.assessment.doubts.benches import SEED, Drawn, rig_of, table
from pipeline.assessment.doubts.kinds import BENCHES, KINDS, MACHINES
from pipeline.assessment.doubts.machines import measured
from pipeline.assessment.study import Tried
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import Diagnosis, diagnose
from vjm.effects import catalogue


class Trial(Tried):
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

    @property
    def right(self) -> bool:
        """Whether the answer is as it should be."""
        return not self.wrong and not self.error


def drawn_for(kind: str, number: int) -> Drawn:
    """What a kind of doubt makes of the bench of that number; every other one has an effect hidden, or is of the other
    sort."""
    return BENCHES[kind].draw(rig_of(number), np.random.default_rng([SEED, number, 2]), bool(number % 2))


def trial(kind: str, number: int, commit: str, code: str) -> Trial:
    """The bench or the machine of that number with a kind of doubt."""
    common = {"kind": kind, "number": number, "commit": commit, "code": code}
    try:
        hidden, said, seconds = _machine(kind, number) if kind in MACHINES else _bench(kind, number)
    except (RuntimeError, ArithmeticError, ValueError) as error:
        return Trial(**common, error=f"{type(error).__name__}: {error}")
    return Trial(
        **common,
        hidden=hidden,
        verdict=said.verdict,
        sets=in_words(said.sets),
        wrong=KINDS[kind].judged(said),
        seconds=seconds,
    )


def _machine(kind: str, number: int) -> tuple[tuple[str, ...], Told, float]:
    campaign = measured(number, MACHINES[kind].draw(np.random.default_rng([SEED, number, 2])))
    answer, seconds = _diagnosed(campaign)
    return (), told(answer, campaign), seconds


def _bench(kind: str, number: int) -> tuple[tuple[str, ...], Told, float]:
    of = drawn_for(kind, number)
    it, campaign, knocks = table(number, of, f"{kind} {number}")
    answer, seconds = _diagnosed(campaign)
    said = told(answer, campaign, knocks, shown(campaign, knocks))
    if BENCHES[kind].beside:
        clear = replace(of, dirt=Dirt.of_bar(of.dirt.bar), knocked=0)
        without, _ = _diagnosed(table(number, clear, f"bench {number}")[1])
        said = replace(said, beside=(without.verdict, sets_of(without)))
    return it.effects, said, seconds


def _diagnosed(campaign: Campaign) -> tuple[Diagnosis, float]:
    """The answer, and the seconds of the processor that it took."""
    began = process_time()
    answer = diagnose(campaign, Model(), catalogue())
    return answer, round(process_time() - began, 2)
