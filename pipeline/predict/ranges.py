"""What the fitted tests covered, and what of a row lies beyond it: there a model extrapolates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Test
from pipeline.campaign.control import control_channels
from pipeline.campaign.names import PLACES, TEMPERATURE, channel_columns
from reports.quantities import short

Array = NDArray[np.float64]
Span = tuple[float, float]
ROUNDING = 1e-9
"""Of the largest number in a unit, below which another in that unit is rounding."""
EDGE = 0.01
"""Of a range, by which a number must lie beyond it: readings at its edge have noise."""


@dataclass(frozen=True)
class Ranges:
    """Least and greatest of what was fitted, by column; angles: of the bars, degrees."""

    spans: dict[str, Span]
    angles: Span
    tables: tuple[str, ...]

    @classmethod
    def of(cls, campaign: Campaign) -> Ranges:
        """Of the tests that may be fitted; of all where none may."""
        tests = [test for test in campaign.tests if test.role == "fit"] or list(campaign.tests)
        found: dict[str, list[float]] = {}
        for test in tests:
            for column, values in _columns(test, campaign):
                there = values[np.isfinite(values)]
                found.setdefault(column, []).extend(there.tolist())
        spans = {column: (min(values), max(values)) for column, values in found.items() if values}
        angles = [test.q_deg for test in tests]
        return cls(spans, (min(angles), max(angles)), tuple({repr(test.rig.keys()) for test in tests}))

    def of_test(self, test: Test) -> Iterator[str]:
        """What of a test's posture and rig lies beyond."""
        if _beyond(test.q_deg, self.angles):
            yield _said("q_deg", test.q_deg, self.angles)
        for column, value in zip(PLACES, test.rig.point or (), strict=False):
            if column in self.spans and _beyond(value, self.spans[column]):
                yield _said(column, value, self.spans[column])
        if repr(test.rig.keys()) not in self.tables:
            yield "the rig has other values than any that was fitted"

    def of_readings(self, columns: dict[str, float]) -> Iterator[str]:
        """What of the inputs and predicted readings of a row lies beyond, by column."""
        for column, value in columns.items():
            span = self.spans.get(column)
            # What nothing moves is predicted as zero or as the rounding of what others of its unit are.
            tiny = ROUNDING * self._largest.get(column.rpartition("_")[2], 0.0)
            if span is None and abs(value) > tiny:
                yield f"{column} {short(value)}, in no fitted test"
            elif span is not None and _beyond(value, (span[0] - tiny, span[1] + tiny)):
                yield _said(column, value, span)

    @cached_property
    def _largest(self) -> dict[str, float]:
        """By unit, as columns end, the size of what was fitted in it."""
        out: dict[str, float] = {}
        for column, (low, high) in self.spans.items():
            unit = column.rpartition("_")[2]
            out[unit] = max(abs(low), abs(high), out.get(unit, 0.0))
        return out


def _columns(test: Test, campaign: Campaign) -> Iterator[tuple[str, Array]]:
    names = channel_columns(campaign.gauges)
    readings = test.data.readings.copy()
    # What is prescribed and was not read is zero.
    for channel, values in zip(
        control_channels(test, campaign.gauges), test.inputs(campaign.gauges).T, strict=True
    ):
        readings[:, channel] = values
    yield from zip(names, readings.T, strict=True)
    if test.data.temperature is not None:
        yield TEMPERATURE, test.data.temperature
    for column, value in zip(PLACES, test.rig.point or (), strict=False):
        yield column, np.array([value])


def _beyond(value: float, span: Span) -> bool:
    low, high = span
    margin = EDGE * (high - low) + ROUNDING * max(abs(low), abs(high))
    return not low - margin <= value <= high + margin


def _said(name: str, value: float, span: Span) -> str:
    low, high = span
    return f"{name} {short(value)}, fitted {short(low)} to {short(high)}"
