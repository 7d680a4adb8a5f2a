"""Closed lists that a file may choose from: columns, units, tolerances, endings of files."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from pipeline.campaign.formats import by_suffix
from pipeline.campaign.mapped.mapping import quantities
from pipeline.campaign.mapped.units import QUANTITIES, QUESTIONS, UNITS
from pipeline.campaign.names import PLACES, known_columns
from pipeline.campaign.tolerance import BARS, LARGEST, SHARE
from vjm.tolerances import tolerances

_COLUMNS = {
    "test": "id of the test",
    "step": "number of the load step within its test, rising; equal numbers are repeats",
    "x_mm y_mm z_mm": "displacement of the platform point from the nominal unloaded pose, base frame",
    "rx_rad ry_rad rz_rad": "rotation vector of the platform, base frame",
    "fx_N fy_N fz_N": "force on the platform at the platform point, base frame",
    "mx_Nmm my_Nmm mz_Nmm": "moment on the platform about the platform point, base frame",
    "NAME_mm": "reading of the gauge NAME, zeroed in the unloaded state",
    "temperature_C": "temperature of the bars",
    "at_x_mm at_y_mm at_z_mm": "of a manipulator: where the unloaded platform stands, instead of at_mm of a test",
}
_KEYS = {
    "EA": "share of the axial stiffness of the bars",
    "EIy": "share of their bending stiffness about y",
    "EIz": "share of their bending stiffness about z",
    "GJ": "share of their torsional stiffness",
    "ends": "share of the bar's own compliance, of the compliance of its two ends",
    "length_mm": "length of the bars, as the drawing has it",
    "width_mm": "distance of the bars, as the drawing has it",
    "q_mrad": "angle of the bars that was set up",
    BARS: "written `bar` in the file: share of the stiffness of the bars of a manipulator",
    "drives": "share of the stiffness of the drives of a manipulator",
    "links": "share of the stiffness of the links of a manipulator",
}


def rows(head: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    parts = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(line) + " |" for line in parts) + "\n"


def columns() -> str:
    """The columns of measurements.csv. ValueError where the program has others."""
    named = " ".join(_COLUMNS).replace("NAME_mm ", "").split()
    if sorted(named) != sorted((*known_columns(()), *PLACES)):
        raise ValueError(f"the columns that are described differ from those that there are: {named}")
    code = (" ".join(f"`{name}`" for name in names.split()) for names in _COLUMNS)
    return rows(("column", "what it is"), zip(code, _COLUMNS.values(), strict=True))


def roles() -> str:
    """What a column of an own file may be, with the quantity and the unit into which it is brought."""
    every = [(name, what, QUANTITIES[what]) for name, (what, _) in quantities(()).items()]
    by = dict.fromkeys((what, unit) for _, what, unit in every)
    lines = [
        (" ".join(f"`{name}`" for name, what, _ in every if what == quantity), quantity, unit)
        for quantity, unit in by
    ]
    return rows(("`is`", "quantity", "unit of the program"), lines)


def units() -> str:
    """Units by quantity, and spellings that are refused with a question."""
    known = [
        (quantity, " ".join(f"`{u}`" for u, it in UNITS.items() if it.quantity == quantity))
        for quantity in QUANTITIES
    ]
    asked = [(f"`{spelling}`", question) for spelling, (question, _) in QUESTIONS.items()]
    return f"{rows(('quantity', 'units'), known)}\n{rows(('refused', 'the question that it raises'), asked)}"


def deviations() -> str:
    """Keys of [tolerance] with what counts where nothing is said. ValueError for one without a description."""
    usual = {key: value for it in tolerances() for key, value in it.deviations.items() if key != "gain"}
    if missing := sorted(set(usual) - set(_KEYS)):
        raise ValueError(f"tolerances without a description: {missing}")
    lines = [
        (f"`{key}`", _KEYS[key], f"{usual[key]:g}", f"0 to {LARGEST.get(key, SHARE):g}")
        for key in _KEYS
        if key in usual
    ]
    return rows(("key", "what may be off", "usual standard deviation", "allowed"), lines)


def endings() -> str:
    """Endings of files that can be read."""
    return ", ".join(f"`{suffix}`" for suffix in sorted(by_suffix()))


PIECES: dict[str, Callable[[], str]] = {
    "columns of measurements": columns,
    "roles of columns": roles,
    "units": units,
    "tolerances": deviations,
    "endings of files": endings,
}
