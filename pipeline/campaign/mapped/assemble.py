"""The files of a campaign as readings: each found, laid out, converted, and parted into tests."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from glob import escape, glob
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.complaints import Complaints, shown
from pipeline.campaign.formats import grids
from pipeline.campaign.mapped.cell import at_platform
from pipeline.campaign.mapped.chosen import fewer, in_order
from pipeline.campaign.mapped.grid import BadTable
from pipeline.campaign.mapped.layout import Layout, laid_out
from pipeline.campaign.mapped.mapping import FORCES, MOMENTS, Declared, Source, quantities
from pipeline.campaign.mapped.readings import Column, columns_of, derived_of, words_of
from pipeline.campaign.measured import Measured
from pipeline.campaign.names import unknown_name

Array = NDArray[np.float64]
LARGEST = 2**30
"""Bytes of a file."""


def measured(
    folder: Path, default: str, sources: Sequence[Source], ids: Sequence[str], gauges: Iterable[str]
) -> tuple[Measured, tuple[str, ...], list[str], list[Path]]:
    """All readings, how they were converted, complaints, and the files. default: the one where none is named."""
    names = tuple(gauges)
    parts: list[Measured] = []
    words: dict[str, None] = {}
    said: list[str] = []
    files: list[Path] = []
    for source in sources:
        for path in _paths(folder, source.declared.file.path or default, said):
            complaints = Complaints(str(path))
            files.append(path)
            for part, how in _of_file(path, source, ids, names, complaints):
                parts.append(part)
                words |= dict.fromkeys(how)
            said += complaints.sentences()
    return _joined(parts), tuple(words), said, list(dict.fromkeys(files))


def _paths(folder: Path, pattern: str, said: list[str]) -> list[Path]:
    if any(mark in pattern for mark in "*?["):
        found = sorted(Path(each) for each in glob(str(Path(escape(str(folder))) / pattern), recursive=True))
        if not found:
            said.append(f"{folder / pattern}: no file is named like that")
        return [path for path in found if path.is_file()]
    path = folder / pattern
    if not path.is_file():
        said.append(f"{path}: {'is missing' if not path.exists() else 'is no file'}")
        return []
    return [path]


def _of_file(
    path: Path, source: Source, ids: Sequence[str], gauges: tuple[str, ...], complaints: Complaints
) -> Iterable[tuple[Measured, list[str]]]:
    if (size := path.stat().st_size) > LARGEST:
        complaints.add("", f"has {size / 2**20:.0f} MB, allowed are {LARGEST / 2**20:.0f}")
        return
    try:
        tables = grids(path, source.declared.file)
    except BadTable as error:
        complaints.add("", str(error), error.line)
        return
    except OSError as error:
        complaints.add("", f"cannot be read: {error.strerror}")
        return
    for grid in tables:
        layout = laid_out(grid, source.declared.file, complaints)
        if layout is not None:
            yield _of_table(path, layout, source, ids, gauges, complaints)


def _of_table(
    path: Path,
    layout: Layout,
    source: Source,
    ids: Sequence[str],
    gauges: tuple[str, ...],
    complaints: Complaints,
) -> tuple[Measured, list[str]]:
    known, declared = quantities(gauges), source.declared
    found = columns_of(layout, declared, known, complaints)
    for what, column in derived_of(layout, declared, known, complaints).items():
        if what in found:
            said = f"is column {shown(found[what].name)} and under [derived], allowed is one of the two"
            complaints.add(f"derived.{what}", said)
        found[what] = column
    tests = _tests(path, layout, source, ids, complaints)
    values = {what: _zeroed(column, tests) for what, column in found.items()}
    words = [column.words for column in found.values()]
    if declared.cell is not None:
        read = {c: values.pop(c) for c in (*FORCES, *MOMENTS) if c in values}
        values |= at_platform(declared.cell, read, complaints)
        at, turned = declared.cell.at_mm, declared.cell.turned_deg
        words.append(f"cell at {list(at)} mm, turned by {list(turned)} degrees, sign {declared.cell.sign}")
    columns = {known[what][1]: column for what, column in values.items() if known[what][1]}
    steps = _steps(layout, declared, complaints)
    in_order(layout, declared.file.time_column, tests, complaints)
    every = Measured(tests, steps, np.array(layout.lines, dtype=np.int64), columns)
    return fewer(every, declared.file.every), words


def _tests(
    path: Path, layout: Layout, source: Source, ids: Sequence[str], complaints: Complaints
) -> tuple[str, ...]:
    how, count = source.declared.file, len(layout.lines)
    column = None
    if how.test_column is not None:
        if how.test_column in layout.names:
            column = tuple(str(cell).strip() for cell in layout.column(how.test_column))
        else:
            complaints.add("", f"has no column {shown(how.test_column)}, which test_column names")
    column = column or words_of(layout, source.declared, "test")
    if column is not None:
        return column
    if source.test:
        return (source.test,) * count
    if how.test_from in ("file", "sheet"):
        name = path.stem if how.test_from == "file" else layout.sheet
        if name not in ids:
            complaints.add("", f"names test {shown(name)}, {unknown_name(name, ids)}")
        return (name,) * count
    if how.test_from == "blank_row":
        blocks = max(layout.blocks) + 1
        if blocks != len(ids):
            said = f"has {blocks} blocks of rows between blank rows, campaign.toml has {len(ids)} tests"
            complaints.add("", said)
        return tuple(ids[min(block, len(ids) - 1)] for block in layout.blocks)
    if len(ids) > 1:
        said = "does not say which rows are of which test, write test_column or test_from under [file]"
        complaints.add("", said)
    return (ids[0] if ids else "",) * count


def _zeroed(column: Column, tests: tuple[str, ...]) -> Array:
    """The readings less the first one of each test, where that was declared to be zero."""
    if not column.from_first:
        return column.values
    out = column.values.copy()
    names = np.array(tests)
    for name in dict.fromkeys(tests):
        mine = np.flatnonzero(names == name)
        read = mine[np.isfinite(out[mine])]
        if read.size:
            out[mine] -= column.values[read[0]]
    return out


def _steps(layout: Layout, declared: Declared, complaints: Complaints) -> Array | None:
    words = words_of(layout, declared, "step")
    if words is None:
        return None
    steps = np.full(len(words), np.nan)
    for k, text in enumerate(words):
        if text.isascii() and text.isdigit() and len(text) <= 9:
            steps[k] = int(text)
        else:
            complaints.add(
                "column step", f"holds {shown(text)}, allowed is a whole number from 0", layout.lines[k]
            )
    return steps


def _joined(parts: Sequence[Measured]) -> Measured:
    columns = list(dict.fromkeys(column for part in parts for column in part.values))
    # Rows of one table without steps are in order; so are all then.
    ordered = any(part.steps is None for part in parts)
    return Measured(
        tuple(test for part in parts for test in part.tests),
        None if ordered or not parts else np.concatenate([p.steps for p in parts if p.steps is not None]),
        np.concatenate([part.lines for part in parts]) if parts else np.zeros(0, dtype=np.int64),
        {column: np.concatenate([part.of(column) for part in parts]) for column in columns},
    )
