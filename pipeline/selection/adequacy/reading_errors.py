"""What an error of one reading, of one standard deviation, does to the whitened residual of its row."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.residual import Residual, whitening

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class ReadingErrors:
    """What an error of each reading of a row does to the whitened residual of the row.

    columns: (R, C, M) in sigmas of the reading, first of the C channels, then of the six controlled ones. there: (R, M)
    which of them are readings. channels: (R, M).
    """

    columns: Array
    there: Mask
    channels: NDArray[np.int64]

    @classmethod
    def of(cls, found: Fit) -> ReadingErrors:
        """Of the rows of a fit."""
        it = found.residual
        whole = it.load_cases
        factors, used = whitening(whole, found.prediction).factors, _used(it)
        count = whole.measured.shape[1]
        sigma = np.where(whole.spread > 0.0, whole.spread, 0.0)
        read = factors * np.where(used, sigma, 0.0)[:, None, :]
        through = np.where(used[..., None], found.prediction.by_inputs[..., :6], 0.0)
        given = -np.einsum("rij,rjk->rik", factors, through) * whole.input_sigma[:, None, :6]
        columns = np.where(used[..., None], np.concatenate([read, given], axis=-1), 0.0)
        apart = whole.fitted & ~found.prediction.lost & ~it.undecided & ~(it.charge > 0.0)
        prescribed = (whole.input_sigma[:, :6] > 0.0) & np.any(given != 0.0, axis=1)
        there = np.concatenate([used, prescribed], axis=1) & apart[:, None]
        channels = np.hstack([np.broadcast_to(np.arange(count), whole.measured.shape), whole.channels])
        return cls(columns, there, channels)


def _used(it: Residual) -> Mask:
    return np.asarray(it.load_cases.predicted & it.load_cases.fitted[:, None])
