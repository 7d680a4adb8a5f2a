"""The files of a campaign as readings: each found, laid out, converted, and parted into tests."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from glob import escape, glob
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.formats import grids
from pipeline.campaign.mapped.cell import at_platform
from pipeline.campaign.mapped.chosen import Clock, fewer
from pipeline.campaign.mapped.grid import BadTable
from pipeline.campaign.mapped.layout import Layout, laid_out
from pipeline.campaign.mapped.mapping import FORCES, MOMENTS, Source, quantities
from pipeline.campaign.mapped.owners import Owners
from pipeline.campaign.mapped.readings import columns_of, derived_of, words_of
from pipeline.campaign.mapped.table import Read, zeroed
from pipeline.campaign.measured import Measured
from pipeline.campaign.rows import steps_of
from pipeline.errors import unread
from pipeline.toml.complaints import Complaints, shown

Array = NDArray[np.float64]
LARGEST = 2**30
"""Bytes of a file."""


def measured(
    folder: Path, default: str, sources: Sequence[Source], gauges: Iterable[str]
) -> tuple[Measured, tuple[str, ...], list[str], list[Path]]:
    """All readings, how they were converted, complaints, and the files. default: the one where none is named."""
    names, said = tuple(gauges), list[str]()
    tables: list[Read] = []
    books: list[Complaints] = []
    for source in sources:
        owners, clock = Owners(source), Clock(source.declared.file)
        for path in _paths(folder, source.declared.file.path or default, said):
            complaints = Complaints(str(path))
            books.append(complaints)
            for layout in _layouts(path, source, complaints):
                table = _read(path, layout, source, owners, names, complaints)
                clock.look(layout, table.tests, complaints)
                tables.append(table)
        if books and (why := owners.missing()):
            books[-1].add("", why)
    zeroed(tables)
    known = quantities(names)
    parts = [_converted(table, known) for table in tables]
    words = dict.fromkeys(word for table in tables for word in _words(table))
    said += [sentence for book in books for sentence in book.sentences()]
    return _joined(parts), tuple(words), said, list(dict.fromkeys(table.path for table in tables))


def _paths(folder: Path, pattern: str, said: list[str]) -> list[Path]:
    """Files in the order of the numbers in their names: run_2 comes before run_10."""
    if any(mark in pattern for mark in "*?["):
        found = [Path(each) for each in glob(str(Path(escape(str(folder))) / pattern), recursive=True)]
        found = sorted((path for path in found if path.is_file()), key=_natural)
        if not found:
            said.append(f"{folder / pattern}: no file is named like that")
        return found
    path = folder / pattern
    if not path.is_file():
        said.append(f"{path}: {'is missing' if not path.exists() else 'is no file'}")
        return []
    return [path]


def _natural(path: Path) -> list[tuple[int, str]]:
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", str(path))]


def _layouts(path: Path, source: Source, complaints: Complaints) -> Iterator[Layout]:
    if (size := path.stat().st_size) > LARGEST:
        complaints.add("", f"has {size / 2**20:.0f} MB, allowed are {LARGEST / 2**20:.0f}")
        return
    try:
        tables = grids(path, source.declared.file)
    except BadTable as error:
        complaints.add("", str(error), error.line)
        return
    except OSError as error:
        complaints.add("", unread(error))
        return
    for grid in tables:
        layout = laid_out(grid, source.declared.file, complaints, source.declared.columns)
        if layout is not None:
            yield layout


def _read(
    path: Path,
    layout: Layout,
    source: Source,
    owners: Owners,
    gauges: tuple[str, ...],
    complaints: Complaints,
) -> Read:
    known, declared = quantities(gauges), source.declared
    found = columns_of(layout, declared, known, complaints)
    for what, column in derived_of(layout, declared, known, complaints).items():
        if what in found:
            said = f"is column {shown(found[what].name)} and under [derived], allowed is one of the two"
            complaints.add(f"derived.{what}", said)
        found[what] = column
    tests = owners.of(path, layout, complaints)
    words = words_of(layout, declared, "step", complaints)
    steps = None if words is None else steps_of(words, layout.lines, complaints)
    return Read(path, layout, declared, tests, steps, found, complaints)


def _converted(table: Read, known: dict[str, tuple[str, str]]) -> Measured:
    """In the columns of the contract, with the rows of other tests left out."""
    values = {what: column.values for what, column in table.columns.items()}
    unread = {what: column.unread for what, column in table.columns.items()}
    if table.declared.cell is not None:
        read = {c: values.pop(c) for c in (*FORCES, *MOMENTS) if c in values}
        values |= at_platform(table.declared.cell, read, table.layout.lines, table.complaints)
    lines = np.array(table.layout.lines, dtype=np.int64)
    columns = {known[what][1]: column for what, column in values.items() if known[what][1]}
    blank = {known[w][1]: mask for w, mask in unread.items() if known[w][1] and mask.any()}
    mine = np.array([test != "" for test in table.tests])
    whole = Measured(table.tests, table.steps, lines, columns, blank, _from_first(table, known))
    return fewer(whole.only(np.flatnonzero(mine)), table.declared.file.every)


def _from_first(table: Read, known: dict[str, tuple[str, str]]) -> frozenset[str]:
    """Columns of the contract that are less their first readings; all of a cell that is elsewhere, where one is."""
    of = {what for what, column in table.columns.items() if column.from_first}
    if table.declared.cell is not None and of.intersection((*FORCES, *MOMENTS)):
        of |= {*FORCES, *MOMENTS}
    return frozenset(known[what][1] for what in of if known[what][1])


def _words(table: Read) -> list[str]:
    out = [column.words for column in table.columns.values()]
    if (cell := table.declared.cell) is not None:
        out.append(
            f"cell at {list(cell.at_mm)} mm, turned by {list(cell.turned_deg)} degrees, sign {cell.sign}"
        )
    return out


def _joined(parts: Sequence[Measured]) -> Measured:
    if not parts:
        return Measured((), None, np.zeros(0, dtype=np.int64), {})
    columns = list(dict.fromkeys(column for part in parts for column in part.values))
    # Rows of one table without steps are in order; so are all then.
    ordered = any(part.steps is None for part in parts)
    return Measured(
        tuple(test for part in parts for test in part.tests),
        None if ordered else np.concatenate([p.steps for p in parts if p.steps is not None]),
        np.concatenate([part.lines for part in parts]),
        {column: np.concatenate([part.of(column) for part in parts]) for column in columns},
        {column: np.concatenate([part.blank(column) for part in parts]) for column in columns},
        frozenset().union(*(part.from_first for part in parts)),
    )
