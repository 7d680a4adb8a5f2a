"""campaign.toml with single values written otherwise; all else stays as it is, comments too."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError

from pipeline.campaign.mapped.mapping import quantities
from pipeline.campaign.mapped.units import QUANTITIES
from pipeline.campaign.model import Array, Campaign
from pipeline.errors import InputError

SAME = 1e-7
"""Of the largest reading of a channel: what is less is rounding, a factor of units has eight digits."""
Key = Literal["sign", "unit", "zero", "is", "q_deg"]


@dataclass(frozen=True)
class Change:
    """Of a column of the contract, by its name (fy_N): "sign" turns its sign, "unit" is another unit, "is" another
    column that it is, "zero" the reading that is its zero. Of a test, by its id: "q_deg" its angle, "zero" as in
    `[[tests]]`. of: what `name` is the name of."""

    of: Literal["columns", "tests"]
    name: str
    key: Key
    value: Any = None


def changed(text: str, changes: Sequence[Change]) -> tuple[str, tuple[str, ...]]:
    """The text with these changes, and each as the line that it is written in. InputError for what is no TOML."""
    document = parsed(text)
    # Two columns that are exchanged are both looked up before either is written.
    found = [(each, list(_places(document, each))) for each in changes]
    lines = [_written(document, each, places) for each, places in found]
    return tomlkit.dumps(document), tuple(dict.fromkeys(line for line in lines if line))


def checked(text: str) -> str:
    """The text with `table_checked = true` above its tables. InputError for what is no TOML."""
    document = parsed(text)
    document["table_checked"] = True
    return tomlkit.dumps(document)


Counts = Literal["set_aside", "keep", "as it is"]


def with_reading(text: str, test: str, step: int, column: str, counts: Counts) -> str:
    """The text with one reading set aside, kept, or left to whoever looks at it. InputError for what is no TOML."""
    document = parsed(text)
    for each in (it for it in tests_of(document) if it.get("id") == test):
        for key in ("set_aside", "keep"):
            cells = {name: list(steps) for name, steps in each.get(key, {}).items()}
            steps = [it for it in cells.pop(column, []) if it != step] + [step] * (key == counts)
            cells |= {column: sorted(steps)} if steps else {}
            if cells:
                each[key] = tomlkit.inline_table()
                each[key].update(cells)
            elif key in each:
                del each[key]
    return tomlkit.dumps(document)


def parsed(text: str) -> tomlkit.TOMLDocument:
    """A document to be edited. InputError for what is no TOML."""
    try:
        return tomlkit.parse(text)
    except TOMLKitError as error:
        raise InputError(f"campaign.toml is no TOML: {error}") from error


def tests_of(document: tomlkit.TOMLDocument) -> list[Any]:
    """The tables of `[[tests]]`."""
    return list(document.get("tests", []))


def _known(document: tomlkit.TOMLDocument) -> dict[str, tuple[str, str]]:
    """By the column of the contract: what it is, and its quantity."""
    gauges = [str(it["name"]) for it in document.get("gauges", []) if "name" in it]
    return {column: (what, quantity) for what, (quantity, column) in quantities(gauges).items() if column}


def _places(document: tomlkit.TOMLDocument, it: Change) -> Iterator[tuple[str, Any]]:
    """Where it is said already: the name of each table in the file, and the table."""
    if it.of == "tests":
        yield from ((it.name, test) for test in tests_of(document) if test.get("id") == it.name)
        return
    what = _known(document)[it.name][0]
    for holder in (document, *tests_of(document)):
        for name, entry in holder.get("columns", {}).items():
            if entry.get("is") == what:
                yield name, entry


def _written(document: tomlkit.TOMLDocument, it: Change, places: list[tuple[str, Any]]) -> str:
    """Writes a change; the line, as somebody would write it."""
    if it.of == "tests":
        for _, test in places:
            test[it.key] = it.value
        return f"[[tests]] {it.name}: {it.key} = {tomlkit.item(it.value).as_string()}"
    known = _known(document)
    if not places:
        what, quantity = known[it.name]
        entry = tomlkit.inline_table()
        entry["is"] = what
        if it.key == "is":
            entry["unit"] = QUANTITIES[quantity]
        document.setdefault("columns", tomlkit.table())[it.name] = entry
        places = [(it.name, document["columns"][it.name])]
    for _, entry in places:
        if it.key == "sign":
            entry["sign"] = -int(entry.get("sign", 1))
        else:
            entry[it.key] = known[it.value][0] if it.key == "is" else it.value
    name, entry = places[0]
    shown = tomlkit.inline_table()
    shown.update(entry)
    return f"[columns] {tomlkit.key(name).as_string().strip()} = {shown.as_string()}"


def same(one: Campaign, other: Campaign) -> bool:
    """Whether all readings and postures of two campaigns with the same tests are the same."""
    return all(
        np.isclose(a.q, b.q, rtol=SAME, atol=0.0) and _same(a.data.readings, b.data.readings)
        for a, b in zip(one.tests, other.tests, strict=True)
    )


def _same(one: Array, other: Array) -> bool:
    largest = np.max(np.abs(np.nan_to_num(other)), axis=0, initial=0.0)
    return bool(np.all(np.isclose(one, other, rtol=0.0, atol=SAME * largest, equal_nan=True)))
