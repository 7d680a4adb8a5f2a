"""From the columns of a table to readings in the units of the contract, by what is declared of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.mapped.layout import Layout, header_unit, word
from pipeline.campaign.mapped.mapping import Declared, unit_of
from pipeline.campaign.mapped.numbers import Marks, decimal_of, is_empty, is_word
from pipeline.campaign.mapped.schema import ColumnTable, DerivedTable
from pipeline.campaign.mapped.units import UNITS, NoUnit, Unit, unit
from pipeline.campaign.sheet import LARGEST, told
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.spelling import unknown_name

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Known = Mapping[str, tuple[str, str]]
KEYS = ("test", "step")


@dataclass(frozen=True, eq=False)
class Column:
    """A column as it is read. what: as in `is`. values: (rows) in the unit of the contract, NaN where nothing is read,
    before a zero of the first row is taken away. unread: (rows) where a word stands for no reading. words: how it was
    converted."""

    name: str
    what: str
    values: Array
    unread: Mask
    from_first: bool
    words: str


def columns_of(layout: Layout, declared: Declared, known: Known, complaints: Complaints) -> dict[str, Column]:
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


def words_of(layout: Layout, declared: Declared, what: str, complaints: Complaints) -> tuple[str, ...] | None:
    """The text of the column that is declared to be the test or the step; None where none is."""
    names = [name for name, it in declared.columns.items() if it.what == what and name in layout.names]
    if not names and what in layout.names and what not in declared.columns:
        names = [what]
    if not names:
        return None
    if len(names) > 1:
        complaints.add(
            f"column {shown(names[1])}", f"is {what}, as column {shown(names[0])} is; allowed is each once"
        )
    return tuple(word(cell) for cell in layout.column(names[0]))


def _used(
    layout: Layout, declared: Declared, known: Known, complaints: Complaints
) -> list[tuple[str, ColumnTable]]:
    """Columns that are measured, with what they are; those with a name of the contract need not be declared."""
    contract = {column: what for what, (_, column) in known.items() if column}
    parts = _parts(declared)
    extra = {declared.file.test_column, declared.file.time_column}
    used = []
    for name, it in declared.columns.items():
        if name not in layout.names and it.what != "ignore":
            said = f"is under [columns] and not in the file, {unknown_name(name, layout.names)}"
            complaints.add(f"column {shown(name)}", said)
        elif name in parts:
            said = "is used by [derived] already, allowed is one use of each: delete its line here or there"
            complaints.add(f"column {shown(name)}", said)
    for name in layout.names:
        own = declared.columns.get(name)
        if own is None and name in contract:
            own = ColumnTable.model_validate({"is": contract[name]})
            if name in parts:
                said = f"is {contract[name]} by its name and used by [derived], allowed is one use of each"
                complaints.add(f"column {shown(name)}", said)
        if own is not None:
            if own.what in known and own.what != "time":
                used.append((name, own))
        elif name not in parts | extra and name not in KEYS and not _nothing(layout, name):
            said = (
                f'is not declared, write under [columns]: {_quoted(name)} = {{ is = ... }}, or is = "ignore"'
            )
            complaints.add(f"column {shown(name)}", said, declared.file.header_row or None)
    return used


def _nothing(layout: Layout, name: str) -> bool:
    """Whether a column has neither a name of its own nor any cell."""
    return name.startswith("#") and all(is_empty(cell) for cell in layout.column(name))


def _parts(declared: Declared) -> set[str]:
    return {name for it in (declared.derived or {}).values() for name in it.of}


def _marks(layout: Layout, declared: Declared, names: list[str], complaints: Complaints) -> Marks:
    every = [
        *names,
        *(name for name in sorted(_parts(declared)) if name in layout.names and name not in names),
    ]
    texts = [c for name in every for c in layout.column(name) if isinstance(c, str)]
    texts = [c for c in texts if not is_word(c, declared.file.missing)]
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
    known: Known,
    declared: Declared,
    complaints: Complaints,
) -> Column | None:
    quantity, contract = known[it.what]
    found = unit_of(it, name, *written(layout, name), quantity, contract)
    if isinstance(found, str):
        complaints.add(f"column {shown(name)}", found, declared.file.header_row or None)
        return None
    read, unread = numbers(layout, name, marks, declared.file.missing, complaints)
    zero = it.zero if isinstance(it.zero, float | int) else 0.0
    sign = -1.0 if it.sign == -1 else 1.0
    values = sign * (read - zero) * found.factor + found.offset
    words = f"{it.what} = {'-' if it.sign == -1 else ''}{shown(name)}"
    words += (
        " less its first row in each test" if it.zero == "first_row" else f" less {zero:g}" if zero else ""
    )
    if found.factor != 1.0 or found.offset:
        words += f", {found.words}"
    return Column(name, it.what, values, unread, it.zero == "first_row", words)


def written(layout: Layout, name: str) -> tuple[str, str]:
    """The unit of a column in the row of units, and in its header."""
    return layout.units[layout.names.index(name)], header_unit(name)[1]


def numbers(
    layout: Layout, name: str, marks: Marks, missing: tuple[str, ...], complaints: Complaints
) -> tuple[Array, Mask]:
    """A column (rows,) as numbers, NaN where nothing is read, and the rows with a word for that; complaints about cells
    that are neither."""
    cells = layout.column(name)
    values, unread = np.full(len(cells), np.nan), np.zeros(len(cells), dtype=bool)
    bad: list[tuple[int, str]] = []
    for k, cell in enumerate(cells):
        if is_empty(cell):
            continue
        if is_word(cell, missing):
            unread[k] = True
            continue
        number = cell if isinstance(cell, float) else marks.number(cell)
        if number is None or not abs(number) <= LARGEST:
            bad.append((layout.lines[k], str(cell).strip()))
        else:
            values[k] = number
    mark = "comma" if marks.decimal == "," else "point"
    said = f"allowed is a number with a decimal {mark}, or nothing; a word for no reading: missing"
    told(shown(name), bad, lambda _: said, complaints)
    return values, unread


def derived_of(layout: Layout, declared: Declared, known: Known, complaints: Complaints) -> dict[str, Column]:
    """Coordinates that are a weighted sum of columns, or the angle that it spans over a distance."""
    found = {}
    every = [name for it in (declared.derived or {}).values() for name in it.of]
    used = [name for name, it in declared.columns.items() if it.what in known and name in layout.names]
    # The question about the decimal mark is asked with the columns already.
    marks = _marks(layout, declared, used, Complaints(complaints.file))
    for what, it in (declared.derived or {}).items():
        column = _derived(layout, what, it, marks, declared, known, complaints)
        if column is not None:
            found[what] = column
    if twice := {name for name in every if every.count(name) > 1}:
        complaints.add(
            "derived", f"uses {', '.join(sorted(map(shown, twice)))} twice, allowed is one use of each"
        )
    return found


def _derived(
    layout: Layout,
    what: str,
    it: DerivedTable,
    marks: Marks,
    declared: Declared,
    known: Known,
    complaints: Complaints,
) -> Column | None:
    place = f"derived.{what}"
    quantity = known.get(what, ("time", ""))[0]
    absent = [name for name in it.of if name not in layout.names]
    said = ""
    if quantity == "time":
        said = f"is unknown, allowed are {', '.join(k for k in known if k != 'time')}"
    elif absent or not it.of:
        said = f"needs {', '.join(map(shown, absent)) or 'columns'}, which the file does not have"
    elif it.over_mm is not None and quantity != "angle":
        said = f"has over_mm, which gives an angle, but {what} is a {quantity}"
    each = said or _unit_of_parts(layout, it, "length" if it.over_mm is not None else quantity)
    if isinstance(each, str):
        complaints.add(place, each)
        return None
    total, unread = np.zeros(len(layout.lines)), np.zeros(len(layout.lines), dtype=bool)
    for name, weight in it.of.items():
        values, blank = numbers(layout, name, marks, declared.file.missing, complaints)
        total = total + weight * (values * each.factor + each.offset)
        unread |= blank
    words = " + ".join(f"{weight:g} {shown(name)}" for name, weight in it.of.items())
    if it.over_mm is None:
        return Column(what, what, total, unread, False, f"{what} = {words} in {each.spelling}")
    words = f"{what} = atan of ({words} in {each.spelling}) over {it.over_mm:g} mm"
    return Column(what, what, np.arctan(total / it.over_mm), unread, False, words)


def _unit_of_parts(layout: Layout, it: DerivedTable, quantity: str) -> Unit | str:
    """The unit of the columns of a sum, or what is wrong: what the file says of each is compared."""
    try:
        unit(it.unit, quantity)
    except NoUnit as error:
        return f"unit: {error}"
    own = ColumnTable.model_validate({"is": "x", "unit": it.unit})
    for name in it.of:
        found = unit_of(own, name, *written(layout, name), quantity, "")
        if isinstance(found, str):
            return f"column {shown(name)} {found}"
    return UNITS[unit(it.unit, quantity).spelling]


def _quoted(name: str) -> str:
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
