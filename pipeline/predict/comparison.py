"""Predicted beside measured in the terms of ASME V&V 20-2009: comparison error E and validation uncertainty, by column.

E = S - D, prediction less reading; u_val² = u_num² + u_input² + u_D². u_D: of the readings and of what was prescribed.
u_num: of the computation of K_b, by its meshes and by how its ends were tied, where the rig takes it `bar_from` a
result; equilibria are solved to rounding. u_input: of the rest of what is written about the rig, and of the parameters.

The two are one in a fit: what is written enters the prediction by A u_0, u_0 ~ N(0, 1) what each number is off by, in
its tolerance, and A what is left of that after the fit. Of the variance of a number the share (band / tolerance)² is
numerical, so that u_num² = sum of (A band / tolerance)².

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
    num = np.minimum(numerical(it), bands.model)
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
            u_num=_rms(num[own, k]),
            u_input=_rms(np.sqrt(np.maximum(model**2 - num[own, k] ** 2, 0.0))),
            u_data=_rms(data),
            u_val=_rms(whole),
            area=area(ndtr(-error[seen] / whole[seen])) if seen.any() else None,
        )


def numerical(it: Predicted) -> Array:
    """(R, C) standard uncertainty of the predictions by the computation of the bar, in the units of the columns."""
    posterior, campaign = it.tangent.posterior, it.cases.campaign
    shares = np.zeros(len(posterior.numbers))
    for k, each in enumerate(posterior.numbers):
        key = each.tolerance.keys[each.parameter.name]
        band, whole = campaign.computed_bands.get(key, 0.0), campaign.tolerance.get(key, 0.0)
        if band > 0.0 and whole > 0.0:
            shares[k] = min(band / whole, 1.0)
    slopes = np.concatenate([it.tangent.found.by_free * posterior.sizes, it.tangent.by_nominal], axis=-1)
    left = slopes @ posterior.covariance[:, posterior.count :]
    return np.asarray(np.sqrt(np.sum((left * shares) ** 2, axis=-1)))


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
