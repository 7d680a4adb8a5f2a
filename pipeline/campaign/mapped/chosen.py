"""Which rows of a table are used, and whether they are in the order of time."""

from __future__ import annotations

from datetime import datetime, time

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.complaints import Complaints, shown
from pipeline.campaign.long_tests import PART, turns
from pipeline.campaign.mapped.grid import Cell
from pipeline.campaign.mapped.layout import Layout
from pipeline.campaign.measured import Measured


def fewer(measured: Measured, every: int) -> Measured:
    """One row of so many, and of each test the first, the last, and those where a reading turned by more than a part of
    its travel."""
    if every == 1:
        return measured
    names = np.array(measured.tests, dtype=object)
    kept = np.concatenate(
        [_kept(measured, np.flatnonzero(names == n), every) for n in dict.fromkeys(measured.tests)]
    )
    rows = np.sort(kept)
    return Measured(
        tuple(measured.tests[k] for k in rows),
        None if measured.steps is None else measured.steps[rows],
        measured.lines[rows],
        {column: values[rows] for column, values in measured.values.items()},
    )


def _kept(measured: Measured, mine: NDArray[np.int64], every: int) -> NDArray[np.int64]:
    chosen = {0, len(mine) - 1, *range(0, len(mine), every)}
    for values in measured.values.values():
        own = values[mine]
        read = np.flatnonzero(np.isfinite(own))
        if read.size > 2:
            travel = float(np.ptp(own[read]))
            chosen |= {int(read[k]) for k in turns(own[read], PART * travel)} if travel else set()
    return mine[sorted(chosen)]


def in_order(layout: Layout, column: str | None, tests: tuple[str, ...], complaints: Complaints) -> None:
    """A complaint where the time of a test goes back: the order of rows is that of the loading. A clock without a date
    may pass midnight."""
    if column is None:
        return
    if column not in layout.names:
        complaints.add("", f"has no column {shown(column)}, which time_column names")
        return
    before: dict[str, float] = {}
    for test, cell, line in zip(tests, layout.column(column), layout.lines, strict=True):
        now = seconds(cell)
        if now is None:
            continue
        gone = before.get(test, now) - now
        if 0.0 < gone < 43200.0:
            said = f"is {shown(str(cell).strip())}, earlier than the row before it"
            complaints.add(
                f"column {shown(column)}", f"{said}; allowed is the order of the measurement", line
            )
            return
        before[test] = now


def seconds(cell: Cell) -> float | None:
    """A time in seconds, from a number, a clock or a date; None where the cell is none."""
    if isinstance(cell, float):
        return cell
    text = cell.strip()
    for read in (_number, _date, _clock):
        try:
            return read(text)
        except ValueError:
            continue
    return None


def _clock(text: str) -> float:
    it = time.fromisoformat(text.replace(",", "."))
    return 3600.0 * it.hour + 60.0 * it.minute + it.second + 1e-6 * it.microsecond


def _number(text: str) -> float:
    return float(text.replace(",", "."))


def _date(text: str) -> float:
    return datetime.fromisoformat(text).timestamp()
