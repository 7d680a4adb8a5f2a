"""Text with one row a line: cells parted by commas, semicolons, tabs or blanks."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from math import inf
from pathlib import Path

from pipeline.campaign.mapped.grid import BadTable, Grid
from pipeline.campaign.mapped.schema import FileTable

SUFFIXES = (".csv", ".txt", ".dat", ".tsv", ".asc", ".lvm", ".log")
SEPARATORS = {"tab": "\t", "space": " "}
_PLAIN = re.compile(r"[+-]?\d*[.,]?\d*(?:[eE][+-]?\d+)?|[^\s,;]+")
_NUMBER = re.compile(r"[+-]?\d*[.,]?\d+(?:[eE][+-]?\d+)?")
IN_A_CELL = 6
"""Lines that a quoted cell may go over."""
LOOKED_AT = 200
"""Rows by which the separator is told where none was declared."""


def read(path: Path, how: FileTable) -> tuple[Grid, ...]:
    """The one table of a text file."""
    text = decoded(path.read_bytes(), how.encoding)
    mark = SEPARATORS.get(how.separator or "", how.separator or "") or _separator(text, how)
    head = {how.header_row, how.units_row}
    rows, lines = [], []
    for number, line in joined(text.splitlines(), mark):
        if how.comment and line.startswith(how.comment):
            if number not in head:
                continue
            # Some programs write the header as a remark.
            line = line.removeprefix(how.comment).lstrip()
        try:
            rows.append(tuple(split([line], mark)[0]))
        except csv.Error as error:
            raise BadTable(
                f"cannot be split into cells: {error}; is there a lone quote mark?", number
            ) from error
        lines.append(number)
    return (Grid(tuple(rows), tuple(lines)),)


def joined(lines: Sequence[str], mark: str) -> Iterator[tuple[int, str]]:
    """Each line with its number; a quoted cell of a header that goes over a few lines makes one of them.

    None of these may hold a number, as a lone quote mark would swallow the rows of data below it.
    """
    k = 0
    while k < len(lines):
        number, line = k + 1, lines[k]
        k += 1
        for more in range(1, IN_A_CELL):
            if mark == " " or _closed(line, mark) or k + more > len(lines):
                break
            below = lines[k : k + more]
            whole = " ".join([line, *below])
            if _closed(whole, mark) and not any(_has_number(each, mark) for each in (line, *below)):
                line, k = whole, k + more
                break
        yield number, line


def _closed(line: str, mark: str) -> bool:
    try:
        split([line], mark)
    except csv.Error:
        return False
    return True


def _has_number(line: str, mark: str) -> bool:
    """Whether a line has a cell that is a number, so that it is no part of a header."""
    return any(_NUMBER.fullmatch(cell.strip()) for cell in line.split(mark))


def decoded(content: bytes, encoding: str) -> str:
    """The text of a file. BadTable where it is in another encoding, or no text."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    try:
        text = content.decode("utf-8-sig" if encoding.lower() in ("utf-8", "utf8") else encoding)
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        said = f"byte {error.object[error.start]:#04x} is not in the encoding {encoding}; is it cp1252? Write encoding"
        raise BadTable(f'{said} = "cp1252" under [file]', line) from error
    except (LookupError, ValueError) as error:
        raise BadTable(
            f"the encoding {encoding!r} is unknown, allowed is one such as utf-8 or cp1252"
        ) from error
    if "\0" in text:
        raise BadTable("is a binary file, allowed is text", text.count("\n", 0, text.index("\0")) + 1)
    return text


def _separator(text: str, how: FileTable) -> str:
    """The mark that parts all rows into as many cells, more than one and no more than the header has, and of several
    that under which most cells are numbers or words; a question where two do so alike."""
    first = max(how.header_row, how.units_row or 0) + how.skip
    every = text.splitlines()
    shares: dict[str, float] = {}
    for mark in (",", ";", "\t", " "):
        # The header may go over several lines.
        own = dict(joined(every[: first + LOOKED_AT], mark))
        lines = [line for number, line in own.items() if number > first and line.strip()]
        if how.comment:
            lines = [line for line in lines if not line.startswith(how.comment)]
        head = [own[how.header_row].removeprefix(how.comment or "")] if how.header_row in own else []
        try:
            rows, most = split(lines, mark), len(split(head, mark)[0]) if head else inf
        except csv.Error:
            continue
        counts = {len(cells) for cells in rows}
        # A mark at the end of every row of data makes one more, empty cell.
        spare = all(not cells[-1].strip() for cells in rows if cells)
        if len(counts) == 1 and 1 < min(counts) <= most + spare:
            cells = [cell.strip() for row in rows for cell in row]
            shares[mark] = sum(bool(_PLAIN.fullmatch(cell)) for cell in cells) / len(cells)
    if {"\t", " "} <= set(shares):
        # Where tabs part the cells, blanks are parts of them.
        del shares[" "]
    best = [mark for mark, share in shares.items() if share == max(shares.values())]
    if len(best) > 1:
        names = {"\t": "tab", " ": "space"}
        found = " or ".join(f'"{names.get(mark, mark)}"' for mark in best)
        raise BadTable(f"cells may be parted by {found}, write separator = ... under [file]")
    return best[0] if best else ","


def split(lines: list[str], mark: str) -> list[list[str]]:
    """The cells of each line, parted by a mark; of blanks any number is one. csv.Error for an unclosed quote."""
    if mark == " ":
        return [line.split() for line in lines]
    return [
        next(csv.reader([line], delimiter=mark, skipinitialspace=True, strict=True), []) for line in lines
    ]
