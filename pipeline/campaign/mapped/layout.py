"""From the cells of a file to its columns: where the header and the units are, and which rows are data."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from pipeline.campaign.mapped.grid import Cell, Grid
from pipeline.campaign.mapped.numbers import is_empty
from pipeline.campaign.mapped.schema import FileTable
from pipeline.campaign.mapped.units import meant
from pipeline.toml.complaints import Complaints, shown

_BRACKETS = re.compile(r"(.*?)\s*[(\[]\s*([^()\[\]]+?)\s*[)\]]\s*")
_ENDING = re.compile(r"(.*?)\s*[,/]\s*([^\s,/_]+)")
# As in the contract's own columns. What may as well be a word is no unit there: Fz_min, T_in, Probe_h.
_SUFFIX = re.compile(r"(.+)_(mm|cm|um|µm|N|mN|kN|Nmm|Nm|rad|mrad|urad|deg|kgf|gf|lbf|degC|degF)")

HEAD = 50
"""Lines among which a header is looked for that is not where it was said to be."""


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


def laid_out(
    grid: Grid, how: FileTable, complaints: Complaints, declared: Collection[str] = ()
) -> Layout | None:
    """The columns of a grid; None, with complaints, where there are none. declared: names that are expected."""
    at = dict(zip(grid.lines, grid.rows, strict=True))
    header = at.get(how.header_row) if how.header_row else None
    if how.header_row and (header is None or not any(word(cell) for cell in header)):
        complaints.add(
            "", "holds nothing, the header is expected here; write header_row under [file]", how.header_row
        )
        return None
    if header is not None and (said := _elsewhere(grid, header, declared)):
        complaints.add("", said, how.header_row)
        return None
    below = max(how.header_row, how.units_row or 0)
    rows, lines, blocks = _rows(grid, how, below, header)
    if not rows:
        complaints.add("", f"has no rows of data below line {below}, allowed is one row for each load step")
        return None
    width = max(map(len, rows)) if header is None else _width(header)
    given = ("",) * width if header is None else _names(header[:width])
    # A column without a name is called by its number.
    names = tuple(name or f"#{k + 1}" for k, name in enumerate(given))
    for k, name in enumerate(names):
        if name in names[:k]:
            complaints.add(f"column {shown(name)}", "is there twice", how.header_row)
    for row, line in zip(rows, lines, strict=True):
        if any(word(cell) for cell in row[width:]) or len(row) < width:
            others = "the header has" if header is not None else "others have"
            complaints.add("", f"has {len(row)} cells, {others} {width}", line)
    full = [(*row[:width], *[""] * (width - len(row))) for row in rows]
    cells = [list(column) for column in zip(*full, strict=True)]
    for name in how.fill_down:
        if name not in names:
            complaints.add("", f"has no column {shown(name)}, which fill_down names")
        else:
            _fill(cells[names.index(name)])
    units = at.get(how.units_row or 0, ())
    beside = tuple(word(units[k]) if k < len(units) else "" for k in range(width))
    return Layout(names, beside, tuple(map(tuple, cells)), tuple(lines), tuple(blocks), grid.name)


def _rows(
    grid: Grid, how: FileTable, below: int, header: tuple[Cell, ...] | None
) -> tuple[list[tuple[Cell, ...]], list[int], list[int]]:
    """Rows of data with their lines and blocks: without blank ones, remarks, and the header where it comes again."""
    rows: list[tuple[Cell, ...]] = []
    lines: list[int] = []
    blocks: list[int] = []
    block, blank, skipped = 0, False, 0
    for line, row in zip(grid.lines, grid.rows, strict=True):
        if line <= below or (how.last_row is not None and line > how.last_row):
            continue
        if not any(word(cell) for cell in row):
            blank = True
            continue
        if how.comment and word(row[0]).startswith(how.comment):
            continue
        if header is not None and tuple(map(word, row)) == tuple(map(word, header)):
            continue
        if skipped < how.skip:
            skipped += 1
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
    for form in (_ENDING, _SUFFIX):
        if (found := form.fullmatch(name)) and meant(found[2]) is not None:
            return found[1], found[2]
    return name, ""


def _width(header: tuple[Cell, ...]) -> int:
    """Columns up to the last one with a name."""
    return max(k + 1 for k, cell in enumerate(header) if word(cell))


def _names(header: tuple[Cell, ...]) -> tuple[str, ...]:
    return tuple(" ".join(word(cell).split()) for cell in header)


def _elsewhere(grid: Grid, header: tuple[Cell, ...], declared: Collection[str]) -> str:
    """What is wrong where most of the names that are expected stand in another line than that of the header; empty
    where they do not."""

    def held(row: tuple[Cell, ...]) -> int:
        return len(set(_names(row)).intersection(declared))

    here = held(header)
    most, line = max(
        ((held(row), -line) for line, row in zip(grid.lines[:HEAD], grid.rows[:HEAD], strict=True)),
        default=(0, 0),
    )
    if 2 * here >= len(declared) or 2 * most < len(declared):
        return ""
    return (
        f"holds {here or 'none'} of the {len(declared)} columns that are declared, line {-line} holds {most}; write "
        f"header_row = {-line} under [file]"
    )


def _fill(cells: list[Cell]) -> None:
    """Empty cells repeat the one above, as merged cells of a spreadsheet are meant."""
    for k in range(1, len(cells)):
        if is_empty(cells[k]):
            cells[k] = cells[k - 1]


def word(cell: Cell) -> str:
    """A cell as text; a whole number without a fraction."""
    if isinstance(cell, float):
        return f"{cell:.0f}" if cell.is_integer() else repr(cell)
    return cell.strip()
