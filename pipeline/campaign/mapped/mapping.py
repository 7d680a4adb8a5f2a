"""What is declared of a table, checked by itself: what each column is, its unit, its sign and its zero."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from pipeline.campaign.mapped.schema import CellTable, ColumnTable, DerivedTable, FileTable
from pipeline.campaign.mapped.units import UNITS, NoUnit, Unit, meant, unit
from pipeline.campaign.names import COORDINATES, PLACES, TEMPERATURE, gauge_column
from pipeline.toml.complaints import shown

FORCES, MOMENTS = ("fx", "fy", "fz"), ("mx", "my", "mz")
IGNORED, OPEN = "ignore", "?"
LATER = "sigma."
"""What the contract foresees and no reader knows yet."""


@dataclass(frozen=True)
class Declared:
    """All that is declared of the readings of a campaign, or of one of its tests."""

    file: FileTable
    columns: Mapping[str, ColumnTable]
    cell: CellTable | None = None
    derived: Mapping[str, DerivedTable] | None = None


@dataclass(frozen=True)
class Source:
    """What is declared of some files.

    tests: ids that their rows may be of. own: whether these are of one test alone, with a file of its own.
    elsewhere: ids of the tests that have such files.
    """

    declared: Declared
    tests: tuple[str, ...]
    own: bool = False
    elsewhere: tuple[str, ...] = ()


def quantities(gauges: Iterable[str]) -> dict[str, tuple[str, str]]:
    """What a column may be that is measured: the quantity, and the column of the contract."""
    found = {c: ("length" if c in COORDINATES[:3] else "angle", "") for c in COORDINATES}
    out = {c: (what, f"{c}_{'mm' if what == 'length' else 'rad'}") for c, (what, _) in found.items()}
    out |= {f: ("force", f"{f}_N") for f in FORCES}
    out |= {m: ("moment", f"{m}_Nmm") for m in MOMENTS}
    out |= {name: ("length", gauge_column(name)) for name in gauges}
    out |= {column.removesuffix("_mm"): ("length", column) for column in PLACES}
    out["temperature"] = ("temperature", TEMPERATURE)
    out["time"] = ("time", "")
    return out


def mistakes(name: str, it: ColumnTable, known: Mapping[str, tuple[str, str]]) -> list[str]:
    """What is wrong with an entry of `[columns]`, each a sentence without its place."""
    out = []
    if it.sign == OPEN:
        out.append('sign = "?" is not decided yet, write 1, or -1 where the column grows against the axis')
    elif it.sign not in (1, -1):
        out.append(f"sign is {shown(it.sign)}, allowed is 1 or -1")
    if isinstance(it.zero, str) and it.zero != "first_row":
        out.append(f'zero is {shown(it.zero)}, allowed is a number or "first_row"')
    if said := _no_quantity(name, it, known):
        return [said, *out]
    if it.what in ("test", "step") and (it.sign != 1 or it.zero != 0.0):
        out.append(f"has a sign or a zero, {it.what} has none")
    if it.what == "temperature" and (it.sign != 1 or it.zero == "first_row"):
        out.append("has a sign or its first row as zero, a temperature has neither")
    if it.unit is not None and it.what in known:
        try:
            unit(it.unit, known[it.what][0])
        except NoUnit as error:
            out.append(f"unit: {error}")
    return out


def _no_quantity(name: str, it: ColumnTable, known: Mapping[str, tuple[str, str]]) -> str:
    """Why what a column is declared to be cannot be used; empty where it can."""
    choice = ", ".join([*known, "test", "step", IGNORED])
    if it.what == OPEN:
        return f'is = "?" is not decided yet, write what {shown(name)} is: {choice}'
    if it.what.startswith(LATER):
        return f"is = {shown(it.what)} is not read yet, write one sigma for each column under [noise]"
    if it.what in ("test", "step"):
        return "" if it.unit is None else f"has a unit, {it.what} has none"
    if it.what == IGNORED or it.what in known:
        return ""
    near = get_close_matches(it.what, list(known), n=1)
    return f"is = {shown(it.what)} is unknown, " + (
        f"did you mean {near[0]!r}?" if near else f"allowed are {choice}"
    )


def unit_of(it: ColumnTable, name: str, beside: str, inside: str, quantity: str, contract: str) -> Unit | str:
    """The unit of a column, or what is wrong. beside: in the row of units, inside: in its header."""
    if it.unit is None and name == contract and not beside.strip():
        return next(u for u in UNITS.values() if u.quantity == quantity and u.factor == 1.0 and not u.offset)
    written = [spelling for spelling in (beside, inside) if spelling.strip()]
    declared = None if it.unit is None else unit(it.unit, quantity)
    for spelling in written:
        try:
            found = unit(spelling, quantity)
        except NoUnit as error:
            if declared is None:
                return f"{error}; write unit = ... for it under [columns]"
            # What is no unit at all may be anything: a place, a channel.
            if meant(spelling) is not None and declared.spelling not in (meant(spelling) or ()):
                return f"has the unit {declared.spelling}, but the file says {spelling.strip()}: {error}"
            continue
        if declared is not None and (found.factor, found.offset) != (declared.factor, declared.offset):
            said = "the file says" if it.unit is not None else "the header and the row of units differ,"
            return f"has the unit {declared.spelling}, but {said} {found.spelling}"
        declared = declared or found
    return declared or "has no unit, write unit = ... for it under [columns]"
