"""A column in another unit than its name says: kgf, pounds, inches, metres, degrees.

Factors and their sources: `pipeline.campaign.mapped.units`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.campaign.mapped.units import INCH, LBF, UNITS
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import FORCES, MOMENTS, Mistake, groups, times, verb

KGF, TEN, THOUSAND, DEGREE = (UNITS[name].factor for name in ("kgf", "daN", "kN", "°"))
MILLI = 1.0 / THOUSAND
POUND = round(LBF, 7)
"""N, as tables of factors print it."""
FORCE = {"kgf": KGF, "daN": TEN, "lbf": POUND, "kN": THOUSAND, "mN": MILLI}
MOMENT = {
    "N·m": THOUSAND,
    "N·cm": TEN,
    "kgf·mm": KGF,
    "kgf·m": THOUSAND * KGF,
    "kgf·cm": UNITS["kgf·cm"].factor,
    "lbf·in": POUND * INCH,
    "N·µm": MILLI,
}
LENGTH = {"m": THOUSAND, "cm": TEN, "inches": INCH, "µm": MILLI, "thousandths of an inch": MILLI * INCH}
TURN = {"degrees": DEGREE, "mrad": MILLI}
BOTH = {"kgf": KGF, "lbf": POUND}
"""Of forces and moments together."""
KNOWN = {"inches": "in", "thousandths of an inch": "thou", "degrees": "°"}
"""How the files spell a unit that is said in words."""
MEANT = {"N": FORCE, "Nmm": MOMENT, "mm": LENGTH, "rad": TURN}
WRITTEN = {"N": "N", "Nmm": "N·mm", "mm": "mm", "rad": "rad"}


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Another unit, or one that was converted the wrong way."""
    for name, columns in groups(campaign).items():
        units = {column.rpartition("_")[2] for column in columns}
        known = MEANT[units.pop()] if len(units) == 1 else BOTH
        done = set()
        for unit, factor in known.items():
            yield _read_in(name, columns, unit, factor)
            done.add(round(factor, 12))
        for unit, factor in known.items():
            if round(1.0 / factor, 12) not in done:
                yield _converted_back(name, columns, unit, factor)


def _read_in(name: str, columns: tuple[str, ...], unit: str, factor: float) -> Mistake:
    is_read = verb(columns, "is", "are")
    return Mistake(
        "unit",
        columns,
        f"{name} {is_read} in {unit}",
        f"multiply {_listed(columns)} by {factor:.7g} ({_meant(columns)} in {unit}), and {_its(columns)} sigma as well "
        f"where it is in {unit} too",
        partial(times, columns=columns, factor=factor),
        tuple(Change("columns", each, "unit", KNOWN.get(unit, unit)) for each in columns),
    )


def _converted_back(name: str, columns: tuple[str, ...], unit: str, factor: float) -> Mistake:
    return Mistake(
        "unit",
        columns,
        f"{name} {verb(columns, 'was', 'were')} converted to {unit} the wrong way round or twice",
        f"divide {_listed(columns)} by {factor:.7g} ({_meant(columns)} in {unit})",
        partial(times, columns=columns, factor=1.0 / factor),
    )


def _meant(columns: tuple[str, ...]) -> str:
    if set(columns) <= set(FORCES):
        return "N"
    if set(columns) <= set(MOMENTS):
        return "N·mm"
    return WRITTEN.get(columns[0].rpartition("_")[2], "")


def _its(columns: tuple[str, ...]) -> str:
    return verb(columns, "its", "their")


def _listed(columns: tuple[str, ...]) -> str:
    return ", ".join(columns)
