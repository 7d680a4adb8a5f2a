"""What is declared of a table, checked by itself: what each column is, its unit, its sign and its zero."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from pipeline.campaign.complaints import shown
from pipeline.campaign.mapped.schema import CellTable, ColumnTable, DerivedTable, FileTable
from pipeline.campaign.mapped.units import UNITS, NoUnit, Unit, unit
from pipeline.campaign.names import COORDINATES, TEMPERATURE, gauge_column

FORCES, MOMENTS = ("fx", "fy", "fz"), ("mx", "my", "mz")
IGNORED, OPEN = "ignore", "?"
LATER = ("at_x", "at_y", "at_z", "sigma.")
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
    """What is declared of some files. test: the id of the only test that they hold, "" where rows say it."""

    declared: Declared
    test: str = ""


def quantities(gauges: Iterable[str]) -> dict[str, tuple[str, str]]:
    """What a column may be that is measured: the quantity, and the column of the contract."""
    found = {c: ("length" if c in COORDINATES[:3] else "angle", "") for c in COORDINATES}
    out = {c: (what, f"{c}_{'mm' if what == 'length' else 'rad'}") for c, (what, _) in found.items()}
    out |= {f: ("force", f"{f}_N") for f in FORCES}
    out |= {m: ("moment", f"{m}_Nmm") for m in MOMENTS}
    out |= {name: ("length", gauge_column(name)) for name in gauges}
    out["temperature"] = ("temperature", TEMPERATURE)
    out["time"] = ("time", "")
    return out


def mistakes(name: str, it: ColumnTable, known: Mapping[str, tuple[str, str]]) -> list[str]:
    """What is wrong with an entry of `[columns]`, each a sentence without its place."""
    out = []
    if it.sign == OPEN:
        out.append('sign = "?" is not decided yet, write 1, or -1 where the column grows against the axis')
    elif it.sign not in (1, -1):
        out.append(f"sign is {it.sign}, allowed is 1 or -1")
    if said := _no_quantity(name, it, known):
        return [said, *out]
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
        instead = (
            "one sigma for each column under [noise]" if it.what.startswith("sigma") else "at_mm in each test"
        )
        return f"is = {shown(it.what)} is not read yet, write {instead}"
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
    written = [spelling for spelling in (beside, inside) if spelling.strip()]
    found = []
    for spelling in written:
        try:
            found.append(unit(spelling, quantity))
        except NoUnit as error:
            if it.unit is None:
                return f"{error}; write unit = ... for it under [columns]"
    if it.unit is None:
        if not found and name == contract:
            return next(
                u for u in UNITS.values() if u.quantity == quantity and u.factor == 1.0 and not u.offset
            )
        if not found:
            return "has no unit, write unit = ... for it under [columns]"
        declared = found[0]
    else:
        declared = unit(it.unit, quantity)
    for other in found:
        if (other.factor, other.offset) != (declared.factor, declared.offset):
            said = "the file says" if it.unit is not None else "the header and the row of units differ,"
            return f"has the unit {declared.spelling}, but {said} {other.spelling}"
    return declared
