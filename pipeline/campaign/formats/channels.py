"""Files of channels in groups (TDMS, National Instruments): a group is a table, its channels are the columns."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pipeline.campaign.mapped.grid import BadTable, Cell, Grid
from pipeline.campaign.mapped.schema import FileTable

SUFFIXES = (".tdms",)


def read(path: Path, how: FileTable) -> tuple[Grid, ...]:
    """The group that was asked for by `sheet`, or all; a channel's unit stands in the row below its name."""
    from nptdms import TdmsFile

    try:
        groups = TdmsFile.read(path).groups()
    except Exception as error:
        # What a damaged file does to its reader is of many kinds.
        raise BadTable(f"is no TDMS file that can be read: {' '.join(str(error).split())}") from error
    names = [group.name for group in groups]
    if how.sheet is not None:
        wanted = names[how.sheet - 1 : how.sheet] if isinstance(how.sheet, int) else [how.sheet]
        groups = [group for group in groups if group.name in wanted]
    if not groups or (len(groups) > 1 and how.test_from != "sheet"):
        raise BadTable(
            f"has the groups {', '.join(map(repr, names))}, write sheet = one of them under [file]"
        )
    return tuple(_grid(group) for group in groups)


def _grid(group: object) -> Grid:
    channels = group.channels()  # type: ignore[attr-defined]
    columns = [[_cell(value) for value in channel[:]] for channel in channels]
    name = group.name  # type: ignore[attr-defined]
    for what, values in (
        ("lengths", {len(column) for column in columns}),
        ("time steps", {channel.properties.get("wf_increment") for channel in channels}),
    ):
        if len(values) > 1:
            shown = ", ".join(sorted(map(str, values)))
            raise BadTable(f"group {name!r} has channels of different {what} ({shown}), which make no rows")
    header: tuple[Cell, ...] = tuple(channel.name for channel in channels)
    units: tuple[Cell, ...] = tuple(str(channel.properties.get("unit_string", "")) for channel in channels)
    rows = (header, units, *zip(*columns, strict=True))
    return Grid(rows, tuple(range(1, len(rows) + 1)), name)


def _cell(value: object) -> Cell:
    # Text stays text: its marks and its words for no reading are looked at where it is read.
    return float(value) if isinstance(value, int | float | np.number) else str(value)
