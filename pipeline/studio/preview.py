"""What a table says once it is read: its first rows in N, mm and rad, so that axes and signs can be checked by eye."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from pipeline.campaign import Campaign, Test
from pipeline.campaign.names import channel_columns
from reports.formats import DASH, number

ROWS = 6


@dataclass(frozen=True)
class Preview:
    """head: columns that any test reads. rows: test, step and readings, as text. said: of each test, and remarks."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    said: tuple[str, ...]


def preview_of(it: Campaign) -> Preview:
    """The first rows of each test."""
    names = channel_columns(it.gauges)
    read = [k for k in range(len(names)) if any(_any(test, k) for test in it.tests)]
    rows = tuple(
        (test.id, str(int(test.data.steps[row])), *(_said(float(test.data.readings[row, k])) for k in read))
        for test in it.tests
        for row in range(min(len(test.data.steps), max(2, ROWS // len(it.tests))))
    )
    said = tuple(f"{test.id}: {len(test.data.steps)} load steps" for test in it.tests)
    return Preview(("test", "step", *(names[k] for k in read)), rows, (*said, *it.remarks))


def _any(test: Test, channel: int) -> bool:
    return any(isfinite(float(value)) for value in test.data.readings[:, channel])


def _said(value: float) -> str:
    return number(value, 4) if isfinite(value) else DASH
