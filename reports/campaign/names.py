"""Channels, units and tests of a campaign as a reader sees them."""

from collections.abc import Sequence
from html import escape

from reports.load import Json

COORDINATES = ("x", "y", "z", "rx", "ry", "rz", "fx", "fy", "fz", "mx", "my", "mz")
BEFORE, AFTER = "plain virtual springs", "the model"


def channel_label(name: str) -> str:
    """fx as Fx, mz as Mz, the others as they are."""
    wrench = len(name) == 2 and name[0] in "fm" and name[1] in "xyz"
    return name.capitalize() if wrench else name


def unit_label(unit: str) -> str:
    """N·mm for Nmm."""
    return {"Nmm": "N·mm"}.get(unit, unit)


def axis_label(name: str, unit: str) -> str:
    """A channel with its unit, for the title of an axis."""
    return f"{escape(spelled(name))}, {unit_label(unit)}"


def spelled(name: str) -> str:
    """A channel beside a place where there is room: a gauge says that it is one."""
    return channel_label(name) if name in COORDINATES else f"gauge {name}"


def by_role(page: Json) -> list[Json]:
    """All tests, those held out last."""
    return sorted(page["tests"], key=lambda test: test["role"] == "holdout")


def test_label(test: Json) -> str:
    """A test's id; one that is held out says so."""
    return f"{test['test']} (held out)" if test["role"] == "holdout" else str(test["test"])


def stages_of(effects: Sequence[str]) -> tuple[str, ...]:
    """Before and after effects were added; before alone where none was."""
    return ("before", "after") if effects else ("before",)


def standing(test: Json) -> str:
    """A test's name, and where the rig stands in it: a single bar has no other place."""
    return ", ".join(filter(None, (test_label(test), place(test) if test["rig"]["kind"] != "bar" else "")))


def place(test: Json) -> str:
    """Where the rig stands in a test."""
    point = test["rig"].get("place_mm")
    if point is None:
        return f"q = {test['q_deg']:g}°"
    return f"platform at ({', '.join(f'{value:g}' for value in point)}) mm"


def measured(page: Json) -> bool:
    """Whether there is a reading that a model predicts."""
    return any(test["curves"] for test in page["tests"])


def channels(page: Json) -> list[str]:
    """Channels that any test has, in the order of the columns."""
    found = dict.fromkeys(curve["channel"] for test in page["tests"] for curve in test["curves"])
    known = [name for name in COORDINATES if name in found]
    return [*known, *(name for name in found if name not in known)]


def worst(page: Json, count: int) -> list[tuple[Json, Json]]:
    """Tests and curves that plain virtual springs miss most, one for each driving quantity and channel first."""
    every = [(test, curve) for test in page["tests"] for curve in test["curves"]]
    every.sort(key=lambda it: -(it[1]["rms_before"] or 0.0))
    first: dict[tuple[str, str], tuple[Json, Json]] = {}
    for test, curve in every:
        first.setdefault((test["load"], curve["channel"]), (test, curve))
    return list(first.values())[:count]
