"""Workbooks of a spreadsheet; cells that it keeps as numbers are numbers, dates are text."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import date, datetime, time, timedelta
from pathlib import Path
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

from pipeline.campaign.mapped.grid import BadTable, Cell, Grid
from pipeline.campaign.mapped.schema import FileTable

SUFFIXES = (".xlsx", ".xlsm", ".xls", ".xlsb", ".ods")
_NAMES = {
    "m": "http://schemas.openxmlformats.org/spreadsheetml/2006/main",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
}
_ID = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_ERROR = re.compile(rb'<c r="([A-Z]+)(\d+)"[^>]*\bt="e"[^>]*>.*?<v>([^<]*)</v>', re.DOTALL)
_FORMULA = re.compile(rb'<c r="([A-Z]+)(\d+)"[^>]*>\s*<f[^>]*>([^<]*)</f>\s*(?:<v\s*/>|<v></v>)?\s*</c>')


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
    cells = dict(_uncomputed(path, grid.name))
    if not cells:
        return grid
    rows = [list(row) for row in grid.rows]
    for (row, column), text in cells.items():
        if row < len(rows) and column < len(rows[row]):
            rows[row][column] = text
    return Grid(tuple(map(tuple, rows)), grid.lines, grid.name)


def _uncomputed(path: Path, sheet: str) -> Iterator[tuple[tuple[int, int], str]]:
    """Cells that hold no value, errors and formulas that were never computed: (row, column), counted from 0, and what
    stands there; nothing for formats that are no zip of XML."""
    if path.suffix.lower() not in (".xlsx", ".xlsm"):
        return
    try:
        with ZipFile(path) as book:
            text = book.read(_part(book, sheet))
    except (BadZipFile, KeyError, ElementTree.ParseError, OSError):
        return
    for column, row, value in _ERROR.findall(text):
        yield (int(row) - 1, _column(column)), value.decode()
    for column, row, formula in _FORMULA.findall(text):
        yield (int(row) - 1, _column(column)), f"={formula.decode()} (never computed)"


def _part(book: ZipFile, sheet: str) -> str:
    """The part of the zip with a sheet. KeyError where there is none."""
    tree = ElementTree.fromstring(book.read("xl/workbook.xml"))
    found = {each.get("name"): each.get(_ID) for each in tree.iterfind("m:sheets/m:sheet", _NAMES)}
    relations = ElementTree.fromstring(book.read("xl/_rels/workbook.xml.rels"))
    targets = {each.get("Id"): each.get("Target", "") for each in relations}
    target = targets[found[sheet]]
    return target.lstrip("/") if target.startswith("/") else f"xl/{target}"


def _column(letters: bytes) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + letter - ord("A") + 1
    return number - 1


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
