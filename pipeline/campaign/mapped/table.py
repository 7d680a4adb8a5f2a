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

    A first row without a reading is a complaint: what would be zero then is not said.
    """
    first: dict[tuple[str, str], float] = {}
    for table in tables:
        for what, column in table.columns.items():
            if not column.from_first:
                continue
            values = column.values.copy()
            for k, test in enumerate(table.tests):
                if not test:
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
