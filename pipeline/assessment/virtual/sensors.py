"""What faulty sensors read of a bench: done to the true readings, beside all that the model of a fault knows.

Errors are named as in the catalogue, sensor_gain@fy_N.share; formulas are written here again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Gauge
from pipeline.campaign.names import channel_columns
from pipeline.errors import InputError
from pipeline.parameter_names import parted

Array = NDArray[np.float64]
AT = "@"
TOLD_APART = {"mm": 1e-3, "rad": 2e-5, "N": 1.0, "Nmm": 50.0}
"""By sensors of the paper's bench: cross-talk is a share of what the one tells apart in that of the other."""


def of_sensors(hidden: Mapping[str, float]) -> dict[str, float]:
    """Hidden errors that are faults of sensors."""
    return {path: value for path, value in hidden.items() if AT in path}


def as_read(
    every: Sequence[Array], hidden: Mapping[str, float], gauges: tuple[Gauge, ...] = ()
) -> list[Array]:
    """Readings (N, C) of every test with the faults of all sensors. InputError for a fault or column that is none."""
    names = channel_columns(gauges)
    faults: dict[str, dict[str, float]] = {}
    for path, value in of_sensors(hidden).items():
        effect, parameter = parted(path)
        faults.setdefault(effect, {})[parameter] = value
    read = [one.copy() for one in every]
    for effect, values in faults.items():
        kind, _, column = effect.partition(AT)
        column, _, other = column.partition("<")
        if column not in names or (other and other not in names):
            raise InputError(f"{effect}: there is no such column, allowed are {', '.join(names)}")
        mine = names.index(column)
        theirs = names.index(other) if other else mine
        for k, error in enumerate(
            _errors(kind, values, [one[:, (mine, theirs)] for one in every], column, other)
        ):
            read[k][:, mine] += error
    return read


def _errors(
    kind: str, values: Mapping[str, float], readings: list[Array], column: str, other: str
) -> list[Array]:
    """Of each test; readings (N, 2) of the column and of the one that it answers to."""
    if kind == "sensor_gain":
        return [values["share"] * one[:, 0] for one in readings]
    if kind == "sensor_cross_talk":
        own, theirs = (TOLD_APART[name.rsplit("_", 1)[1]] for name in (column, other))
        return [values["share"] * own / theirs * one[:, 1] for one in readings]
    if kind == "sensor_drift":
        ends = np.cumsum([0, *(len(one) for one in readings)])
        slope = values["size"] / (ends[-1] - 1)
        return [slope * np.arange(a, b) for a, b in pairwise(ends)]
    if kind == "sensor_settling":
        return [
            values["size"] * 0.5 ** (np.arange(len(one)) / (values["steps"] * np.log(2.0)))
            for one in readings
        ]
    if kind == "sensor_lag":
        return [_late(one[:, 0], values["keeps"]) - one[:, 0] for one in readings]
    if kind == "sensor_backlash":
        return [_dragged(one[:, 0], values["gap"], values["start"]) - one[:, 0] for one in readings]
    raise InputError(f"{kind} is no fault of a sensor that the bench has")


def _late(values: Array, keeps: float) -> Array:
    """As the sum of what all earlier steps have left: sum of (1 - k) k^j y_(n-j)."""
    count = len(values)
    weights = (1.0 - keeps) * keeps ** np.arange(count)
    return np.asarray(np.convolve(values, weights)[:count])


def _dragged(values: Array, gap: float, start: float) -> Array:
    """The greatest that the near side of the gap has reached at any step, at most the least of its far side since."""
    near, far = values - gap * (1.0 - start) / 2.0, values + gap * (1.0 + start) / 2.0
    near[0] = far[0] = values[0]
    out = np.empty_like(values)
    for n in range(len(values)):
        least = np.minimum.accumulate(far[n::-1])[::-1]
        out[n] = np.minimum(near[: n + 1], least).max()
    return out
