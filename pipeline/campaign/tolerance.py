"""The table [tolerance]: by how much what a campaign says of its rig may be off, one standard deviation each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from pipeline.toml.complaints import shown
from pipeline.toml.spelling import unknown_name
from vjm.tolerances import tolerances

Complain = Callable[[tuple[str, ...], str], None]
EXACT, ALL, BAR, ENDS, BARS = "exact", "all", "bar", "ends", "bars"
SECTION = ("EA", "EIy", "EIz", "GJ")
LARGEST = {"length_mm": 10.0, "width_mm": 10.0, "q_mrad": 50.0}
"""mm and mrad; a share is at most `SHARE`."""
SHARE = 0.2
"""Beyond that a bar is not known, and no line leads there."""


def usual(written: tuple[str, ...]) -> dict[str, float]:
    """What counts where nothing is said, of the keys that a rig has."""
    every = {key: value for it in tolerances() for key, value in it.deviations.items()}
    return {key: every[key] for key in written}


def widest(each: Iterable[Mapping[str, float]]) -> dict[str, float]:
    """Of every key the largest value: of rigs with different bars, of which one factor tells how far all are off."""
    found: dict[str, float] = {}
    for known in each:
        found |= {key: max(value, found.get(key, value)) for key, value in known.items()}
    return found


def tolerance(
    raw: Mapping[str, Any],
    written: tuple[str, ...],
    complain: Complain,
    known: Mapping[str, float] | None = None,
) -> dict[str, float]:
    """Standard deviations by key of a rig's tolerances, zero left out; with a complaint about every mistake.

    A number for `bar` is that of all of its stiffnesses. What is not said is as in `known`, by default as usual.
    """
    found = usual(written) if known is None else dict(known)
    allowed = [ALL, *_spelled(written)]
    for key, value in raw.items():
        if key == ALL:
            if value == EXACT:
                found = dict.fromkeys(found, 0.0)
            else:
                complain((key,), f'is {shown(value)}, allowed is: "{EXACT}"')
        elif key not in allowed:
            complain((key,), f"is not a key of this table, {unknown_name(key, allowed)}")
        elif key == BAR and isinstance(value, dict):
            found |= _of_bar(value, written, complain)
        else:
            number = _number((key,), value, LARGEST.get(key, SHARE), complain)
            own = [each for each in (*SECTION, BARS) if each in written] if key == BAR else [key]
            found |= dict.fromkeys(own, number)
    return {key: value for key, value in found.items() if value > 0.0}


def table(known: Mapping[str, float], written: tuple[str, ...]) -> dict[str, Any]:
    """The table that gives these standard deviations."""
    if not any(known.get(key) for key in written):
        return {ALL: EXACT}
    values = {key: known.get(key) or EXACT for key in written}
    if BARS in values:
        values[BAR] = values.pop(BARS)
    bar = {key: values.pop(key) for key in (*SECTION, ENDS) if key in values}
    return {**({BAR: bar} if bar else {}), **values}


def _spelled(written: tuple[str, ...]) -> list[str]:
    """Keys of the table."""
    inside = {*SECTION, ENDS, BARS}
    return list(dict.fromkeys(BAR if key in inside else key for key in written))


def _of_bar(value: Mapping[str, Any], written: tuple[str, ...], complain: Complain) -> dict[str, float]:
    allowed = [key for key in (*SECTION, ENDS) if key in written]
    found = {}
    for key, each in value.items():
        if key not in allowed:
            others = unknown_name(key, allowed) if allowed else "allowed is one number"
            complain((BAR, key), f"is not a key of this table, {others}")
        else:
            found[key] = _number((BAR, key), each, SHARE, complain)
    return found


def _number(path: tuple[str, ...], value: object, largest: float, complain: Complain) -> float:
    if value == EXACT:
        return 0.0
    if isinstance(value, int | float) and not isinstance(value, bool) and 0.0 <= value <= largest:
        return float(value)
    what = "a table" if isinstance(value, dict) else "a list" if isinstance(value, list) else shown(value)
    complain(
        path, f'is {what}, allowed is: a number from 0 to {largest:g}, one standard deviation, or "{EXACT}"'
    )
    return 0.0
