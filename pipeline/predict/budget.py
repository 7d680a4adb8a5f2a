"""What limits a parameter: the share of its variance that each sensor, and each number that is written, puts in.

About the fit the estimate of the parameters follows the whitened residual e by theta = M e, so that independent errors
of the readings put in the sum of (M c)² over the readings of a sensor, c the column of one error. What was written
enters by its prior: M_0 u_0, u_0 ~ N(0, 1) by which what is written is off (Guide to the Expression of Uncertainty in
Measurement, JCGM 100:2008, section 5.1).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import channel_columns
from pipeline.predict.posterior import Posterior
from pipeline.predict.predicting import Fitted
from pipeline.predict.record import Budget, Source
from pipeline.selection.adequacy.reading_errors import ReadingErrors

Array = NDArray[np.float64]
Kind = Literal["sensor", "tolerance"]
MOST, LEAST = 4, 0.01
"""Sources that are listed of a parameter, at most; share of one, at least."""


def budget(it: Fitted, posterior: Posterior) -> tuple[Budget, ...]:
    """Of every parameter that was fitted."""
    if not posterior.count or it.untested:
        return ()
    shares = variances(it, posterior)
    total = np.sum(list(shares.values()), axis=0)
    out = []
    for k, free in enumerate(posterior.model.free):
        sources = [
            Source(name=name, kind=kind, share=float(own[k] / total[k]))
            for (name, kind), own in shares.items()
            if total[k] > 0.0
        ]
        largest = sorted(sources, key=lambda source: -source.share)[:MOST]
        out.append(
            Budget(
                parameter=free.name,
                std=float(posterior.std[k]),
                unit=free.parameter.unit,
                sources=tuple(source for source in largest if source.share >= LEAST),
            )
        )
    return tuple(out)


def variances(it: Fitted, posterior: Posterior) -> dict[tuple[str, Kind], Array]:
    """(P,) that each source puts in, in typical sizes squared, by its name and kind; without the weak prior of
    parameters they sum to the variances of the posterior."""
    return _sensors(it, posterior) | _written(posterior)


def _sensors(it: Fitted, posterior: Posterior) -> dict[tuple[str, Kind], Array]:
    """(P,) variances by sensor, in typical sizes of the parameters squared."""
    found = it.fit
    residual = found.residual
    slopes = residual.without_zeros(residual.slopes) * posterior.sizes
    columns = [slopes] + ([residual.without_zeros(residual.nominal)] if posterior.numbers else [])
    follows = (posterior.covariance @ np.concatenate(columns, axis=1).T)[: posterior.count]
    errors = ReadingErrors.of(found)
    place = np.full(residual.values.shape, -1)
    place[residual.rows[:, 0], residual.rows[:, 1]] = np.arange(len(residual.rows))
    names = channel_columns(residual.load_cases.campaign.gauges)
    out: dict[tuple[str, Kind], Array] = {}
    for row in np.flatnonzero(errors.there.any(axis=1)):
        kept = np.flatnonzero(place[row] >= 0)
        moved = follows[:, place[row, kept]] @ errors.columns[row][kept]
        for m in np.flatnonzero(errors.there[row]).tolist():
            key: tuple[str, Kind] = (names[int(errors.channels[row, m])], "sensor")
            out[key] = out.get(key, np.zeros(posterior.count)) + (moved[:, m] / posterior.factor) ** 2
    return out


def _written(posterior: Posterior) -> dict[tuple[str, Kind], Array]:
    """(P,) variances by what is written."""
    entered = posterior.covariance[: posterior.count, posterior.count :]
    return {(each.name, "tolerance"): entered[:, k] ** 2 for k, each in enumerate(posterior.numbers)}
