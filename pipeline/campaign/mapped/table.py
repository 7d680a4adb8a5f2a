"""A table as it was read, before zeros of its first rows are taken away."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pipeline.campaign.mapped.layout import Layout
from pipeline.campaign.mapped.mapping import Declared
from pipeline.campaign.mapped.readings import Column
from pipeline.campaign.model import Array
from pipeline.toml.complaints import Complaints, shown


@dataclass(eq=False)
class Read:
    """Of a file or a sheet.

    tests: the id of each row, "" for one of another source. steps: None where rows are only in order. columns: by what
    they are.
    """

    path: Path
    layout: Layout
    declared: Declared
    tests: tuple[str, ...]
    steps: Array | None
    columns: dict[str, Column]
    complaints: Complaints


def zeroed(tables: Sequence[Read]) -> None:
    """Takes away the first reading of each test where that was declared to be zero; a test may go over several tables.

    A first row without a reading is a complaint: what would be zero then is not said. A sensor that has no reading in
    all of a test was not used there, and needs no zero.
    """
    first: dict[tuple[str, str], float] = {}
    used = _used(tables)
    for table in tables:
        for what, column in table.columns.items():
            if not column.from_first:
                continue
            values = column.values.copy()
            for k, test in enumerate(table.tests):
                if not test or (test, what) not in used:
                    continue
                if (test, what) not in first:
                    first[test, what] = float(values[k])
                    if np.isnan(values[k]):
                        said = (
                            f"has no reading in the first row of test {shown(test)}, which is to be its zero"
                        )
                        table.complaints.add(f"column {shown(column.name)}", said, table.layout.lines[k])
                values[k] -= first[test, what]
            table.columns[what] = replace(column, values=values)


def _used(tables: Sequence[Read]) -> set[tuple[str, str]]:
    """Tests, each with what a sensor that was read there at least once reads."""
    return {
        (test, what)
        for table in tables
        for what, column in table.columns.items()
        for test, value in zip(table.tests, column.values, strict=True)
        if not np.isnan(value)
    }
