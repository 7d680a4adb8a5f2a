"""What campaign.toml declares of its files: `[file]`, `[columns]`, `[cell]`, `[derived]`, and those of single tests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from pipeline.campaign.complaints import shown
from pipeline.campaign.mapped.mapping import Declared, Source, mistakes, quantities
from pipeline.campaign.mapped.schema import CellTable, ColumnTable, DerivedTable, FileTable

Raw = dict[str, Any]
TABLES = ("file", "columns", "cell", "derived")


@dataclass(frozen=True)
class Sources:
    """raw: the whole file. gauges: names. checked: a table by its schema, None with complaints where it is none. say: a
    complaint about a key."""

    raw: Raw
    gauges: Sequence[str]
    checked: Callable[[type, Raw, tuple[str | int, ...], str], Any]
    say: Callable[[tuple[str | int, ...], str, str], None]

    def found(self) -> tuple[Source, ...]:
        """The sources; none where nothing is declared."""
        tests = [test for test in self.raw.get("tests", []) if isinstance(test, dict)]
        own = [bool(test.get("file") or test.get("columns")) for test in tests]
        if not any(self.raw.get(name) for name in TABLES) and not any(own):
            return ()
        out = []
        if not all(own):
            out.append(self._source((), self.raw.get("file", {}), self.raw.get("columns", {}), ""))
        for k, (test, mine) in enumerate(zip(tests, own, strict=True)):
            if not mine:
                continue
            path = ("tests", k)
            name = str(test.get("id", k))
            if "path" not in test.get("file", {}):
                self.say(
                    (*path, "file"),
                    "has no path, a test with a file or columns of its own needs it",
                    f"test {name}",
                )
            file = {**self.raw.get("file", {}), **test.get("file", {})}
            columns = {**self.raw.get("columns", {}), **test.get("columns", {})}
            out.append(self._source(path, file, columns, name))
        return tuple(each for each in out if each is not None)

    def _source(self, path: tuple[str | int, ...], file: Raw, columns: Raw, test: str) -> Source | None:
        place = f"test {shown(test)}, " if test else ""
        how = self.checked(FileTable, file, (*path, "file"), f"{place}file")
        tables: dict[str, ColumnTable] = {}
        known = quantities(self.gauges)
        for name, raw in columns.items():
            where = f"{place}columns.{shown(name)}"
            it = self.checked(ColumnTable, raw, (*path, "columns", name), where)
            if it is None:
                continue
            tables[name] = it
            for said in mistakes(name, it, known):
                self.say((*path, "columns", name), said, where)
        cell = self.raw.get("cell")
        turned = None if cell is None else self.checked(CellTable, cell, ("cell",), "cell")
        derived = {
            name: self.checked(DerivedTable, raw, ("derived", name), f"derived.{name}")
            for name, raw in self.raw.get("derived", {}).items()
        }
        if how is None:
            return None
        return Source(
            Declared(how, tables, turned, {k: v for k, v in derived.items() if v is not None}), test
        )
