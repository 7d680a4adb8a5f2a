"""The mean misfit of the worst channel in one sentence: a share of what the model says, a constant, or a sign."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.compare.error import Discrepancy
from pipeline.inference.driving import column_name, unit_of
from reports.quantities import proportion, short, sigma

Array = NDArray[np.float64]
ABOVE = 4.0
"""Sigmas of a mean or of a share from which it is told: one in 16 000 is noise, and a dozen channels are looked at."""
TURNED = 0.5
"""Part by which a channel that runs against the model may miss it for its sign to be asked about."""

CONSTANT = 0.75
"""Part of chi-square from which a constant is asked about as a zero: of an error that grows with the square of a load,
in equal steps from none, its mean takes 5/9, of one in proportion to it 3/4."""


@dataclass(frozen=True)
class Mean:
    """One channel over all fitted tests. explained: chi-square that the number takes off; score: in sigmas."""

    channel: int
    words: str
    explained: float
    score: float
    total: float


def headline(discrepancy: Discrepancy) -> str:
    """The channel that is worst, and how it is off in the mean; empty where no mean is above noise."""
    every = [it for it in _means(discrepancy) if it.score > ABOVE]
    if not every:
        return ""
    worst = max(every, key=lambda it: it.total).channel
    best = max((it for it in every if it.channel == worst), key=lambda it: it.explained)
    alone = "" if _readings(discrepancy, worst) > 1 else "; one reading cannot tell why"
    return f"{best.words} ({sigma(best.score)} sigma){alone}"


def _readings(discrepancy: Discrepancy, channel: int) -> int:
    return int((discrepancy.kept[:, channel] & discrepancy.load_cases.fitted).sum())


def _means(discrepancy: Discrepancy) -> Iterator[Mean]:
    """A share and a constant of every channel."""
    whole = discrepancy.load_cases
    for channel in np.flatnonzero((discrepancy.kept & whole.fitted[:, None]).any(axis=0)):
        rows = discrepancy.kept[:, channel] & whole.fitted
        spread = discrepancy.sigma[rows, channel]
        off = discrepancy.units[rows, channel]
        predicted = discrepancy.prediction.values[rows, channel]
        name = column_name(int(channel), whole.campaign.gauges)
        unit = unit_of(int(channel)).replace("Nmm", "N·mm")
        total = float(np.sum((off / spread) ** 2))
        share, of_share = _weighted(off, predicted, spread)
        if np.isfinite(share):
            yield Mean(int(channel), _in_proportion(name, share), of_share, float(np.sqrt(of_share)), total)
        mean, of_mean = _weighted(off, np.ones_like(off), spread)
        average = " on average" if off.size > 1 else ""
        words = f"{name} is {short(mean)} {unit} off{average}"
        if of_mean > CONSTANT * total and not whole.loose[whole.test[rows], channel].all():
            words += ': was it zeroed (zero = "fitted")?'
        # Of a share and a constant that explain alike the share says more.
        yield Mean(int(channel), words, 0.99 * of_mean, float(np.sqrt(of_mean)), total)


def _weighted(off: Array, regressor: Array, spread: Array) -> tuple[float, float]:
    """Coefficient of a regressor (N,), and the chi-square that it takes off; not a number where it says nothing."""
    square = float(np.sum((regressor / spread) ** 2))
    if not square > 0.0 or not np.isfinite(square):
        return np.nan, 0.0
    pull = float(np.sum(regressor * off / spread**2))
    return pull / square, pull**2 / square


def _in_proportion(name: str, share: float) -> str:
    if abs(share + 2.0) < TURNED:
        return f"{name} runs against the model: is its sign, or that of its load, right?"
    return f"{name} is {proportion(share)}"
