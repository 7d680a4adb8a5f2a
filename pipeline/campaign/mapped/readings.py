"""From the columns of a table to readings in the units of the contract, by what is declared of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.complaints import Complaints, shown
from pipeline.campaign.mapped.grid import Cell
from pipeline.campaign.mapped.layout import Layout, header_unit
from pipeline.campaign.mapped.mapping import Declared, unit_of
from pipeline.campaign.mapped.numbers import Marks, decimal_of, is_missing
from pipeline.campaign.mapped.schema import ColumnTable
from pipeline.campaign.mapped.units import NoUnit, unit
from pipeline.campaign.sheet import EACH, LARGEST

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Column:
    """A column as it is read. what: as in `is`. values: (rows) in the unit of the contract, NaN where nothing is read,
    before a zero of the first row is taken away. words: how it was converted."""

    name: str
    what: str
    values: Array
    from_first: bool
    words: str


def columns_of(
    layout: Layout, declared: Declared, known: Mapping[str, tuple[str, str]], complaints: Complaints
) -> dict[str, Column]:
    """Every measured column by what it is; complaints about those that cannot be read."""
    used = _used(layout, declared, known, complaints)
    marks = _marks(layout, declared, [name for name, _ in used], complaints)
    found: dict[str, Column] = {}
    for name, it in used:
        if it.what in found:
            said = f"is {it.what}, as column {shown(found[it.what].name)} is; allowed is each once"
            complaints.add(f"column {shown(name)}", said)
            continue
        column = _column(layout, name, it, marks, known, declared, complaints)
        if column is not None:
            found[it.what] = column
    return found


def words_of(layout: Layout, declared: Declared, what: str) -> tuple[str, ...] | None:
    """The text of the column that is declared to be the test or the step; None where none is."""
    names = [name for name, it in declared.columns.items() if it.what == what and name in layout.names]
    if not names and what in layout.names and what not in declared.columns:
        names = [what]
    if not names:
        return None
    return tuple(_word(cell) for cell in layout.column(names[0]))


def _used(
    layout: Layout, declared: Declared, known: Mapping[str, tuple[str, str]], complaints: Complaints
) -> list[tuple[str, ColumnTable]]:
    """Columns that are measured, with what they are; those with a name of the contract need not be declared."""
    contract = {column: what for what, (_, column) in known.items() if column}
    parts = {name for it in (declared.derived or {}).values() for name in it.of}
    extra = {declared.file.test_column, declared.file.time_column}
    used = []
    for name in declared.columns:
        if name not in layout.names:
            there = ", ".join(shown(each) for each in layout.names if each)
            complaints.add(f"column {shown(name)}", f"is not in the file, which has {there}")
        elif name in parts:
            complaints.add(
                f"column {shown(name)}", "is used by [derived] already, allowed is one use of each"
            )
    for name in layout.names:
        it = declared.columns.get(name)
        if it is None and name in contract:
            it = ColumnTable.model_validate({"is": contract[name]})
        if it is not None:
            if it.what in known and it.what != "time":
                used.append((name, it))
        elif name and name not in parts | extra and name not in ("test", "step"):
            said = (
                f'is not declared, write under [columns]: {_quoted(name)} = {{ is = ... }}, or is = "ignore"'
            )
            complaints.add(f"column {shown(name)}", said, declared.file.header_row or None)
    return used


def _marks(layout: Layout, declared: Declared, names: list[str], complaints: Complaints) -> Marks:
    parts = [name for it in (declared.derived or {}).values() for name in it.of if name in layout.names]
    texts = (c for name in [*names, *parts] for c in layout.column(name) if isinstance(c, str))
    marks = decimal_of(texts, declared.file.decimal, declared.file.thousands)
    if isinstance(marks, str):
        complaints.add("", marks)
        return Marks(".", "")
    return marks


def _column(
    layout: Layout,
    name: str,
    it: ColumnTable,
    marks: Marks,
    known: Mapping[str, tuple[str, str]],
    declared: Declared,
    complaints: Complaints,
) -> Column | None:
    quantity, contract = known[it.what]
    beside = layout.units[layout.names.index(name)]
    inside = header_unit(name)[1]
    found = unit_of(it, name, beside, inside, quantity, contract)
    if isinstance(found, str):
        complaints.add(f"column {shown(name)}", found, declared.file.header_row or None)
        return None
    read = numbers(layout, name, marks, declared.file.missing, complaints)
    zero = 0.0 if it.zero == "first_row" else float(it.zero)
    sign = -1.0 if it.sign == -1 else 1.0
    values = sign * (read - zero) * found.factor + found.offset
    words = f"{it.what} = {'-' if it.sign == -1 else ''}{shown(name)}"
    words += (
        " less its first row in each test" if it.zero == "first_row" else f" less {zero:g}" if zero else ""
    )
    if found.factor != 1.0 or found.offset:
        words += f", {found.words}"
    return Column(name, it.what, values, it.zero == "first_row", words)


def numbers(
    layout: Layout, name: str, marks: Marks, missing: tuple[str, ...], complaints: Complaints
) -> Array:
    """A column (rows) as numbers, NaN where nothing is read; complaints about cells that are neither."""
    cells = layout.column(name)
    values = np.full(len(cells), np.nan)
    bad: list[tuple[int, str]] = []
    for k, cell in enumerate(cells):
        if isinstance(cell, float):
            number: float | None = cell
        elif is_missing(cell, missing):
            continue
        else:
            number = marks.number(cell.strip())
        if number is None or not (abs(number) <= LARGEST or number != number):
            bad.append((layout.lines[k], str(cell).strip()))
        else:
            values[k] = number
    for line, text in bad[:EACH]:
        allowed = (
            f"allowed is a number with a decimal {'comma' if marks.decimal == ',' else 'point'}, or nothing"
        )
        complaints.add(
            f"column {shown(name)}", f"holds {shown(text)}, {allowed}; a word for no reading: missing", line
        )
    if more := bad[EACH:]:
        complaints.add(f"column {shown(name)}", f"{len(more)} more such cells below", more[0][0])
    return values


def derived_of(
    layout: Layout, declared: Declared, known: Mapping[str, tuple[str, str]], complaints: Complaints
) -> dict[str, Column]:
    """Coordinates that are a weighted sum of columns, or the angle that it spans over a distance."""
    found = {}
    names = [name for it in (declared.derived or {}).values() for name in it.of]
    marks = _marks(layout, declared, [], complaints)
    for what, it in (declared.derived or {}).items():
        place = f"derived.{what}"
        if what not in known or what == "time":
            complaints.add(place, f"is unknown, allowed are {', '.join(k for k in known if k != 'time')}")
            continue
        absent = [name for name in it.of if name not in layout.names]
        if absent or not it.of:
            complaints.add(
                place, f"needs {', '.join(map(shown, absent)) or 'columns'}, which the file does not have"
            )
            continue
        try:
            each = unit(it.unit, "length" if it.over_mm is not None else known[what][0])
        except NoUnit as error:
            complaints.add(place, f"unit: {error}")
            continue
        parts = [numbers(layout, name, marks, declared.file.missing, complaints) for name in it.of]
        total = sum(weight * part for weight, part in zip(it.of.values(), parts, strict=True)) * each.factor
        words = " + ".join(f"{weight:g} {shown(name)}" for name, weight in it.of.items())
        if it.over_mm is None:
            found[what] = Column(what, what, np.asarray(total), False, f"{what} = {words} in {each.spelling}")
        else:
            said = f"{what} = atan of ({words} in {each.spelling}) over {it.over_mm:g} mm"
            found[what] = Column(what, what, np.arctan(np.asarray(total) / it.over_mm), False, said)
    if twice := {name for name in names if names.count(name) > 1}:
        complaints.add(
            "derived", f"uses {', '.join(sorted(map(shown, twice)))} twice, allowed is one use of each"
        )
    return found


def _word(cell: Cell) -> str:
    if isinstance(cell, float):
        return f"{cell:.0f}" if cell.is_integer() else repr(cell)
    return cell.strip()


def _quoted(name: str) -> str:
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
