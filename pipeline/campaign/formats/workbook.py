"""Workbooks of a spreadsheet; cells that it keeps as numbers are numbers, dates are text."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date, datetime, time, timedelta
from pathlib import Path

from pipeline.campaign.mapped.grid import BadTable, Cell, Grid
from pipeline.campaign.mapped.schema import FileTable
from pipeline.campaign.mapped.uncomputed import uncomputed

SUFFIXES = (".xlsx", ".xlsm", ".xls", ".xlsb", ".ods")


def read(path: Path, how: FileTable) -> tuple[Grid, ...]:
    """The sheet that was asked for, or all of them."""
    from python_calamine import CalamineError, load_workbook

    try:
        book = load_workbook(str(path))
        names = _names(book.sheet_names, how)
        found = [_grid(name, book.get_sheet_by_name(name).to_python(skip_empty_area=False)) for name in names]
    except (CalamineError, OSError) as error:
        raise BadTable(f"is no workbook that can be read: {' '.join(str(error).split())}") from error
    return tuple(_with_errors(path, grid) for grid in found)


def _with_errors(path: Path, grid: Grid) -> Grid:
    """The table with what stands in cells that are read as empty though they are not: an error of the spreadsheet, or a
    formula whose value was never kept. So they are complained about, and not taken for what was not measured."""
    cells = dict(uncomputed(path, grid.name))
    if not cells:
        return grid
    rows = [list(row) for row in grid.rows]
    for (row, column), text in cells.items():
        if row < len(rows) and column < len(rows[row]):
            rows[row][column] = text
    return Grid(tuple(map(tuple, rows)), grid.lines, grid.name)


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
