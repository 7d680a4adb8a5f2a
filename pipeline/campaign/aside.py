"""Readings that do not count, and those that count whatever looks at them: by hand, in `[[tests]]`.

A row where a prescribed reading is set aside has nothing that is compared, for what was done there is not known; it
stays on the way, with what was prescribed before and after.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

import numpy as np

from pipeline.campaign.control import control_channels
from pipeline.campaign.model import Gauge, Test
from pipeline.campaign.names import channel_columns
from pipeline.toml.complaints import Complaints, shown


def without(test: Test, cells: Collection[tuple[int, int]], gauges: tuple[Gauge, ...]) -> Test | None:
    """The test without these readings, by row and channel; None where no other reading of what was prescribed is
    left."""
    data = test.data
    readings = data.readings
    controls = control_channels(test, gauges)
    compared = np.setdiff1d(np.arange(readings.shape[1]), controls)
    for row, channel in cells:
        if channel not in controls:
            readings[row, channel] = np.nan
            continue
        there = np.flatnonzero(np.isfinite(readings[:, channel])).tolist()
        good = np.array([k for k in there if (k, channel) not in cells], dtype=int)
        if not good.size:
            return None
        readings[row, channel] = np.interp(row, good, readings[good, channel])
        readings[row, compared] = np.nan
    data = replace(data, displacement=readings[:, :6], wrench=readings[:, 6:12], gauges=readings[:, 12:])
    return replace(test, data=data)


def by_hand(test: Test, gauges: tuple[Gauge, ...], line: int | None, complaints: Complaints) -> Test:
    """The test without what `set_aside` names; complaints about readings that are not there. line: of the test."""
    place = f"test {shown(test.id)}, "
    cells = set(_cells(test, test.set_aside, gauges, (f"{place}set_aside", line), complaints))
    for _ in _cells(test, test.keep, gauges, (f"{place}keep", line), complaints):
        continue
    if both := sorted(set(test.set_aside) & set(test.keep)):
        step, column = both[0]
        said = f"names {column} of step {step}, which is set aside; allowed is one of the two"
        complaints.add(f"{place}keep", said, line)
    found = without(test, cells, gauges)
    if found is None:
        said = "leaves no reading of what was prescribed, allowed is to leave the test out"
        complaints.add(f"{place}set_aside", said, line)
    return found or test


def _cells(
    test: Test,
    named: tuple[tuple[int, str], ...],
    gauges: tuple[Gauge, ...],
    where: tuple[str, int | None],
    complaints: Complaints,
) -> Iterator[tuple[int, int]]:
    """Row and channel of each; where: place and line for a complaint."""
    names, readings = channel_columns(gauges), test.data.readings
    place, line = where
    for step, column in named:
        rows = np.flatnonzero(test.data.steps == step)
        if column not in names:
            complaints.add(place, f"{shown(column)} is no column of readings", line)
        elif not rows.size:
            complaints.add(place, f"step {step} is not in the test, its steps are {_span(test)}", line)
        elif not np.isfinite(readings[rows[0], names.index(column)]):
            complaints.add(place, f"{column} was not read in step {step}", line)
        else:
            yield int(rows[0]), names.index(column)


def _span(test: Test) -> str:
    steps = test.data.steps
    return f"{steps[0]} to {steps[-1]}"
