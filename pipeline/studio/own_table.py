"""A table that is to become a campaign, as plain values for the page, and what was answered there."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pipeline.campaign.names import COORDINATES, FORCE
from pipeline.campaign.rigs import KINDS
from pipeline.errors import InputError
from pipeline.init.choices import Asked, Choices, Column, Run, asked_of, questions_of
from pipeline.init.found import Found
from pipeline.studio.preview import Preview

NOTHING: dict[str, Any] = {"head": [], "rows": [], "said": []}
OWN = "?"
SKIP = "ignore"
MINUS = "\u2212"
WORDS = {
    OWN: "choose ...",
    SKIP: "nothing of it",
    **{name: f"displacement along {name}" for name in "xyz"},
    **{f"r{name}": f"rotation about {name}" for name in "xyz"},
    **{f"f{name}": f"force along {name}" for name in "xyz"},
    **{f"m{name}": f"moment about {name}" for name in "xyz"},
    "temperature": "temperature",
    "time": "time",
    "step": "number of the load step",
    "test": "name of the test",
}
RIG = {
    "length_mm": "length of a bar, mm",
    "width_mm": "distance of the bars, mm",
    "bar.EA_N": "axial stiffness EA of one bar, N",
    "bar.EIy_Nmm2": "bending stiffness EI about y, N\u00b7mm\u00b2",
    "bar.EIz_Nmm2": "bending stiffness EI about z, N\u00b7mm\u00b2",
    "bar.GJ_Nmm2": "torsional stiffness GJ, N\u00b7mm\u00b2",
}
"""Questions about a rig in words."""
KNOWN = tuple(kind for kind in KINDS if set(questions_of(kind)) <= set(RIG))
"""Kinds whose numbers can be asked here; others are described in a file of their own."""


def table_of(file: str, found: Found) -> dict[str, Any]:
    """What is asked about a table."""
    columns = [_column(it) for it in asked_of(found) if not it.known]
    tests = [
        {"name": name, "posture": "0", "role": "fit", "control": {}} for name in found.tests or ("test-1",)
    ]
    it = {
        "file": file,
        "name": Path(file).stem,
        "columns": columns,
        "kinds": list(KNOWN),
        "kind": KNOWN[0],
        "coordinates": list(COORDINATES),
        "tests": tests,
        "rig": [],
    }
    return of_kind(it)


def of_kind(table: Mapping[str, Any]) -> dict[str, Any]:
    """The same with what its kind of rig asks; numbers that were typed already are kept."""
    kind, typed = str(table["kind"]), {row["key"]: row["value"] for row in table["rig"]}
    rows = [{"key": key, "words": RIG[key], "value": typed.get(key, "")} for key in questions_of(kind)]
    held = KINDS[kind].held
    usual = {name: "displacement" if name in held else FORCE for name in COORDINATES}
    tests = [{**row, "control": {**usual, **row["control"]}} for row in table["tests"]]
    return {**table, "rig": rows, "tests": tests, "posture": bool(KINDS[kind].posture_key)}


def choices_of(table: Mapping[str, Any]) -> Choices:
    """What was answered. InputError names the first answer that is missing."""
    columns = {}
    for row in table["columns"]:
        if row["what"] == OWN:
            raise InputError(
                f"column {row['name']}: what it is was not chosen, allowed: {_listed(row['choices'])}"
            )
        columns[row["name"]] = Column(row["what"], -1 if row["sign"] == MINUS else 1, row["unit"].strip())
    rig = {row["key"]: _number(row["words"], row["value"]) for row in table["rig"]}
    tests = tuple(
        Run(
            row["name"],
            _number(f"angle of {row['name']}", row["posture"]) if table["posture"] else None,
            row["role"],
            {name: row["control"][name] for name in COORDINATES},
        )
        for row in table["tests"]
    )
    return Choices(table["name"], table["kind"], rig, columns, tests)


def shown(it: Preview | None) -> dict[str, Any]:
    """As the page has it."""
    if it is None:
        return NOTHING
    return {"head": list(it.head), "rows": [list(row) for row in it.rows], "said": list(it.said)}


def _column(it: Asked) -> dict[str, Any]:
    choices = [OWN, *it.choices, SKIP]
    # What can only be one thing is that.
    what = it.choices[0] if len(it.choices) == 1 and it.choices[0] != "time" else OWN
    what = SKIP if it.choices == ("time",) else what
    return {
        "name": it.name,
        "values": it.values,
        "choices": choices,
        "words": WORDS,
        "what": what,
        "sign": "+",
        "unit": it.unit,
    }


def _number(words: str, text: object) -> float:
    try:
        return float(str(text).strip().replace(",", "."))
    except ValueError:
        raise InputError(f"{words}: is {str(text)!r}, allowed is a number") from None


def _listed(names: list[str]) -> str:
    return ", ".join(WORDS.get(name, name) for name in names if name != OWN)
