"""From the cells of a file to its columns: where the header and the units are, and which rows are data."""

from __future__ import annotations

import re
from dataclasses import dataclass

from pipeline.campaign.complaints import Complaints, shown
from pipeline.campaign.mapped.grid import Cell, Grid
from pipeline.campaign.mapped.numbers import is_missing
from pipeline.campaign.mapped.schema import FileTable
from pipeline.campaign.mapped.units import NoUnit, unit

_BRACKETS = re.compile(r"(.*?)\s*[(\[]\s*([^()\[\]]+?)\s*[)\]]\s*")
_ENDING = re.compile(r"(.*?)(?:\s*[,/]\s*|_)([^\s,/_]+)")


@dataclass(frozen=True, eq=False)
class Layout:
    """The data rows of a table by column.

    names: of the columns, as they stand in the header, or #1, #2 ... units: beside each, "" for none. cells: (columns)
    of (rows). lines: of the rows. blocks: (rows) numbers of the block between blank rows in which each stands.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    cells: tuple[tuple[Cell, ...], ...]
    lines: tuple[int, ...]
    blocks: tuple[int, ...]
    sheet: str = ""

    def column(self, name: str) -> tuple[Cell, ...]:
        """The cells of a column."""
        return self.cells[self.names.index(name)]


def laid_out(grid: Grid, how: FileTable, complaints: Complaints) -> Layout | None:
    """The columns of a grid; None, with complaints, where there are none."""
    at = dict(zip(grid.lines, grid.rows, strict=True))
    header = at.get(how.header_row) if how.header_row else None
    if how.header_row and (header is None or not any(_text(cell) for cell in header)):
        complaints.add(
            "", "holds nothing, the header is expected here; write header_row under [file]", how.header_row
        )
        return None
    below = max(how.header_row, how.units_row or 0) + how.skip
    rows, lines, blocks = _rows(grid, how, below, header)
    if not rows:
        complaints.add("", f"has no rows of data below line {below}, allowed is one row for each load step")
        return None
    width = max(map(len, rows)) if header is None else _width(header)
    names = tuple(f"#{k + 1}" for k in range(width)) if header is None else _names(header[:width])
    for k, name in enumerate(names):
        if name and name in names[:k]:
            complaints.add(f"column {shown(name)}", "is there twice", how.header_row)
    for row, line in zip(rows, lines, strict=True):
        if any(_text(cell) for cell in row[width:]) or (header is not None and len(row) < width):
            complaints.add("", f"has {len(row)} cells, the header has {width}", line)
    full = [(*row[:width], *[""] * (width - len(row))) for row in rows]
    cells = [list(column) for column in zip(*full, strict=True)]
    for name in how.fill_down:
        if name not in names:
            complaints.add("", f"has no column {shown(name)}, which fill_down names")
        else:
            _fill(cells[names.index(name)], how)
    units = at.get(how.units_row or 0, ())
    beside = tuple(_text(units[k]) if k < len(units) else "" for k in range(width))
    return Layout(names, beside, tuple(map(tuple, cells)), tuple(lines), tuple(blocks), grid.name)


def _rows(
    grid: Grid, how: FileTable, below: int, header: tuple[Cell, ...] | None
) -> tuple[list[tuple[Cell, ...]], list[int], list[int]]:
    """Rows of data with their lines and blocks: without blank ones, remarks, and the header where it comes again."""
    rows: list[tuple[Cell, ...]] = []
    lines: list[int] = []
    blocks: list[int] = []
    block, blank = 0, False
    for line, row in zip(grid.lines, grid.rows, strict=True):
        if line <= below or (how.last_row is not None and line > how.last_row):
            continue
        if not any(_text(cell) for cell in row):
            blank = True
            continue
        if how.comment and _text(row[0]).startswith(how.comment):
            continue
        if header is not None and tuple(map(_text, row)) == tuple(map(_text, header)):
            continue
        block += blank and bool(rows)
        blank = False
        rows.append(row)
        lines.append(line)
        blocks.append(block)
    return rows, lines, blocks


def header_unit(name: str) -> tuple[str, str]:
    """The name of a column without its unit, and the unit as it is written there: "Force (kN)", "x_mm", "Weg/µm"."""
    if found := _BRACKETS.fullmatch(name):
        return found[1], found[2]
    if (found := _ENDING.fullmatch(name)) and _known(found[2]):
        return found[1], found[2]
    return name, ""


def _known(spelling: str) -> bool:
    try:
        unit(spelling)
    except NoUnit as error:
        return " is " in str(error) and "is no unit" not in str(error)
    return True


def _width(header: tuple[Cell, ...]) -> int:
    """Columns up to the last one with a name."""
    return max(k + 1 for k, cell in enumerate(header) if _text(cell))


def _names(header: tuple[Cell, ...]) -> tuple[str, ...]:
    return tuple(" ".join(_text(cell).split()) for cell in header)


def _fill(cells: list[Cell], how: FileTable) -> None:
    """Empty cells repeat the one above, as merged cells of a spreadsheet are meant."""
    for k in range(1, len(cells)):
        if is_missing(cells[k], how.missing):
            cells[k] = cells[k - 1]


def _text(cell: Cell) -> str:
    if isinstance(cell, float):
        return f"{cell:.0f}" if cell.is_integer() else repr(cell)
    return cell.strip()
