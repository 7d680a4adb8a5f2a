"""From the table of cells to the data of each test, and what is wrong with them."""

from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pipeline.campaign.head import Description, Head
from pipeline.campaign.measured import Measured
from pipeline.campaign.model import Array, Data
from pipeline.campaign.names import DISPLACEMENTS, PLACES, TEMPERATURE, WRENCHES, gauge_column
from pipeline.campaign.sheet import numbers
from pipeline.toml.complaints import Complaints, lines_named, shown
from pipeline.toml.spelling import unknown_name

_DIGITS = 9


def measured_of(frame: pd.DataFrame, gauges: Iterable[str], complaints: Complaints) -> Measured:
    """The readings of a table of cells; complaints about those that are none."""
    columns = (*DISPLACEMENTS, *WRENCHES, *map(gauge_column, gauges), TEMPERATURE, *PLACES)
    values = {c: numbers(frame, c, complaints) for c in columns if c in frame.columns}
    tests = tuple(frame["test"].str.strip())
    lines = frame.index.to_numpy(dtype=np.int64)
    return Measured(tests, steps_of(list(frame["step"]), lines.tolist(), complaints), lines, values)


def data_by_test(measured: Measured, description: Description, complaints: Complaints) -> dict[str, Data]:
    """Data of every test that has rows, by its id; complaints about rows and steps that make no sense."""
    names = [gauge_column(gauge.name) for gauge in description.gauges]
    columns = (*DISPLACEMENTS, *WRENCHES, *names, TEMPERATURE)
    values = np.column_stack([measured.of(column) for column in columns])
    lines = measured.lines
    rows = _rows_by_test(measured, [head.id for head in description.heads], complaints)
    found = {}
    for head in description.heads:
        mine = rows.get(head.id)
        if mine is None:
            complaints.add(f"test {shown(head.id)}", "has no rows, allowed are one or more")
            continue
        steps = np.arange(mine.size, dtype=float) if measured.steps is None else measured.steps[mine]
        _rising(head, steps, lines[mine], complaints)
        temperature = values[mine, -1]
        found[head.id] = Data(
            np.nan_to_num(steps).astype(np.int64),
            values[mine, :6],
            values[mine, 6:12],
            values[mine, 12:-1],
            None if np.isnan(temperature).all() else temperature,
            lines[mine],
            measured.from_first,
        )
    return found


def _rows_by_test(
    measured: Measured, known: list[str], complaints: Complaints
) -> dict[str, NDArray[np.int64]]:
    """Numbers of the rows of each known test, in their order."""
    places = pd.Series(np.arange(len(measured.tests)), index=measured.lines)
    found = {}
    for name, mine in places.groupby(np.array(measured.tests, dtype=object), sort=False):
        if name in known:
            found[str(name)] = mine.to_numpy(dtype=np.int64)
            continue
        where = lines_named([int(line) for line in mine.index])
        if name:
            said = f"names test {shown(str(name))}, which campaign.toml does not have; {unknown_name(str(name), known)}"
        else:
            said = "is empty, allowed is the id of a test"
        complaints.add("column test", said + where, int(mine.index[0]))
    return found


def steps_of(cells: Sequence[str], lines: Sequence[int], complaints: Complaints) -> Array:
    """(N,) step numbers, NaN where the cell is none."""
    steps = np.full(len(cells), np.nan)
    for k, cell in enumerate(cells):
        text = cell.strip()
        if text.isascii() and text.isdigit() and len(text) <= _DIGITS:
            steps[k] = int(text)
        else:
            complaints.add(
                "column step", f"holds {shown(text)}, allowed is a whole number from 0", int(lines[k])
            )
    return steps


def _rising(head: Head, steps: Array, lines: NDArray[np.int64], complaints: Complaints) -> None:
    """Complaints about steps that go back; equal steps, one after the other, are repeats of one reading."""
    place = f"test {shown(head.id)}"
    highest = -1.0
    for step, line in zip(steps.tolist(), lines.tolist(), strict=True):
        if step < highest:
            said = f"step {step:.0f} comes after step {highest:.0f}, allowed is the order of the measurement"
            complaints.add(place, said, line)
        highest = max(highest, step) if step == step else highest
