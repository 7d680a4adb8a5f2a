"""The score of the look for laws: goals with exact bounds, and what became of each hidden law."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pipeline.assessment.challenge.laws.outcome import LawOutcome
from pipeline.assessment.challenge.score import Goal, Share, share
from pipeline.record import Record

SMALL, LARGE = 15.0, 30.0
"""Sigmas from which a law has to be found in three of four cases, and in nine of ten."""
IN_GRAMMAR, OUTSIDE = 1.15, 1.3
"""Held-out error that the forms of the grammar keep, and that others do."""


class LawScored(Record):
    """The whole score."""

    cases: int
    goals: tuple[Goal, ...]
    excess: float | None
    """Median of sqrt(rms² - 1) in held-out tests over those of a Gaussian process; None without any."""
    outcomes: tuple[LawOutcome, ...]
    seconds_median: float
    seconds_most: float
    seconds_of_diagnosis: float
    commits: tuple[str, ...]


def law_scored(outcomes: Sequence[LawOutcome]) -> LawScored:
    """The score of these outcomes."""
    every = tuple(sorted(outcomes, key=lambda it: (it.kind, it.number)))
    seconds = [it.seconds for it in every] or [0.0]
    ours = [it.excess for it in every if it.excess is not None]
    process = [it.excess_of_process for it in every if it.excess_of_process is not None]
    return LawScored(
        cases=len(every),
        goals=tuple(_goals(every)),
        excess=float(np.median(ours) / max(float(np.median(process)), 1e-9)) if ours and process else None,
        outcomes=every,
        seconds_median=float(np.median(seconds)),
        seconds_most=float(np.max(seconds)),
        seconds_of_diagnosis=float(np.median([it.seconds_of_diagnosis for it in every] or [0.0])),
        commits=tuple(sorted({it.commit for it in every})),
    )


def _goals(every: Sequence[LawOutcome]) -> list[Goal]:
    alone = [it for it in every if it.kind == "law" and it.hidden]
    rich = [it for it in alone if not it.poor]
    large = [it for it in rich if it.size >= LARGE]
    small = [it for it in rich if it.size < LARGE]
    told = [it for it in rich if it.told_by >= SMALL]
    pairs = [it for it in every if it.kind == "pair" and it.hidden]
    clean = [it for it in every if it.kind == "clean"]
    found = [it for it in alone if all(it.right)]
    known = [it for it in found if it.hidden[0].forms]
    unknown = [it for it in found if not it.hidden[0].forms]
    made: list[tuple[str, str, Share]] = [
        (f"place or its group right, from {LARGE:g} sigmas", "at least 90 %", share(map(_right, large))),
        (f"place or its group right, {SMALL:g} to {LARGE:g} sigmas", "at least 75 %", share(map(_right, small))),
        (f"place or its group right, {SMALL:g} sigmas beside tolerances", "at least 75 %", share(map(_right, told))),
        ("plans that cannot tell: group right", "100 %", share(_right(it) for it in alone if it.poor)),
        ("form among the ties, place right", "at least 90 %", share(f for it in known for f in it.form_among)),
        (f"held out at most {IN_GRAMMAR}, form known", "at least 80 %", share(_held(it) <= IN_GRAMMAR for it in known)),
        (f"held out at most {OUTSIDE}, no form", "at least 60 %", share(_held(it) <= OUTSIDE for it in unknown)),
        ("wrong names of the catalogue", "at most 1 %", share(bool(it.wrong_names) for it in alone if it.verdict)),
        ("two laws: both places", "at least 70 %", share(map(_right, pairs))),
        ("two laws: a false place", "never", share(it.false_places > 0 for it in pairs)),
        ("clean benches with a law", "never", share(bool(it.found) for it in clean if not it.error)),
        ("no answer at all", "never", share(bool(it.error) for it in every)),
    ]  # fmt: skip
    return [Goal(name=name, wanted=wanted, share=share_) for name, wanted, share_ in made]


def _right(it: LawOutcome) -> bool:
    return all(it.right)


def _held(it: LawOutcome) -> float:
    """Whitened RMS of the held-out tests that see the law, together; infinite where there is none."""
    return float(np.sqrt(np.mean(np.square(it.held_out)))) if it.held_out else np.inf
