"""What a file of readings says by itself: its separator, where header, units and data are, how numbers are written."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from pipeline.campaign.formats import by_suffix, grids
from pipeline.campaign.formats.text import decoded, joined, split
from pipeline.campaign.mapped.grid import BadTable, Cell
from pipeline.campaign.mapped.layout import word
from pipeline.campaign.mapped.numbers import Marks, decimal_of, plain
from pipeline.campaign.mapped.schema import FileTable
from pipeline.campaign.mapped.units import meant
from pipeline.init.words import quantity_of

MARKS = (";", "\t", ",", " ")
"""In the order in which they are preferred where they part a file alike."""
NAMES = {"\t": "tab", " ": "space"}
ENCODINGS = ("utf-8", "cp1252")
REMARKS = ("#", "%", "//")
MOST_TESTS = 50
SHOWN = 4
"""Values by which a column is recognised."""
LOOKED_AT = 2000
"""Lines."""
_NUMBER = re.compile(r"[+-]?(?:\d{1,3}(?:[.,' ]\d{3})+(?:[.,]\d*)?|\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?")


@dataclass(frozen=True)
class Found:
    """Of a file.

    separator: None where the format has none. header_row, units_row: counted from 1, 0 and None where there is none.
    skip: rows below these before the data. names, units: of the columns. decimal: None where the numbers allow two
    readings. question: what to ask then. merged: columns with a word in their first row and nothing in most others.
    others: lines among the data that are not like them. sheets: of a workbook with several that hold numbers.
    comment: what the header of a text begins with, as a remark does; None where it does not. still: columns with one
    word throughout. tests: words of the column that names the test of each row, in their order. samples: a few values
    of each column.
    """

    encoding: str
    separator: str | None
    sheet: str | None
    header_row: int
    units_row: int | None
    skip: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    decimal: str | None
    question: str = ""
    merged: tuple[str, ...] = ()
    others: tuple[int, ...] = ()
    sheets: tuple[str, ...] = ()
    comment: str | None = None
    still: tuple[str, ...] = ()
    tests: tuple[str, ...] = ()
    samples: tuple[str, ...] = ()


def looked(path: Path) -> Found:
    """What is found. BadTable for a file without a row of numbers."""
    if path.suffix.lower() not in by_suffix():
        raise BadTable(
            f"has the ending {path.suffix or 'none'}, allowed are {', '.join(sorted(by_suffix()))}"
        )
    if path.suffix.lower() in by_suffix() and by_suffix()[path.suffix.lower()].__name__.endswith(".text"):
        return _of_text(path)
    every = [
        grid for grid in grids(path, FileTable(header_row=0, test_from="sheet")) if _data(list(grid.rows))[2]
    ]
    if not every:
        raise BadTable("has no rows of numbers, allowed is a table with two columns or more")
    found = _of_rows(list(every[0].rows), "utf-8", None, every[0].name)
    return replace(found, sheets=tuple(grid.name for grid in every)) if len(every) > 1 else found


def _of_text(path: Path) -> Found:
    content, text, used = path.read_bytes(), "", ""
    for encoding in ENCODINGS:
        try:
            text, used = decoded(content, encoding), encoding
            break
        except BadTable:
            continue
    if not used:
        raise BadTable("is no text in UTF-8 or cp1252")
    lines = text.splitlines()[:LOOKED_AT]
    comment = _remark(lines)
    best: tuple[tuple[float, int], list[tuple[Cell, ...]], str] | None = None
    for mark in MARKS:
        try:
            rows = _split(lines, mark, comment)
        except csv.Error:
            continue
        _, width, size = _data(rows)
        alike = sum(len(row) == width and bool(_numbers(row)) for row in rows)
        # The mark under which most cells are numbers.
        merit = (size / (width * alike), size) if size else (0.0, 0)
        if size and (best is None or merit > best[0]):
            best = (merit, rows, mark)
    if best is None:
        raise BadTable("has no rows of numbers, allowed is a table with two columns or more")
    _no_commas_in_numbers(best[1], best[2])
    found = _of_rows(best[1], used, NAMES.get(best[2], best[2]), None)
    header = lines[found.header_row - 1] if found.header_row else ""
    return replace(found, comment=comment) if comment and header.startswith(comment) else found


def _no_commas_in_numbers(rows: list[tuple[Cell, ...]], mark: str) -> None:
    """BadTable where commas part the cells and the numbers too: whole numbers alone, more of them than names."""
    first, width, _ = _data(rows)
    names = next((row for row in reversed(rows[:first]) if len(row) > 1 and not _numbers(row)), None)
    whole = _numbers(rows[first]) == width and not any("." in word(c) for row in rows[first:] for c in row)
    if mark == "," and whole and names and len(names) < width <= 2 * len(names):
        raise BadTable(
            f"has {width} cells under {len(names)} names, as decimal commas between commas make them; allowed is a "
            "table with semicolons between its cells, or with decimal points",
            first + 1,
        )


def _remark(lines: list[str]) -> str | None:
    """What the line above the first that is none begins with, where that is a mark of remarks: the header may."""
    first = next((k for k, line in enumerate(lines) if line.strip() and not line.startswith(REMARKS)), 0)
    above = lines[first - 1] if first else ""
    return next((mark for mark in REMARKS if above.startswith(mark)), None)


def _split(lines: list[str], mark: str, comment: str | None) -> list[tuple[Cell, ...]]:
    """Rows of cells by line; a line that belongs to a cell of the one above is an empty row. csv.Error as of csv."""
    rows: list[tuple[Cell, ...]] = [() for _ in lines]
    for number, line in joined(lines, mark):
        bare = line.removeprefix(comment).lstrip() if comment and line.startswith(comment) else line
        rows[number - 1] = tuple(split([bare], mark)[0])
    return rows


def _of_rows(rows: list[tuple[Cell, ...]], encoding: str, separator: str | None, sheet: str | None) -> Found:
    first, width, size = _data(rows)
    if not size:
        raise BadTable("has no rows of numbers, allowed is a table with two columns or more")
    above = [k for k in range(first) if _texts(rows[k], width)]
    # Letters such as s and F alone may as well be names.
    units_at = above[-1] if len(above) > 1 and _are_units(rows[above[-1]]) else None
    header_at = next((k for k in reversed(above) if k != units_at), None)
    names = tuple(f"#{k + 1}" for k in range(width)) if header_at is None else _padded(rows[header_at], width)
    units = ("",) * width if units_at is None else _padded(rows[units_at], width)
    below = max((header_at if header_at is not None else -1), (units_at if units_at is not None else -1)) + 1
    others = [k + 1 for k in range(first, len(rows)) if _other(rows[k], width, rows, header_at)]
    cells = [c for row in rows[first:] for c in row if isinstance(c, str) and _NUMBER.fullmatch(c.strip())]
    marks = decimal_of(cells, None, None)
    return Found(
        encoding,
        separator,
        sheet,
        0 if header_at is None else header_at + 1,
        None if units_at is None else units_at + 1,
        sum(any(word(c) for c in row) for row in rows[below:first]),
        names,
        units,
        marks.decimal if isinstance(marks, Marks) else None,
        marks if isinstance(marks, str) else "",
        tuple(
            names[k]
            for k in range(width)
            if names[k] and _merged([row[k] for row in rows[first:] if len(row) > k])
        ),
        tuple(others),
        still=tuple(
            names[k] for k in range(width) if _still([row[k] for row in rows[first:] if len(row) > k])
        ),
        samples=tuple(_samples([row[k] for row in rows[first:] if len(row) > k]) for k in range(width)),
        tests=_tests(names, units, [row for row in rows[first:] if len(row) == width and _numbers(row)]),
    )


def _tests(names: tuple[str, ...], units: tuple[str, ...], rows: list[tuple[Cell, ...]]) -> tuple[str, ...]:
    """Words of the one column of tests; none where there is none, or more of them than anybody would write down."""
    columns = [k for k, name in enumerate(names) if quantity_of(name, units[k]) == "test"]
    if len(columns) != 1:
        return ()
    found = dict.fromkeys(word(row[columns[0]]) for row in rows)
    found.pop("", None)
    return tuple(found) if len(found) <= MOST_TESTS else ()


def _samples(column: list[Cell]) -> str:
    """The first few words of a column, and its last."""
    words = [word(cell) for cell in column if word(cell)]
    return ", ".join(words if len(words) <= SHOWN else [*words[: SHOWN - 1], "...", words[-1]])


def _still(column: list[Cell]) -> bool:
    return len(set(map(word, column))) == 1


def _other(row: tuple[Cell, ...], width: int, rows: list[tuple[Cell, ...]], header_at: int | None) -> bool:
    """Whether a row among the data is none: other than blank, the header again, or as wide and with a number."""
    if not any(word(c) for c in row) or (header_at is not None and row == rows[header_at]):
        return False
    return len(row) != width or not _numbers(row)


def _merged(column: list[Cell]) -> bool:
    empty = sum(isinstance(c, str) and not c.strip() for c in column)
    named = isinstance(column[0], str) and bool(column[0].strip()) and not _NUMBER.fullmatch(plain(column[0]))
    return 2 * empty > len(column) and named


def _data(rows: list[tuple[Cell, ...]]) -> tuple[int, int, int]:
    """Where the data begin, their width, and how many cells hold numbers.

    The width is that of the longest run of rows with numbers; they begin with the first row that is as wide and has as
    many numbers as the leanest of that run, whatever interrupts them later.
    """
    best, width, least = 0, 0, 0
    for wide, run in groupby(rows, lambda row: len(row) if len(row) > 1 and _numbers(row) else 0):
        counts = [_numbers(row) for row in run]
        if wide and sum(counts) > best:
            best, width, least = sum(counts), wide, min(counts)
    if not width:
        return 0, 0, 0
    first = next(k for k, row in enumerate(rows) if len(row) == width and _numbers(row) >= least)
    return first, width, sum(_numbers(row) for row in rows if len(row) == width)


def _numbers(row: tuple[Cell, ...]) -> int:
    return sum(isinstance(c, float) or bool(_NUMBER.fullmatch(plain(c))) for c in row)


def _texts(row: tuple[Cell, ...], width: int) -> bool:
    """Whether a row may be a header: as wide as the data, with more than one word and no number."""
    filled = [c for c in row[:width] if not (isinstance(c, str) and not c.strip())]
    return len(filled) > 1 and not _numbers(tuple(filled)) and len(row) >= width


def _are_units(row: tuple[Cell, ...]) -> bool:
    """Whether more than half of the words of a row are units."""
    words = [str(c).strip() for c in row if str(c).strip().strip("-")]
    known = sum(meant(word) is not None for word in words)
    return bool(words) and 2 * known > len(words)


def _padded(row: tuple[Cell, ...], width: int) -> tuple[str, ...]:
    words = [" ".join(str(c).split()) for c in row[:width]]
    return tuple(words + [""] * (width - len(words)))
