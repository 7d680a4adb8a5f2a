"""Names of coordinates and columns, and what to say of a column that is none."""

import re
from collections.abc import Iterable
from typing import Protocol

from pipeline.toml.spelling import unknown_name

COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
"""Platform coordinates in the order of a pose."""
DISPLACEMENTS = ("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad")
WRENCHES = ("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm")
TEMPERATURE = "temperature_C"
PLACES = ("at_x_mm", "at_y_mm", "at_z_mm")
"""Where the unloaded platform of a manipulator stands, base frame; nothing that is measured."""
KEYS = ("test", "step")
UNITS = {
    "mm": "millimetres",
    "rad": "radians",
    "N": "newtons",
    "Nmm": "newton millimetres",
    "C": "degrees Celsius",
}
DISPLACEMENT, FORCE, SUPPORT = "displacement", "force", "held"
"""What may control a coordinate, beside a gauge's name. `SUPPORT`: a clamp, or the tip of a bar where its kind implies
it, keeps the coordinate where it is unloaded; no column, sigma or noise goes with it."""


def gauge_column(name: str) -> str:
    """Column of a gauge."""
    return f"{name}_mm"


class Named(Protocol):
    """What has a name."""

    @property
    def name(self) -> str: ...


def channel_columns(gauges: Iterable[Named]) -> list[str]:
    """Columns of the channels: pose, wrench, gauges."""
    return [*DISPLACEMENTS, *WRENCHES, *(gauge_column(gauge.name) for gauge in gauges)]


def known_columns(gauges: Iterable[str]) -> tuple[str, ...]:
    """Every column that a campaign with these gauges may have, in the order in which they are written."""
    return (*KEYS, *DISPLACEMENTS, *WRENCHES, *map(gauge_column, gauges), TEMPERATURE)


def wrong_column(found: str, known: Iterable[str]) -> str:
    """What to say of a column name that is not known; another unit is refused, never converted."""
    names = [name for name in known if name not in KEYS]
    units = {name.rpartition("_")[0].casefold(): name.rpartition("_") for name in names}
    # A unit may follow an underscore, a blank or a bracket: x_m, x (m), x [m], x/m.
    parts = re.fullmatch(r"(.*?)[\s_/\-]*[\s_(\[/]\s*([^\s_()\[\]/]+)[)\]\s]*", found)
    stem, unit = (parts[1], parts[2]) if parts and found.casefold() not in units else (found, "")
    if stem.casefold() not in units:
        return f"is unknown, {unknown_name(found, [*KEYS, *names])}"
    right, _, wanted = units[stem.casefold()]
    allowed = f"allowed is {right}_{wanted} ({UNITS[wanted]})"
    if not unit:
        return f"names no unit, {allowed}"
    if unit == wanted:
        return f"is spelled in another way, {allowed}"
    if unit.casefold() == wanted.casefold():
        return f"has its unit in another case, {allowed}"
    return f"has the unit {unit[:20]}, {allowed}: convert the numbers, not only the name"
