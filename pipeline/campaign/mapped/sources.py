"""What campaign.toml declares of its files: `[file]`, `[columns]`, `[cell]`, `[derived]`, and those of single tests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from pipeline.campaign.mapped.mapping import Declared, Source, mistakes, quantities
from pipeline.campaign.mapped.schema import CellTable, ColumnTable, DerivedTable, FileTable
from pipeline.toml.complaints import shown

Raw = dict[str, Any]
TABLES = ("file", "columns", "cell", "derived")
RESERVED = ("time", "temperature", "test", "step", "ignore")


@dataclass(frozen=True)
class Sources:
    """raw: the whole file. gauges: names. checked: a table by its schema, None with complaints where it is none. say: a
    complaint about a key."""

    raw: Raw
    gauges: Sequence[str]
    checked: Callable[[type, Raw, tuple[str | int, ...], str], Any]
    complain: Callable[[tuple[str | int, ...], str, str], None]

    def found(self) -> tuple[Source, ...]:
        """The sources; none where nothing is declared."""
        tests = [test for test in self.raw.get("tests", []) if isinstance(test, dict)]
        own = [bool(_table(test, "file") or _table(test, "columns")) for test in tests]
        if not any(self.raw.get(name) for name in TABLES) and not any(own):
            return ()
        taken = [name for name in self.gauges if name in RESERVED]
        for name in taken:
            said = f"a gauge named {name} cannot be told from that in [columns], allowed is another name"
            self.complain(("gauges",), said, "gauges")
        names = [str(test.get("id", k)) for k, test in enumerate(tests)]
        elsewhere = tuple(name for name, mine in zip(names, own, strict=True) if mine)
        rest = tuple(name for name in names if name not in elsewhere)
        out = []
        if rest:
            out.append(
                self._source((), _table(self.raw, "file"), _table(self.raw, "columns"), rest, elsewhere)
            )
        for k, (test, name, mine) in enumerate(zip(tests, names, own, strict=True)):
            if not mine:
                continue
            path = ("tests", k)
            if "path" not in _table(test, "file"):
                said = "has no path, a test with a file or columns of its own needs it"
                self.complain((*path, "file"), said, f"test {shown(name)}, file")
            file = {**_table(self.raw, "file"), **_table(test, "file")}
            columns = {**_table(self.raw, "columns"), **_table(test, "columns")}
            out.append(self._source(path, file, columns, (name,), None))
        return tuple(each for each in out if each is not None)

    def _source(
        self,
        path: tuple[str | int, ...],
        file: Raw,
        columns: Raw,
        tests: tuple[str, ...],
        elsewhere: tuple[str, ...] | None,
    ) -> Source | None:
        """elsewhere: ids of the tests with files of their own; None for one of these."""
        place = f"test {shown(tests[0])}, " if elsewhere is None else ""
        how = self.checked(FileTable, file, (*path, "file"), f"{place}file")
        tables: dict[str, ColumnTable] = {}
        known, whole = quantities(self.gauges), True
        for name, raw in columns.items():
            where = f"{place}columns.{shown(name)}"
            it = self.checked(ColumnTable, raw, (*path, "columns", name), where)
            if it is None:
                whole = False
                continue
            found = mistakes(name, it, known)
            for said in found:
                self.complain((*path, "columns", name), said, where)
            # The rest of the table can be looked at without it.
            tables[name] = ColumnTable.model_validate({"is": "ignore"}) if found else it
            whole = whole and not found
        cell = self.raw.get("cell") if isinstance(self.raw.get("cell"), dict) else None
        turned = None if cell is None else self.checked(CellTable, cell, ("cell",), "cell")
        derived = {
            name: self.checked(DerivedTable, raw, ("derived", name), f"derived.{name}")
            for name, raw in _table(self.raw, "derived").items()
        }
        if how is None:
            return None
        sums = {k: v for k, v in derived.items() if v is not None} if whole else {}
        declared = Declared(how, tables, turned if whole else None, sums)
        return Source(declared, tests, elsewhere is None, elsewhere or ())


def _table(raw: Raw, name: str) -> Raw:
    """A table; empty where there is none, or something else, which its schema has refused."""
    found = raw.get(name, {})
    return found if isinstance(found, dict) else {}
