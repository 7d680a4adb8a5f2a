"""Tests of a logger that has written thousands of rows: those stay that carry the shape of the loading.

Rows that lie close together on one stretch of the loading say the same of a model, and their noise is seldom as
independent as the rows are many: a part of them, each with its own sigma, claims no more than was measured.
"""

from __future__ import annotations

from dataclasses import fields, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from pipeline.campaign.model import Data, Gauge, Noise, Test
from pipeline.campaign.names import DISPLACEMENT, FORCE

Array = NDArray[np.float64]
LONG, KEPT = 300, 200
"""Rows from which a test is long, and about so many that stay of it."""
SURELY, PART = 6.0, 0.05
"""Sigmas, and part of the whole travel, by which an input has to come back before it has turned."""
RESTING = 0.2
"""Part of the rows that are kept by their number alone, for rests and for what drifts."""


def thinned(test: Test, noise: Noise, gauges: tuple[Gauge, ...]) -> tuple[Test, str]:
    """The test with those rows that carry information, and a sentence on what was left out; "" for a test not long."""
    count = test.data.steps.size
    if count <= LONG:
        return test, ""
    rows = kept(test.inputs(gauges), _sigma(test, noise, gauges))
    said = (
        f"test {test.id}: of {count} rows {len(rows)} are used: the ends, where the loading turns, "
        "and between them rows at equal distances along it"
    )
    return replace(test, data=_part(test.data, rows)), said


def kept(path: Array, sigma: Array) -> NDArray[np.int64]:
    """Numbers of the rows that stay of a loading path (N, 6); sigma: (6,) noise of what is prescribed.

    Chosen by the smoothed path: a row that is the first to go so far is that by its noise.
    """
    path = uniform_filter1d(path, len(path) // KEPT, axis=0, mode="nearest")
    size = np.ptp(path, axis=0)
    least = np.maximum(SURELY * np.nan_to_num(sigma), PART * size)
    driven = np.flatnonzero((size > 2.0 * least) & (size > 0.0))
    corners = {int(k): turns(path[:, k], float(least[k])) for k in driven}
    last = len(path) - 1
    way = np.arange(len(path)) / last
    if corners:
        ways = [_travelled(path[:, k], turned) for k, turned in corners.items()]
        way = RESTING * way + (1.0 - RESTING) * np.mean([each / each[-1] for each in ways], axis=0)
    spread = np.minimum(np.searchsorted(way, np.linspace(0.0, way[-1], KEPT)), last)
    spread = (spread[1:] + spread[:-1]) // 2
    turned = [row for rows in corners.values() for row in rows]
    return np.unique(np.concatenate([[0, last], turned, spread]).astype(np.int64))


def turns(values: Array, least: float) -> list[int]:
    """Rows at which an input (N,) turned: after which it came back by more than `least`."""
    out: list[int] = []
    low = high = 0
    for k, value in enumerate(values):
        # Of a way up the lowest row is that before it, and the next turn is the highest; of a way down the other way.
        if value > values[high]:
            high = k
        if value < values[low]:
            low = k
        if values[high] - value > least and high > low:
            out.append(high)
            low = k
        elif value - values[low] > least and low > high:
            out.append(low)
            high = k
    return [row for row in out if row]


def _travelled(values: Array, turned: list[int]) -> Array:
    """(N,) how far an input has come at each row, never back on the way to a turn."""
    out = np.zeros(len(values))
    corners = [0, *turned, len(values) - 1]
    for a, b in pairwise(corners):
        ahead = np.sign(values[b] - values[a]) * (values[a : b + 1] - values[a])
        out[a : b + 1] = out[a] + np.maximum.accumulate(np.maximum(ahead, 0.0))
    return out


def _sigma(test: Test, noise: Noise, gauges: tuple[Gauge, ...]) -> Array:
    """(6,) of what is prescribed for each coordinate; zero where it is not known."""
    known = {gauge.name: noise.gauges[k] for k, gauge in enumerate(gauges)}
    out = [
        noise.displacement[k]
        if by == DISPLACEMENT
        else noise.wrench[k]
        if by == FORCE
        else known.get(by, 0.0)
        for k, by in enumerate(test.control)
    ]
    return np.nan_to_num(np.array(out, dtype=float))


def _part(data: Data, rows: NDArray[np.int64]) -> Data:
    parts = {f.name: getattr(data, f.name) for f in fields(data)}
    some: dict[str, Any] = {
        name: value[rows] for name, value in parts.items() if isinstance(value, np.ndarray)
    }
    return replace(data, **some)
