"""The study as a record: errors of every approach inside and outside, and the diagnosis beside the Gaussian process."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binom

from pipeline.assessment.challenge.score import Share, share
from pipeline.assessment.extrapolation.approaches import APPROACHES, DIAGNOSIS, GAUSSIAN
from pipeline.assessment.extrapolation.trial import Trial
from pipeline.record import Record

Array = NDArray[np.float64]
ALL, IDENTIFIED, NAMED = "all", "identified", "named"
LEVEL = 0.95


class Row(Record):
    """Of one approach: cases with a prediction, median and 90 % quantile of its errors in sigmas, cases with rows
    outside that it lost, and the median of its seconds."""

    approach: str
    cases: int
    inside: float
    inside_90: float
    outside: float
    outside_90: float
    lost: int
    seconds: float


class Ratio(Record):
    """Error of the Gaussian process over that of the diagnosis, outside: median, with the order statistics that hold
    it with at least 95 %, None for fewer than six cases. worse: cases where the diagnosis is the worse one."""

    cases: int
    median: float
    low: float | None
    high: float | None
    worse: Share


class Group(Record):
    """Some of the cases."""

    name: str
    cases: int
    rows: tuple[Row, ...]
    ratio: Ratio | None


class Point(Record):
    """Errors of one approach on one case. mu: sigmas by which the least of its hidden effects shows."""

    number: int
    verdict: str
    mu: float
    approach: str
    inside: float
    outside: float


class Study(Record):
    """all: every case; identified: the verdict was that; named: and it named something beyond what every bench has.

    failed: reasons by case and approach.
    """

    cases: int
    groups: tuple[Group, ...]
    points: tuple[Point, ...]
    failed: dict[str, str]
    seconds: float
    commits: tuple[str, ...]


def study(trials: Sequence[Trial]) -> Study:
    """Of at least one trial."""
    every = sorted(trials, key=lambda it: it.number)
    identified = [it for it in every if it.verdict == "identified"]
    named = [it for it in identified if any(it.sets)]
    found = [_group(n, g) for n, g in ((ALL, every), (IDENTIFIED, identified), (NAMED, named)) if g]
    points = [
        Point(
            number=it.number, verdict=it.verdict, mu=it.mu, approach=name, inside=e.inside, outside=e.outside
        )
        for it in every
        for name, e in it.errors.items()
    ]
    return Study(
        cases=len(every),
        groups=tuple(found),
        points=tuple(points),
        failed={f"{it.number}, {name}": why for it in every for name, why in it.failed.items()},
        seconds=float(np.median([sum(it.seconds.values()) for it in every])),
        commits=tuple(sorted({it.commit for it in every})),
    )


def _group(name: str, trials: Sequence[Trial]) -> Group:
    rows = [_row(approach, trials) for approach in APPROACHES if any(approach in it.errors for it in trials)]
    return Group(name=name, cases=len(trials), rows=tuple(rows), ratio=_ratio(trials))


def _row(approach: str, trials: Sequence[Trial]) -> Row:
    mine = [it for it in trials if approach in it.errors]
    inside = [it.errors[approach].inside for it in mine]
    outside = [it.errors[approach].outside for it in mine]
    return Row(
        approach=approach,
        cases=len(mine),
        inside=float(np.median(inside)),
        inside_90=float(np.quantile(inside, 0.9)),
        outside=float(np.median(outside)),
        outside_90=float(np.quantile(outside, 0.9)),
        lost=sum(it.errors[approach].lost > 0 for it in mine),
        seconds=float(np.median([it.seconds[approach] for it in mine])),
    )


def _ratio(trials: Sequence[Trial]) -> Ratio | None:
    both = [it.errors for it in trials if GAUSSIAN in it.errors and DIAGNOSIS in it.errors]
    if not both:
        return None
    ratios = np.array([e[GAUSSIAN].outside / max(e[DIAGNOSIS].outside, 1e-12) for e in both])
    low, high = median_interval(ratios)
    return Ratio(
        cases=len(both),
        median=float(np.median(ratios)),
        low=low,
        high=high,
        worse=share(ratio < 1.0 for ratio in ratios),
    )


def median_interval(values: Array) -> tuple[float, float] | tuple[None, None]:
    """Order statistics of values (n,) that hold the median with at least 95 %, whatever the distribution; None
    where none do.

    The number of values below the median is binomial: H. A. David, H. N. Nagaraja, Order Statistics, 3rd ed.,
    Wiley 2003, section 7.1.
    """
    count = len(values)
    place = int(binom.ppf(0.5 * (1.0 - LEVEL), count, 0.5))
    if place == 0:
        return None, None
    ordered = np.sort(values)
    return float(ordered[place - 1]), float(ordered[count - place])
