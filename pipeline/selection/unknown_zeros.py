"""A sensor that was not zeroed: one constant of one channel, in all tests or in one, beside a set of effects.

A constant of one channel is first a zero: a dial that starts at 2.95 mm is no wrong dimension. The constant of what
controls a coordinate acts through the mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.inference.driving import column_name, unit_of
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.residual import whitening
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import PATTERNS
from pipeline.selection.adequacy.patterns import acting
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import with_readings
from vjm.effects.sized import LENGTH

Array = NDArray[np.float64]
FARTHEST = {"mm": LENGTH, "rad": 1.0}
"""Zero of a prescribed displacement or rotation, at most, on the bench of the paper: it acts through the mechanism,
whose tangent says nothing of one as long as the linkage. What is only read may have any zero."""


@dataclass(frozen=True)
class Zero:
    """A constant that a channel reads too much. tests: ids of those it is in. value, std: in `unit`. gain: chi-square
    that it takes off, after the numbers of the fit took their part; looks: how many constants were looked at. unloaded:
    whether the model expects nothing of the channel there, so that the readings are nothing but this constant."""

    column: str
    tests: tuple[str, ...]
    everywhere: bool
    value: float
    std: float
    unit: str
    gain: float
    looks: int
    unloaded: bool

    @property
    def words(self) -> str:
        """As an engineer would ask."""
        where = "" if self.everywhere else f" in {self.tests[0]}"
        return f'{self.column} starts at {self.value:.3g} {self.unit}{where}: zero = "fitted"?'


def zeros(found: Fit, criteria: Criteria) -> list[Zero]:
    """Every constant that the readings can tell beside the numbers of a fit, the one that explains most first."""
    whole = found.residual.load_cases
    named = list(_constants(whole))
    if not named:
        return []
    used = whole.predicted & whole.fitted[:, None]
    weights = whitening(whole, found.prediction)
    taken = _taken(found)
    out = []
    for channel in dict.fromkeys(channel for channel, _ in named):
        own = [tests for other, tests in named if other == channel]
        errors = np.stack([np.isin(whole.test, tests).astype(float) for tests in own], axis=-1)
        errors[found.prediction.lost] = 0.0
        columns = found.residual.weakened(weights.apply(acting(found, channel, errors))[used])
        left = columns - taken @ (taken.T @ columns)
        sizes = np.linalg.norm(left, axis=0)
        seen = sizes > PATTERNS.left * np.maximum(np.linalg.norm(columns, axis=0), TINY)
        farthest = _farthest(whole, channel)
        for k in np.flatnonzero(seen):
            value = float(left[:, k] @ found.whitened / sizes[k] ** 2)
            if abs(value) > farthest:
                continue
            everywhere = own[k] == max(own, key=len)
            out.append(
                _zero(
                    found, channel, own[k], everywhere, (value, 1.0 / float(sizes[k])), len(named), criteria
                )
            )
    return sorted(out, key=lambda it: -it.gain)


def left_beside(found: Fit, zero: Zero) -> float:
    """Chi-square that a fit leaves beside a zero, its numbers fitted anew, to first order."""
    return float(np.sum(found.whitened**2) - np.sum((_taken(found).T @ found.whitened) ** 2)) - zero.gain


def taken_out(campaign: Campaign, zero: Zero) -> Campaign:
    """A campaign whose readings are without a constant."""
    less = np.zeros(12 + len(campaign.gauges))
    less[[column_name(k, campaign.gauges) for k in range(less.size)].index(zero.column)] = zero.value
    own = replace(campaign, tests=tuple(test for test in campaign.tests if test.id in zero.tests))
    new = {test.id: test for test in with_readings(own, lambda values: values - less).tests}
    return replace(campaign, tests=tuple(new.get(test.id, test) for test in campaign.tests))


def _taken(found: Fit) -> Array:
    """(N, r) orthonormal basis of what the numbers of a fit and unknown zeros can make."""
    return basis(np.hstack([found.jacobian, found.residual.flat(found.residual.offsets)]))


def _farthest(whole: LoadCases, channel: int) -> float:
    """In the channel's unit."""
    if not np.any(whole.channels == channel):
        return np.inf
    unit = unit_of(channel)
    return FARTHEST.get(unit, np.inf) * whole.campaign.rig.scale.of(unit)


def _zero(
    found: Fit,
    channel: int,
    tests: tuple[int, ...],
    everywhere: bool,
    estimate: tuple[float, float],
    looks: int,
    criteria: Criteria,
) -> Zero:
    """estimate: the constant and its standard error."""
    whole, expected = found.residual.load_cases, found.prediction.as_measured
    value, std = estimate
    ids = tuple(whole.campaign.tests[k].id for k in tests)
    unit = unit_of(channel).replace("Nmm", "N·mm")
    rows = np.isin(whole.test, tests) & whole.predicted[:, channel]
    unloaded = bool(rows.any() and np.all(np.abs(expected[rows, channel]) < criteria.zero_alone * abs(value)))
    name = column_name(channel, whole.campaign.gauges)
    return Zero(name, ids, everywhere, value, std, unit, (value / std) ** 2, looks, unloaded)


def _constants(whole: LoadCases) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Channel and numbers of the tests of every constant: all tests in which the channel was read from its own zero,
    and each of several alone."""
    fitted = [k for k, test in enumerate(whole.campaign.tests) if test.role == "fit"]
    for channel in np.flatnonzero(np.isfinite(whole.measured).any(axis=0) & (whole.sigma > 0.0)):
        mine = [
            k
            for k in fitted
            if not whole.loose[k, channel] and np.isfinite(whole.measured[whole.test == k, channel]).any()
        ]
        if mine:
            yield int(channel), tuple(mine)
        if len(mine) > 1:
            for k in mine:
                yield int(channel), (k,)
