"""Whether what a fit leaves is white along the load paths: no row alike or opposite to the next, or the one after it.

With A_k half of both k-th side diagonals, one block a test and channel, Q the basis of what the fit can move and
M = 1 - Q Q', c = r'A_k r / r'r of n = tr M degrees of freedom has, for white noise of any size,

    mean tr(M A_k) / n,    variance 2 (tr(M A_k M A_k) - tr(M A_k)² / n) / (n (n + 2))

(J. Durbin, G. S. Watson, Biometrika 37 (1950) 409-428), and is nearly normal. A shape that the tests are too coarse for
turns its sign from row to row: a ripple of a rack, a play that is passed at every step.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from pipeline.inference.fit import Fit
from pipeline.inference.orthonormal_basis import basis
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]
LAGS = (1, 2)
"""Rows from one to the other."""
FEWEST = 3
"""Degrees of freedom below which nothing can be said."""


def white(found: Fit, criteria: Criteria) -> bool:
    """Whether noise may have left it, of the fitted tests; true where too few rows are left to say."""
    series = list(paths(found).values())
    taken = basis(found.jacobian)[np.concatenate(series)] if series else np.zeros((0, 0))
    scores = departures([found.whitened[rows] for rows in series], taken)
    return all(2.0 * norm.sf(abs(score)) * len(LAGS) >= criteria.check_level for score in scores)


def paths(found: Fit) -> dict[tuple[int, int], NDArray[np.int64]]:
    """Places in the whitened residual of every fitted test and channel, by numbers of both, in the order of steps."""
    rows = found.residual.rows
    tests = found.residual.load_cases.test[rows[:, 0]]
    keys, place = np.unique(np.stack([tests, rows[:, 1]], axis=1), axis=0, return_inverse=True)
    return {
        (int(test), int(channel)): np.flatnonzero(place.ravel() == k)
        for k, (test, channel) in enumerate(keys)
    }


def departures(series: Sequence[Array], taken: Array) -> list[float]:
    """By how many of its standard deviations c of each lag is off, one way or the other.

    series: (n,) whitened residuals of each path. taken: (N, p) what the fit can move, rows in the order of the series.
    Empty where fewer than three degrees are left, or nothing.
    """
    residual = np.concatenate(series) if series else np.zeros(0)
    lengths = [len(one) for one in series]
    degrees = residual.size - taken.shape[1]
    squares = float(residual @ residual)
    if degrees < FEWEST or squares == 0.0:
        return []
    out = []
    for lag in LAGS:
        moved = _shifted(taken, lengths, lag)
        inner = taken.T @ moved
        pairs = sum(max(0, length - lag) for length in lengths)
        trace = -float(np.trace(inner))
        # tr A² is half the number of pairs.
        second = 0.5 * pairs - 2.0 * float(np.sum(moved**2)) + float(np.sum(inner * inner.T))
        variance = 2.0 * (second - trace**2 / degrees) / (degrees * (degrees + 2.0))
        if variance <= 0.0:
            continue
        c = float(residual @ _shifted(residual[:, None], lengths, lag)[:, 0]) / squares
        out.append((c - trace / degrees) / np.sqrt(variance))
    return out


def _shifted(columns: Array, lengths: Sequence[int], lag: int) -> Array:
    """(N, p) A times columns."""
    out, first = np.zeros_like(columns), 0
    for length in lengths:
        own, new = columns[first : first + length], out[first : first + length]
        new[lag:] += 0.5 * own[:-lag]
        new[:-lag] += 0.5 * own[lag:]
        first += length
    return out
