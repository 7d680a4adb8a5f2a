"""Which rows of a table are used, and whether they are in the order of time."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime, time

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.long_tests import PART, turns
from pipeline.campaign.mapped.grid import Cell
from pipeline.campaign.mapped.layout import Layout
from pipeline.campaign.mapped.numbers import Marks, is_empty, plain
from pipeline.campaign.mapped.schema import FileTable
from pipeline.campaign.measured import Measured
from pipeline.toml.complaints import Complaints, shown

HALF_A_DAY = 43200.0
"""Seconds by which a clock goes back where it passes midnight, at least."""


def fewer(measured: Measured, every: int) -> Measured:
    """One row of so many, and of each test the first, the last, and those where a reading turned by more than a part of
    its travel."""
    if every == 1 or not measured.tests:
        return measured
    names = np.array(measured.tests, dtype=object)
    kept = np.concatenate(
        [_kept(measured, np.flatnonzero(names == n), every) for n in dict.fromkeys(measured.tests)]
    )
    rows = np.sort(kept)
    return measured.only(rows)


def _kept(measured: Measured, mine: NDArray[np.int64], every: int) -> NDArray[np.int64]:
    chosen = {0, len(mine) - 1, *range(0, len(mine), every)}
    for values in measured.values.values():
        own = values[mine]
        read = np.flatnonzero(np.isfinite(own))
        if read.size > 2:
            travel = float(np.ptp(own[read]))
            chosen |= {int(read[k]) for k in turns(own[read], PART * travel)} if travel else set()
    return mine[sorted(chosen)]


@dataclass
class Clock:
    """Looks whether the time of a test goes back in the tables of a source: rows are in the order of the loading."""

    how: FileTable
    before: dict[str, float] = field(default_factory=dict)

    def look(self, layout: Layout, tests: tuple[str, ...], complaints: Complaints) -> None:
        """Complaints about the first time that goes back, and about cells that are none among those that are."""
        column = self.how.time_column
        if column is None:
            return
        if column not in layout.names:
            complaints.add("", f"has no column {shown(column)}, which time_column names")
            return
        cells = layout.column(column)
        read = [self._seconds(cell) for cell in cells]
        if read[0] is None:
            return
        for test, cell, now, line in zip(tests, cells, read, layout.lines, strict=True):
            said = ""
            if now is None:
                said = (
                    "which is no time; a row that is no data: skip, last_row or comment"
                    if not is_empty(cell)
                    else ""
                )
            else:
                gone = self.before.get(test, now[0]) - now[0]
                # A clock without a date passes midnight.
                if gone > 0.0 and not (now[1] and gone > HALF_A_DAY):
                    said = "earlier than the row before it; allowed is the order of the measurement"
                self.before[test] = now[0]
            if said:
                complaints.add(f"column {shown(column)}", f"is {shown(str(cell).strip())}, {said}", line)
                return

    def _seconds(self, cell: Cell) -> tuple[float, bool] | None:
        """A time in seconds, and whether it is that of a clock; None where the cell is no time."""
        if isinstance(cell, float):
            return None if cell != cell else (cell, False)
        text = plain(cell)
        for marks in (Marks(self.how.decimal or ".", self.how.thousands or ""), Marks(",")):
            if (number := marks.number(text)) is not None:
                return number, False
        for read in (_date, _clock):
            try:
                return read(text), read is _clock
            except ValueError:
                continue
        return None


def _date(text: str) -> float:
    for form in ("", "%d.%m.%Y %H:%M:%S", "%m/%d/%Y %I:%M:%S %p", "%m/%d/%Y %H:%M:%S", "%Y/%m/%d %H:%M:%S"):
        try:
            return (datetime.strptime(text, form) if form else datetime.fromisoformat(text)).timestamp()
        except ValueError:
            continue
    raise ValueError(text)


def _clock(text: str) -> float:
    it = time.fromisoformat(text.replace(",", "."))
    return 3600.0 * it.hour + 60.0 * it.minute + it.second + 1e-6 * it.microsecond
