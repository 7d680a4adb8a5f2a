"""Which test a row belongs to: by a column, by its file or sheet, by blank rows, or because there is only one."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path

from pipeline.campaign.mapped.grid import Cell
from pipeline.campaign.mapped.layout import Layout, word
from pipeline.campaign.mapped.mapping import Source
from pipeline.campaign.mapped.readings import words_of
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.spelling import unknown_name


@dataclass
class Owners:
    """Of the rows of one source, table after table. blocks: of rows between blank ones that were met until now. names:
    of the files or sheets that were taken for tests."""

    source: Source
    blocks: int = 0
    names: dict[str, Path] = field(default_factory=dict)

    def of(self, path: Path, layout: Layout, complaints: Complaints) -> tuple[str, ...]:
        """The id of each row, "" for a row that another source has; complaints where that is not said."""
        found = self._found(path, layout, complaints)
        if self.source.own:
            return tuple(test if test in self.source.tests else "" for test in found)
        return tuple("" if test in self.source.elsewhere else test for test in found)

    def missing(self) -> str:
        """What is wrong with the number of blocks; empty where nothing is."""
        if self.source.declared.file.test_from != "blank_row" or not self.blocks:
            return ""
        count = len(self.source.tests)
        if self.blocks == count:
            return ""
        return (
            f"has {self.blocks} blocks of rows between blank rows, campaign.toml has {count} tests for them"
        )

    def _found(self, path: Path, layout: Layout, complaints: Complaints) -> tuple[str, ...]:
        how, count, tests = self.source.declared.file, len(layout.lines), self.source.tests
        column = None
        if how.test_column is not None:
            if how.test_column in layout.names:
                column = tuple(word(cell) for cell in layout.column(how.test_column))
            else:
                complaints.add("", f"has no column {shown(how.test_column)}, which test_column names")
        column = column or words_of(layout, self.source.declared, "test", complaints)
        if column is not None:
            _all_named(column, layout, how.test_column or self._column_of_tests(), complaints)
            return column
        if self.source.own:
            return tests * count
        if how.test_from in ("file", "sheet"):
            return (self._named(path, layout, how.test_from, complaints),) * count
        if how.test_from == "blank_row":
            before, self.blocks = self.blocks, self.blocks + max(layout.blocks) + 1
            return tuple(tests[min(before + block, len(tests) - 1)] for block in layout.blocks)
        if len(tests) > 1:
            said = "does not say which rows are of which test, write test_column or test_from under [file]"
            complaints.add("", said)
        return (tests[0] if tests else "",) * count

    def _column_of_tests(self) -> str:
        return next((name for name, it in self.source.declared.columns.items() if it.what == "test"), "test")

    def _named(self, path: Path, layout: Layout, by: str, complaints: Complaints) -> str:
        name = path.stem if by == "file" else layout.sheet
        every = (*self.source.tests, *self.source.elsewhere)
        if name not in every:
            complaints.add("", f"names test {shown(name)}, {unknown_name(name, every)}")
        other = self.names.setdefault(name, path)
        if by == "file" and other != path:
            said = f"has the name of {other}, so both would be test {shown(name)}"
            complaints.add("", f"{said}; allowed is one file for each")
        return name


def _all_named(tests: tuple[str, ...], layout: Layout, column: str, complaints: Complaints) -> None:
    """A complaint where rows with numbers have no test: they would be left out and nobody told."""
    lines = [
        line
        for test, line, *cells in zip(tests, layout.lines, *layout.cells, strict=True)
        if not test and any(map(_is_number, cells))
    ]
    if lines:
        rows = "this row has" if len(lines) == 1 else f"{len(lines)} rows from here on have"
        said = f"{rows} numbers and no test; where an empty cell repeats the one above, write fill_down = "
        complaints.add(f"column {shown(column)}", f"{said}[{shown(column)}] under [file]", lines[0])


def _is_number(cell: Cell) -> bool:
    try:
        return isfinite(float(word(cell).replace(",", ".")))
    except ValueError:
        return False
