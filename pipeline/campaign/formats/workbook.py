"""Workbooks of a spreadsheet; cells that it keeps as numbers are numbers, dates are text."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date, datetime, time, timedelta
from pathlib import Path

from pipeline.campaign.mapped.grid import BadTable, Cell, Grid
from pipeline.campaign.mapped.schema import FileTable

SUFFIXES = (".xlsx", ".xlsm", ".xls", ".xlsb", ".ods")


def read(path: Path, how: FileTable) -> tuple[Grid, ...]:
    """The sheet that was asked for, or all of them."""
    from python_calamine import CalamineError, load_workbook

    try:
        book = load_workbook(str(path))
        names = _names(book.sheet_names, how)
        return tuple(
            _grid(name, book.get_sheet_by_name(name).to_python(skip_empty_area=False)) for name in names
        )
    except (CalamineError, OSError) as error:
        raise BadTable(f"is no workbook that can be read: {' '.join(str(error).split())}") from error


def _names(there: list[str], how: FileTable) -> list[str]:
    shown = ", ".join(map(repr, there))
    if isinstance(how.sheet, int):
        if how.sheet > len(there):
            raise BadTable(f"has {len(there)} sheets ({shown}), sheet {how.sheet} is none of them")
        return [there[how.sheet - 1]]
    if how.sheet is not None:
        if how.sheet not in there:
            raise BadTable(f"has no sheet {how.sheet!r}, allowed are {shown}")
        return [how.sheet]
    if len(there) > 1 and how.test_from != "sheet":
        raise BadTable(
            f'has {len(there)} sheets ({shown}), write sheet = ... or test_from = "sheet" under [file]'
        )
    return there


def _grid(name: str, rows: Sequence[Sequence[object]]) -> Grid:
    return Grid(tuple(tuple(map(_cell, row)) for row in rows), tuple(range(1, len(rows) + 1)), name)


def _cell(value: object) -> Cell:
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, int | float):
        return float(value)
    if isinstance(value, datetime | date | time):
        return value.isoformat()
    if isinstance(value, timedelta):
        return value.total_seconds()
    return str(value)
