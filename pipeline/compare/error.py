"""Measured less predicted, model by model: by test, by channel, in sigmas and in units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pipeline.compare.record import ChannelError, Lost, TestError
from pipeline.inference.driving import column_name, unit_of
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.noise import Check, chi_square, lag_one
from pipeline.inference.predicted import Prediction
from pipeline.inference.residual import residual, whitening

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
FEWEST = 3


class _Whole(NamedTuple):
    """What is left of all rows; zeros: number of unknown zeros that were fitted."""

    whitened: Array
    units: Array
    sigma: Array
    zeros: int
    charged: float


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """A prediction against its load cases; parameters: how many numbers were fitted to these measurements.

    Two kinds of sigmas: totals and tests of noise use residuals that are whitened together, so that what an
    input's noise does to several channels at once counts once. A channel by itself is over its own standard
    deviation, in which the noise of the inputs stands too.
    """

    load_cases: LoadCases
    prediction: Prediction
    parameters: int = 0

    @cached_property
    def _whole(self) -> _Whole:
        weights = whitening(self.load_cases, self.prediction)
        found = residual(self.load_cases, self.prediction)
        whitened = np.where(self.load_cases.predicted, found.level, 0.0)
        if found.marginal is not None:
            whitened = whitened.copy()
            # What departures from what was written cost is in the residuals of the tests that show them.
            whitened[found.rows[:, 0], found.rows[:, 1]] = found.whitened
        factors = np.linalg.inv(weights.factors)
        units = np.einsum("rij,rj->ri", factors, whitened)
        sigma = np.sqrt(np.sum(factors**2, axis=2))
        return _Whole(whitened, units, sigma, found.zeros.shape[1], found.charged)

    @property
    def whitened(self) -> Array:
        """(R, C) less the unknown zeros of the tests that have them; zero where nothing is compared."""
        return self._whole.whitened

    @property
    def units(self) -> Array:
        """(R, C) measured less predicted in the channels' units, less the same zeros; no meaning in lost rows."""
        return self._whole.units

    @property
    def sigma(self) -> Array:
        """(R, C) standard deviation of each by itself."""
        return self._whole.sigma

    @property
    def kept(self) -> Mask:
        """(R, C) compared, and there is a prediction."""
        return np.asarray(self.load_cases.predicted & ~self.prediction.lost[:, None])

    @property
    def degrees(self) -> int:
        """Residuals of the fitted tests less fitted numbers and unknown zeros."""
        return (
            int(self.load_cases.predicted[self.load_cases.fitted].sum()) - self.parameters - self._whole.zeros
        )

    def rms(self, rows: Mask) -> float | None:
        """Whitened root mean square over rows (R,); None where nothing is compared."""
        compared = self.whitened[rows][self.load_cases.predicted[rows]]
        return float(np.sqrt(np.mean(compared**2))) if compared.size else None

    def size(self) -> Check | None:
        """Chi-square of the fitted tests, charges of rows beside their stops included; None without a degree of
        freedom."""
        flat = self.whitened[self.load_cases.fitted][self.load_cases.predicted[self.load_cases.fitted]]
        every = np.append(flat, np.sqrt(self._whole.charged))
        return chi_square(every, every.size - self.degrees) if self.degrees > 0 else None

    def order(self) -> Check | None:
        """Correlation along the load paths of the fitted tests; what was fitted makes it smaller, never larger."""
        series = [
            self.whitened[rows, channel]
            for rows, channel in self.series(self.load_cases.predicted & self.load_cases.fitted[:, None])
        ]
        enough = sum(len(each) for each in series) >= FEWEST and any(each.any() for each in series)
        return lag_one(series) if enough else None

    def series(self, mask: Mask) -> Iterator[tuple[NDArray[np.int64], int]]:
        """Rows of every test and channel in a mask (R, C), in the order of the steps."""
        for number in range(len(self.load_cases.campaign.tests)):
            own = mask & (self.load_cases.test == number)[:, None]
            for channel in np.flatnonzero(own.any(axis=0)):
                yield np.flatnonzero(own[:, channel]), int(channel)

    def channels(self, rows: Mask) -> dict[str, ChannelError]:
        """Error of every channel over rows (R,)."""
        out = {}
        gauges = self.load_cases.campaign.gauges
        for channel in np.flatnonzero((self.kept & rows[:, None]).any(axis=0)):
            own = self.kept[:, channel] & rows
            units = self.units[own, channel]
            ratio = units / self.sigma[own, channel]
            out[column_name(int(channel), gauges)] = ChannelError(
                sigmas=float(np.sqrt(np.mean(ratio**2))),
                rms=float(np.sqrt(np.mean(units**2))),
                unit=unit_of(int(channel)),
                readings=int(own.sum()),
            )
        return out

    def tests(self) -> tuple[TestError, ...]:
        """Error of every test."""
        found = []
        for number, test in enumerate(self.load_cases.campaign.tests):
            rows = self.load_cases.test == number
            found.append(
                TestError(
                    test=test.id,
                    q_deg=test.q_deg,
                    role=test.role,
                    rms=self.rms(rows),
                    lost=int(self.prediction.lost[rows].sum()),
                    channels=self.channels(rows),
                )
            )
        return tuple(found)

    def lost(self) -> tuple[Lost, ...]:
        """Tests of which rows are lost."""
        found = []
        for number, test in enumerate(self.load_cases.campaign.tests):
            rows = np.flatnonzero(self.load_cases.test == number)
            gone = np.flatnonzero(self.prediction.lost[rows])
            if not gone.size:
                continue
            said = self.prediction.reasons[int(rows[gone[0]])]
            reason, step = str(said), int(test.data.steps[gone[0]])
            to_the_end = gone.size == rows.size - gone[0]
            where = (
                f"from step {step} on"
                if to_the_end
                else f"in {gone.size} of {rows.size} rows, first step {step}"
            )
            sentence = f"{test.id}: no prediction {where}: {reason}"
            found.append(
                Lost(test=test.id, rows=gone.size, of=rows.size, step=step, reason=reason, sentence=sentence)
            )
        return tuple(found)
