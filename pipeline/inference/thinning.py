"""Fewer steps of the same loading, where a look is enough: the ends, the turns and some of what is between."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.load_cases import LoadCases
from pipeline.inference.predicted import Prediction
from pipeline.inference.settings import LOOK
from pipeline.inference.subsets import at_rows


def thinned(cases: LoadCases, start: Prediction | None) -> tuple[LoadCases, Prediction | None]:
    """About `LOOK.rows` of the fitted rows, and the start at them.

    What a law remembers depends on where a loading turned: of each test the first and the last row stay, and all turns.
    """
    every = int(np.sum(cases.fitted)) // LOOK.rows
    if every < 2:
        return cases, start
    given = np.nan_to_num(np.take_along_axis(cases.measured, cases.channels, axis=1))
    noise = cases.input_sigma[:, : given.shape[1]]
    tests = [np.flatnonzero(cases.fitted & (cases.test == k)) for k in range(len(cases.campaign.tests))]
    rows = np.concatenate(
        [rows[_kept(given[rows], noise[rows].max(axis=0), every)] for rows in tests if rows.size]
    )
    part = cases.only(rows)
    return part, None if start is None else at_rows(start, cases, part, rows)


def _kept(path: NDArray[np.float64], noise: NDArray[np.float64], every: int) -> NDArray[np.int64]:
    """Numbers of the rows of a path (N, k) that stay; what moves by little more than its noise (k,) is held."""
    size = np.ptp(path, axis=0)
    driven = size > LOOK.moves * noise
    ways = np.diff(path[:, driven] / size[driven], axis=0)
    turns = 1 + np.flatnonzero(np.sum(ways[1:] * ways[:-1], axis=1) < 0.0)
    return np.unique(np.concatenate([np.arange(0, len(path), every), turns, [len(path) - 1]]))
