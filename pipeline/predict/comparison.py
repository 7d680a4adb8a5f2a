"""Predicted beside measured in the terms of ASME V&V 20-2009: comparison error E and validation uncertainty, by column.

E = S - D, prediction less reading; u_val² = u_num² + u_input² + u_D². u_input: of the fitted parameters and of what is
written about the rig. u_D: of the readings and of what was prescribed. u_num, of the numerical solution, is not
estimated here and left out: the equilibria are solved to rounding, and the error of a K_b that comes from a mesh is a
tolerance of the rig.

Area metric: where the law of each reading is F, F(D) is uniform if the predictions are right; the area is that between
the empirical distribution of F(D) and the uniform one, pooled over load steps (S. Ferson, W. L. Oberkampf, L. Ginzburg,
Comput. Methods Appl. Mech. Engrg. 197, 2008, 2408-2430, the u-pooling).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

from pipeline.campaign.names import channel_columns
from pipeline.predict.predicting import Predicted
from pipeline.predict.record import ColumnComparison

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def comparison(it: Predicted, some: Mask) -> tuple[ColumnComparison, ...]:
    """Of some of the readings (R, C) that were made."""
    return tuple(_columns(it, some))


def _columns(it: Predicted, some: Mask) -> Iterator[ColumnComparison]:
    bands = it.bands
    for k, name in enumerate(channel_columns(it.cases.campaign.gauges)):
        own = some[:, k]
        if not own.any():
            continue
        error = (bands.value - it.measured)[own, k]
        model, data = bands.model[own, k], bands.noise[own, k]
        whole = np.hypot(model, data)
        seen = whole > 0.0
        yield ColumnComparison(
            column=name,
            readings=int(own.sum()),
            error=float(np.mean(error)),
            error_rms=_rms(error),
            u_input=_rms(model),
            u_data=_rms(data),
            u_val=_rms(whole),
            area=area(ndtr(-error[seen] / whole[seen])) if seen.any() else None,
        )


def area(levels: Array) -> float:
    """Between the empirical distribution of levels (N,), each 0 to 1, and the uniform one: 0 to 0.5."""
    ordered, count = np.sort(levels), len(levels)
    edges = np.concatenate([[0.0], ordered, [1.0]])
    heights = np.arange(count + 1) / count
    total = 0.0
    for low, high, height in zip(edges[:-1], edges[1:], heights, strict=True):
        # The integral of abs(height - u) over u from low to high.
        if low < height < high:
            total += 0.5 * ((height - low) ** 2 + (high - height) ** 2)
        else:
            total += abs(0.5 * (low + high) - height) * (high - low)
    return float(total)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
