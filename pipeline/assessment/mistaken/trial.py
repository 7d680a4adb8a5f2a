"""One table with a mistake, or right, and what the look for mistakes says of it."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np

from pipeline.assessment.challenge.cases import ROUND
from pipeline.assessment.challenge.outcome import campaign_of, measured
from pipeline.assessment.mistaken.tables import KINDS, Made
from pipeline.assessment.study import Tried
from pipeline.campaign.tolerance import usual
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import cached_fits
from pipeline.selection.doctor import suspicions
from vjm.effects import catalogue
from vjm.work import TooMuch

NONE = "right"
"""The kind of a table without a mistake."""
SEED = 20261129


class Trial(Tried):
    """A table. kind: of mistake; number: of the bench among the cases of the challenge. hidden: names of effects that
    it has. made: the words that name the mistake; empty where it would not show. told: words of all that is said,
    the likeliest first. error: why nothing was looked at, or the look did not end."""

    kind: str
    number: int
    hidden: tuple[str, ...]
    made: str = ""
    told: tuple[str, ...] = ()
    error: str = ""
    seconds: float = 0.0

    @property
    def counts(self) -> bool:
        """Whether there was something to be named, or a right table to be left alone."""
        return self.kind == NONE or bool(self.made)

    @property
    def named(self) -> bool:
        """Whether the mistake is among what is told, or a right table is left alone."""
        return not self.told if self.kind == NONE else self.made in self.told


def benches(kind: str, count: int) -> tuple[int, ...]:
    """The first cases of the challenge of a kind."""
    return tuple(k for k in range(count * len(ROUND)) if ROUND[k % len(ROUND)] == kind)[:count]


def trial(kind: str, number: int, commit: str, code: str) -> Trial:
    """What is said of a table; all that is written of its rig is known to the usual tolerances."""
    common = {"kind": kind, "number": number, "commit": commit, "code": code}
    try:
        it, found, _ = measured(number)
    except RuntimeError as error:
        return Trial(**common, hidden=(), error=str(error))
    exact = campaign_of(it, found, it.seed)
    table = replace(exact, tolerance=usual(exact.rig.written))
    generator = np.random.default_rng([SEED, number, [NONE, *KINDS].index(kind)])
    made = Made(table, "") if kind == NONE else KINDS[kind](table, generator)
    if made is None:
        return Trial(**common, hidden=it.effects)
    began, told, why = process_time(), tuple[str, ...](), ""
    try:
        told = tuple(each.mistake.words for each in suspicions(cached_fits(made.table, Model(), catalogue())))
    except (InputError, TooMuch, RuntimeError) as error:
        why = str(error) or type(error).__name__
    seconds = round(process_time() - began, 2)
    return Trial(**common, hidden=it.effects, made=made.words, told=told, error=why, seconds=seconds)
