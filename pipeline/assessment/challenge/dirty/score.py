"""The score of the dirty programme: goals with exact bounds, and counts by kind of case."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pipeline.assessment.challenge.dirty.outcome import DirtyOutcome
from pipeline.assessment.challenge.score import FOLD, HELD, LARGE, Goal, Share, by, counted, share
from pipeline.record import Record

SEEN = 10.0
"""Sigmas from which a fault of a sensor has to be named, and a true effect to be certain."""
NAMED = ("right", "in set", "certain")
FALSE = ("wrong", "false alarm")


class DirtyScored(Record):
    """The whole score. kinds: scores by kind of case; effects: by what was hidden; faults: of what no effect
    explains."""

    cases: int
    goals: tuple[Goal, ...]
    kinds: dict[str, dict[str, int]]
    effects: dict[str, dict[str, int]]
    faults: dict[str, dict[str, int]]
    seconds_median: float
    seconds_95: float
    wrong: tuple[int, ...]
    commits: tuple[str, ...]


def dirty_scored(outcomes: Sequence[DirtyOutcome]) -> DirtyScored:
    """The score of these outcomes."""
    every = sorted(outcomes, key=lambda it: it.number)
    seconds = np.array([it.seconds for it in every])
    hidden = [it for it in every if it.hidden]
    return DirtyScored(
        cases=len(every),
        goals=tuple(_goals(every)),
        kinds=by(every, lambda it: (it.kind,)),
        effects=by(hidden, lambda it: tuple(name.partition("@")[0] for name in it.sizes)),
        faults=by([it for it in every if it.fault], lambda it: (it.fault[0] if it.fault else "",)),
        seconds_median=float(np.median(seconds)),
        seconds_95=float(np.quantile(seconds, 0.95)),
        wrong=tuple(it.number for it in every if it.score in FALSE),
        commits=tuple(sorted({it.commit for it in every})),
    )


def _goals(every: Sequence[DirtyOutcome]) -> list[Goal]:
    hidden = [it for it in every if it.hidden and it.kind != "sensor"]
    large = [it for it in hidden if it.size >= max(FOLD * it.confusability, LARGE)]
    clean = [it for it in every if it.kind == "clean"]
    sensors = [it for it in every if it.kind == "sensor" and it.size >= SEEN]
    right = [it for it in every if it.score == "right" and it.hidden]
    told = [it for it in every if it.declared_found is not None]
    seen = [(it, name) for it in every for name in it.hidden_names if it.sizes.get(name, 0.0) >= SEEN]
    said = [(it, name) for it in every for name in it.certain]
    held = [rms for it in right for rms in it.holdout]
    knocked, found = sum(it.knocked for it in every), sum(it.knocked_found for it in every)
    shown, clear = sum(it.shown for it in every), sum(it.shown_found for it in every)
    good, aside = sum(it.readings for it in every), sum(it.good_aside for it in every)
    made: list[tuple[str, str, Share]] = [
        ("right, in a set or certain, large effects", "at least 90 %", share(it.score in NAMED for it in large)),
        ("a name that is not there, of all cases", "at most 1 %", share(it.score in FALSE for it in every)),
        ("false alarms, of clean cases", "at most 1 %", share(it.score in FALSE for it in clean)),
        ("faults of sensors named, from 10 sigmas", "at least 85 %", share(it.score in NAMED for it in sensors)),
        ("bad readings found, of those that show", "at least 90 %", counted(clear, shown)),
        ("bad readings found, of all", "no goal", counted(found, knocked)),
        ("good readings set aside", "at most 0.1 %", counted(aside, good)),
        ("declared sigmas off by two recognised", "at least 90 %", share(bool(it.declared_found) for it in told)),
        ("95 % intervals that hold the truth", "93 to 97 %", share(h for it in right for h in it.inside.values())),
        ("held-out tests at most 1.15, named right", "at least 95 %", share(rms <= HELD for rms in held)),
        ("certain and not there", "never", share(name not in it.hidden_names for it, name in said)),
        ("certain, of true effects from 10 sigmas", "at least 95 %", share(name in it.certain for it, name in seen)),
        ("no answer at all", "never", share(it.score == "failed" for it in every)),
    ]  # fmt: skip
    return [Goal(name=name, wanted=wanted, share=found) for name, wanted, found in made]
