"""Noise of the sensors: how far a reading may be from what is there."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def _none() -> Array:
    return np.zeros(0)


@dataclass(frozen=True, eq=False)
class Noise:
    """One standard deviation of every sensor; NaN where the campaign does not say it.

    displacement: (6,) mm, rad. wrench: (6,) N, N·mm. gauges: (G,) mm. temperature: K. of_reading: (12 + G,) share of
    the reading by which it scatters as well; gain: (12 + G,) standard deviation of the sensor's gain from 1, the same
    in all its readings. Both are zero where they are shorter.
    """

    displacement: Array
    wrench: Array
    gauges: Array
    temperature: float = np.nan
    of_reading: Array = field(default_factory=_none)
    gain: Array = field(default_factory=_none)

    @property
    def sigmas(self) -> Array:
        """(12 + G,) of all channels, at a reading of zero."""
        return np.concatenate([self.displacement, self.wrench, self.gauges])

    @property
    def shares(self) -> Array:
        """(12 + G,) of the reading."""
        return _filled(self.of_reading, 12 + len(self.gauges))

    @property
    def gains(self) -> Array:
        """(12 + G,) standard deviations."""
        return _filled(self.gain, 12 + len(self.gauges))

    def of(self, sigmas: Array) -> Noise:
        """The same with other sigmas (12 + G,) of the channels."""
        return replace(self, displacement=sigmas[:6], wrench=sigmas[6:12], gauges=sigmas[12:])

    def times(self, factors: Array) -> Noise:
        """So many times as much scatter (12 + G,) of the channels; gains as they are."""
        return replace(self.of(self.sigmas * factors), of_reading=self.shares * factors)

    def spread(self, readings: Array) -> Array:
        """(N, 12 + G) standard deviation of each of the readings (N, 12 + G) of one test, in their order.

        The share is one of what is there, which is read with that noise: neighbours help to tell it.
        """
        if not np.any(self.shares):
            return np.broadcast_to(self.sigmas, readings.shape)
        return np.hypot(self.sigmas, self.shares * _level(readings))


def _filled(values: Array, count: int) -> Array:
    out = np.zeros(count)
    some = min(count, len(values))
    out[:some] = values[:some]
    return out


def _level(readings: Array) -> Array:
    """Size of readings (N, C) by those before and after, where both are there; zero where there is none."""
    own = np.nan_to_num(readings)
    out = np.abs(own)
    if len(own) > 2:
        both = np.isfinite(readings[:-2]) & np.isfinite(readings[2:])
        around = 0.25 * (own[:-2] + own[2:]) + 0.5 * own[1:-1]
        out[1:-1] = np.where(both, np.abs(around), out[1:-1])
    return out
