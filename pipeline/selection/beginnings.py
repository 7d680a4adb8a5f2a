"""Channels that begin far from nothing where the model expects nothing of them: not zeroed, or a rig that is off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pipeline.inference.fit import Fit
from pipeline.selection.criteria import Criteria


@dataclass(frozen=True)
class Beginning:
    """channel: its number. value: first reading of the first of these tests, in the channel's unit. sigmas: that many
    of the sensor's. tests: ids of those that begin so, of: how many read the channel."""

    channel: int
    value: float
    sigmas: float
    tests: tuple[str, ...]
    of: int


def beginnings(found: Fit, criteria: Criteria) -> tuple[Beginning, ...]:
    """Of every channel that is predicted, about a fit of the model as it is; tests with zeros of their own aside."""
    whole, expected = found.residual.load_cases, found.prediction.as_measured
    firsts = [(k, int(whole.first[k])) for k in range(len(whole.campaign.tests))]
    out = []
    for channel in np.flatnonzero(whole.sigma > 0.0):
        sigma = float(whole.sigma[channel])
        read = [
            (k, row) for k, row in firsts if whole.predicted[row, channel] and not whole.loose[k, channel]
        ]
        far = []
        for k, row in read:
            value = float(whole.measured[row, channel])
            nothing = abs(expected[row, channel]) < criteria.zero_alone * abs(value)
            if nothing and abs(value) > criteria.doctor_plain * sigma:
                far.append((whole.campaign.tests[k].id, value))
        if far:
            value = far[0][1]
            out.append(
                Beginning(int(channel), value, abs(value) / sigma, tuple(id for id, _ in far), len(read))
            )
    return tuple(out)
