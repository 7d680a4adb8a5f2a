"""What only the owner of a table knows, filled in: the text of a campaign with an answer for every question mark."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import tomlkit

from pipeline.campaign.mapped.layout import header_unit
from pipeline.campaign.names import COORDINATES, WRENCHES, known_columns
from pipeline.campaign.rigs import KINDS
from pipeline.init.campaign_file import campaign_text
from pipeline.init.found import Found
from pipeline.init.words import quantity_of

OPEN = "?"
WRENCH = tuple(name.partition("_")[0] for name in WRENCHES)
ALLOWED = {
    "length": ("x", "y", "z"),
    "angle": ("rx", "ry", "rz"),
    "force": WRENCH[:3],
    "moment": WRENCH[3:],
    "temperature": ("temperature",),
    "time": ("time",),
    "step": ("step",),
    "test": ("test",),
}
"""What a column of each quantity may be, beside being ignored; the axis is never guessed."""
EVERY = (*COORDINATES, *WRENCH, "temperature", "test", "step")


@dataclass(frozen=True)
class Asked:
    """A column of a file. values: a few of them. unit: as the file says it, "" where it does not. known: what its name
    says that it is, in the names of a campaign, or ""; then nothing is asked. choices: what it may be."""

    name: str
    values: str
    unit: str
    known: str
    choices: tuple[str, ...]


@dataclass(frozen=True)
class Column:
    """What its owner says of a column: what it is ("ignore" as well), its sign 1 or -1, its unit."""

    what: str
    sign: int
    unit: str


@dataclass(frozen=True)
class Run:
    """A test: its id, the posture (degrees, None where the rig has none), "fit" or "holdout", what controls each
    coordinate."""

    name: str
    posture: float | None
    role: str
    control: Mapping[str, str]


@dataclass(frozen=True)
class Choices:
    """All answers. rig: numbers by their key in [rig], a dot between a table and its key."""

    name: str
    kind: str
    rig: Mapping[str, float]
    columns: Mapping[str, Column]
    tests: tuple[Run, ...]
    vouched: bool = False


def asked_of(found: Found) -> tuple[Asked, ...]:
    """The columns of a file, each with what it may be."""
    out = []
    for k, (name, beside) in enumerate(zip(found.names, found.units, strict=True)):
        if not name or name in found.names[:k]:
            continue
        unit = header_unit(name)[1] or beside
        known = name if name in known_columns(()) else ""
        values = found.samples[k] if k < len(found.samples) else ""
        out.append(Asked(name, values, unit, known, ALLOWED.get(quantity_of(name, beside) or "", EVERY)))
    return tuple(out)


def questions_of(kind: str) -> tuple[str, ...]:
    """Keys of [rig] that only its owner knows, a dot between a table and its key."""
    table = tomlkit.parse(KINDS[kind].template).unwrap()
    return tuple(_open(table, ""))


def _open(table: Mapping[str, Any], before: str) -> Iterator[str]:
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _open(value, f"{before}{key}.")
        elif value == OPEN:
            yield f"{before}{key}"


def filled(file: str, found: Found, choices: Choices) -> str:
    """The text of campaign.toml, its explanations kept. file: beside it."""
    names = tuple(run.name for run in choices.tests)
    text = campaign_text(choices.name, choices.kind, file, _with_tests(found, names))
    document = tomlkit.parse(text)
    for path, value in choices.rig.items():
        *tables, key = path.split(".")
        place: Any = document["rig"]
        for each in tables:
            place = place[each]
        place[key] = value
    columns: Any = document.setdefault("columns", tomlkit.table())
    for name, column in choices.columns.items():
        entry = tomlkit.inline_table()
        entry["is"] = column.what
        if column.what != "ignore" and column.what not in ("test", "step", "time"):
            if column.sign != 1:
                entry["sign"] = column.sign
            if column.unit:
                entry["unit"] = column.unit
        columns[name] = entry
    if choices.vouched:
        document["tolerance"]["all"] = "exact"
    for table, run in zip(document["tests"], choices.tests, strict=True):
        _run(table, run)
    return tomlkit.dumps(document)


def _run(table: Any, run: Run) -> None:
    table["id"] = run.name
    if run.posture is not None:
        table["q_deg"] = run.posture
    table["role"] = run.role
    control = tomlkit.inline_table()
    for coordinate, by in run.control.items():
        control[coordinate] = by
    table["control"] = control


def _with_tests(found: Found, names: tuple[str, ...]) -> Found:
    return replace(found, tests=names)
