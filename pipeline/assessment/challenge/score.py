"""The score: what the answers were, by kind of case, by size and by confusability, with exact bounds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any, get_args

import numpy as np
from scipy.stats import binomtest, norm

from pipeline.assessment.challenge.outcome import Outcome, Score
from pipeline.record import Record

SIZES = (0.0, 3.0, 6.0, 10.0, 30.0, 100.0, 1e9)
GAMMAS = (1.0, 1.5, 3.0, 10.0, 1e9)
LARGE, FOLD = 6.0, 3.0
"""An effect is large from max(FOLD gamma, LARGE) sigmas on."""
PLAIN = 10.0
"""Sigmas from which what no effect explains has to be called unknown."""
HELD = 1.15
LEVEL = 0.95


class Share(Record):
    """So many of so many, with the bounds of Clopper and Pearson (95 %)."""

    count: int
    of: int
    low: float
    high: float

    def __str__(self) -> str:
        if not self.of:
            return "–"
        return (
            f"{100 * self.count / self.of:.1f} % ({100 * self.low:.1f} .. {100 * self.high:.1f}) of {self.of}"
        )


class Goal(Record):
    """What was wanted, and what came out."""

    name: str
    wanted: str
    share: Share


class Cell(Record):
    """Cases of one range of sizes and confusabilities. formula: the mean of Phi(size / gamma - 2.33 + 1.645), what
    the rule of thumb gives for "named right or in a named set"."""

    size: tuple[float, float]
    gamma: tuple[float, float]
    scores: dict[str, int]
    formula: float | None


class Scored(Record):
    """The whole score. kinds: scores by kind of case. faults: of what no effect explains, by fault."""

    cases: int
    goals: tuple[Goal, ...]
    kinds: dict[str, dict[str, int]]
    effects: dict[str, dict[str, int]]
    faults: dict[str, dict[str, int]]
    cells: tuple[Cell, ...]
    seconds_median: float
    seconds_95: float
    wrong: tuple[int, ...]
    commits: tuple[str, ...]


def share(hits: Iterable[bool]) -> Share:
    """Of all."""
    found = [bool(hit) for hit in hits]
    return counted(sum(found), len(found))


def counted(count: int, of: int) -> Share:
    """So many of so many."""
    if not of:
        return Share(count=0, of=0, low=0.0, high=1.0)
    ends = binomtest(count, of).proportion_ci(LEVEL, method="exact")
    return Share(count=count, of=of, low=float(ends.low), high=float(ends.high))


def scored(outcomes: Sequence[Outcome]) -> Scored:
    """The score of these outcomes."""
    every = sorted(outcomes, key=lambda it: it.number)
    seconds = np.array([it.seconds for it in every])
    bad = ("wrong", "false alarm")
    hidden = [it for it in every if it.kind in ("single", "pair", "untold")]
    return Scored(
        cases=len(every),
        goals=tuple(_goals(every)),
        kinds=by(every, lambda it: (it.kind,)),
        effects=by(hidden, lambda it: tuple(it.sizes)),
        faults=by([it for it in every if it.fault], lambda it: (it.fault[0] if it.fault else "",)),
        cells=tuple(_cells([it for it in every if it.kind == "single"])),
        seconds_median=float(np.median(seconds)),
        seconds_95=float(np.quantile(seconds, 0.95)),
        wrong=tuple(it.number for it in every if it.score in bad),
        commits=tuple(sorted({it.commit for it in every})),
    )


def _goals(every: Sequence[Outcome]) -> list[Goal]:
    of: dict[str, list[Outcome]] = {kind: [it for it in every if it.kind == kind] for kind in _KINDS}
    catalogue = [*of["single"], *of["pair"]]
    large = [it for it in of["single"] if it.size >= max(FOLD * it.confusability, LARGE)]
    pairs = [it for it in of["pair"] if it.size >= max(FOLD * it.confusability, LARGE)]
    told = [it for it in of["untold"] if LARGE <= it.size < it.confusability]
    plain = [it for it in of["outside"] if it.size >= PLAIN]
    right = [it for it in [*catalogue, *of["untold"]] if it.score == "right"]
    bad = ("wrong", "false alarm")
    inside = [holds for it in right for holds in it.inside.values()]
    held = [rms for it in right for rms in it.holdout]
    made = [
        ("wrong names, of all cases", "at most 2 %", share(it.score in bad for it in every)),
        ("false alarms, of clean cases", "at most 2 %", share(it.score in bad for it in of["clean"])),
        ("named right, single and large", "at least 95 %", share(it.score == "right" for it in large)),
        ("pairs named right, both large", "at least 85 %", share(it.score == "right" for it in pairs)),
        ("in a named set, where the plan cannot tell", "at least 95 %", share(it.score == "in set" for it in told)),
        ("a single name, where the plan cannot tell", "never", share(_single(it) for it in told)),
        ("unknown, outside the catalogue, plain", "at least 90 %", share(it.score == "right" for it in plain)),
        ("a name, outside the catalogue", "at most 5 %", share(it.score == "wrong" for it in of["outside"])),
        ("95 % intervals that hold the truth", "92 to 98 %", share(inside)),
        ("held-out tests at most 1.15, named right", "at least 95 %", share(rms <= HELD for rms in held)),
        ("no answer at all", "never", share(it.score == "failed" for it in every)),
    ]  # fmt: skip
    return [Goal(name=name, wanted=wanted, share=found) for name, wanted, found in made]


_KINDS = ("clean", "single", "pair", "outside", "untold")


def _single(it: Outcome) -> bool:
    return it.verdict == "identified" and bool(it.sets and it.sets[0])


def by(outcomes: Iterable[Any], names: Callable[[Any], tuple[str, ...]]) -> dict[str, dict[str, int]]:
    """Numbers of scores, by name."""
    found: dict[str, dict[str, int]] = {}
    for it in outcomes:
        for name in names(it):
            own = found.setdefault(name, {})
            own[it.score] = own.get(it.score, 0) + 1
    return dict(sorted(found.items()))


def _cells(singles: Sequence[Outcome]) -> list[Cell]:
    out = []
    for low, high in pairwise(SIZES):
        for least, most in pairwise(GAMMAS):
            mine = [it for it in singles if low <= it.size < high and least <= it.confusability < most]
            if not mine:
                continue
            counts = {score: sum(it.score == score for it in mine) for score in get_args(Score)}
            expected = [norm.cdf(it.size / it.confusability - 2.33 + 1.645) for it in mine]
            out.append(
                Cell(
                    size=(low, high),
                    gamma=(least, most),
                    scores={score: n for score, n in counts.items() if n},
                    formula=float(np.mean(expected)),
                )
            )
    return out
