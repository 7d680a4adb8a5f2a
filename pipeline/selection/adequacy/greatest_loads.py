"""Whether readings that are off alone are those of the greatest loads: then a law does it there, and it is no noise.

What stiffens, slips or gives way without bounds shows most in the last row before a load turns back, where its
neighbours are off by far less, in test after test. A bad reading falls on any row: of n bad ones of a column, k at the
greatest loads are as likely as k or more of n draws with p, the share of such rows (the binomial distribution).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binom

from pipeline.inference.driving import driving
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.noise import MEDIAN
from pipeline.inference.settings import GREATEST_LOADS

Mask = NDArray[np.bool_]


def at_greatest_loads(whole: LoadCases) -> Mask:
    """(R,) rows where the quantity that drives their test is as large as it gets, of either sign."""
    out = np.zeros(len(whole.test), dtype=bool)
    for number, test in enumerate(whole.campaign.tests):
        _, values = driving(test, whole.campaign.gauges)
        rows = whole.first[number] + np.arange(values.size)
        for way in (values, -values):
            if way.max(initial=0.0) > 0.0:
                out[rows] |= way >= GREATEST_LOADS.near * way.max()
    return out


def of_a_law(
    bad: Sequence[tuple[int, int]], there: Mask, whole: LoadCases, level: float
) -> frozenset[tuple[int, int]]:
    """Of readings that are off alone, by row and channel, those of channels in which they are at the greatest loads
    more often than by chance. there: (R, C) readings that could be bad ones. level: chance from which it is none."""
    peaks, out = at_greatest_loads(whole), set[tuple[int, int]]()
    for channel in {channel for _, channel in bad}:
        rows = np.array([row for row, own in bad if own == channel])
        if _too_many(rows, peaks, np.flatnonzero(there[:, channel])) < level:
            out |= {(int(row), channel) for row in rows}
    return frozenset(out)


def off_at_greatest_loads(found: Fit, level: float) -> bool:
    """Whether residuals of a channel that are far out are at the greatest loads more often than by chance.

    level: chance from which they are not."""
    whole = found.residual.load_cases
    peaks, rows = at_greatest_loads(whole), found.residual.rows
    for channel in np.unique(rows[:, 1]):
        own = rows[:, 1] == channel
        sizes = np.abs(found.whitened[own])
        far = sizes > GREATEST_LOADS.far * max(1.0, float(np.median(sizes)) / MEDIAN)
        if far.any() and _too_many(rows[own, 0][far], peaks, rows[own, 0]) < level:
            return True
    return False


def _too_many(some: NDArray[np.int64], peaks: Mask, every: NDArray[np.int64]) -> float:
    """Chance that of as many rows, drawn from all, as many are at the greatest loads as of these."""
    return float(binom.sf(int(peaks[some].sum()) - 1, some.size, float(peaks[every].mean())))
