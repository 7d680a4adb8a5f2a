"""The text of a campaign to fill in: every key explained, what only its owner knows a question mark."""

from __future__ import annotations

import json
from collections.abc import Sequence

from pipeline.campaign.mapped.layout import header_unit
from pipeline.campaign.names import COORDINATES, DISPLACEMENT, DISPLACEMENTS, FORCE, SUPPORT, known_columns
from pipeline.campaign.rigs import KINDS
from pipeline.init.found import Found
from pipeline.init.known_bar import KnownBar
from pipeline.init.words import quantity_of

CHOICES = {
    "length": "x, y or z, or the name of a gauge",
    "angle": "rx, ry or rz",
    "force": "fx, fy or fz",
    "moment": "mx, my or mz",
}
"""What a column of each quantity may be; the axis is never guessed, nor the sign."""
SIMPLE = {"temperature": "temperature", "time": "time", "step": "step", "test": "test"}

FILE = """# test_from = "blank_row"    or "file", "sheet"; test_column = "...": of a file with several tests
# last_row = 120, comment = "#", missing = ["OVL", "---"], thousands = "'": rows and words that are no data
# every = 10                 of a long file one row of ten, and those where it begins, ends or turns
"""
CELL = """
# [cell]                     # of a load cell at another point, turned, or of the other sign
# at_mm = [0.0, 0.0, 40.0]   # from the platform's point, base frame
# turned_deg = [0.0, 0.0, 45.0]   # rotation vector
# sign = -1
# [derived]                  # a coordinate from several columns: here the angle of two dials 60 mm apart
# rz = { of = { "Dial 2" = 1, "Dial 1" = -1 }, unit = "mm", over_mm = 60.0 }
"""
GAUGES = """
# [[gauges]]                 # a dial or another sensor of a displacement; its column is dial_mm, its sigma too
# name = "dial"
# on = "platform"            # at offset_mm from the platform's point; or "bar": bar = 1, station = 0 (base) .. 1 (tip)
# offset_mm = [0.0, 40.0, 0.0]
# direction = "z"            # along which it reads more
"""
NOISE = """
[noise]                      # one sigma of each sensor, in N, mm, rad, N·mm; what is left out is estimated
# z_mm = 0.001
# fz_N = 0.5
"""
TOLERANCE = """
[tolerance]                  # one standard deviation of what is written above; what is left out has its usual one
# all = "exact"              # nothing is off, and no sensor is at fault
# bar = 0.02                 # share of its stiffness; or { EA = 0.02, EIy = 0.02, EIz = 0.02, GJ = 0.02, ends = 0.005 }
# length_mm = 0.05           # of the drawing; width_mm and q_mrad = 0.5 (the angle that was set up) of a parallelogram
"""


def campaign_text(
    name: str, kind: str, file: str = "", found: Found | None = None, bar: KnownBar | None = None
) -> str:
    """campaign.toml. file: beside it, of which `found` was found; without it measurements.csv is to be written."""
    more = KINDS[kind].further + NOISE + TOLERANCE + (GAUGES if KINDS[kind].has_gauges else "")
    head = f"schema = 1\nname = {_quoted(name)}\n\n[rig]\n{_rig(kind, bar)}{more}"
    tables = "" if found is None else _file(file, found) + _columns(found) + CELL
    names = ("test-1",) if found is None or not found.tests else found.tests
    control = _control(kind, found)
    more_tests = "".join(_further(kind, each, control) for each in names[1:])
    return head + tables + _test(kind, names[0], control) + more_tests


def _rig(kind: str, bar: KnownBar | None) -> str:
    """The rig, with the bar where it is known."""
    text = KINDS[kind].template
    if bar is not None:
        text = text.replace('length_mm = "?"', f"length_mm = {bar.length!r}")
        if bar.width is not None:
            text = text.replace('width_mm = "?"', f"width_mm = {bar.width!r}")
        text = "".join(bar.lines if line.startswith("bar =") else line for line in text.splitlines(True))
    return text


def _file(file: str, found: Found) -> str:
    lines = ["", "[file]", f"path = {_quoted(file)}"]
    if found.sheets:
        lines.append(f'sheet = "?"               # one of {", ".join(map(_quoted, found.sheets))}')
        lines.append('# test_from = "sheet"        or each sheet is a test')
    elif found.sheet is not None:
        lines.append(f"sheet = {_quoted(found.sheet)}")
    if found.separator is not None:
        lines.append(f"separator = {_quoted(found.separator)}")
        lines.append(f'encoding = "{found.encoding}"')
    if found.separator is not None or found.question:
        decimal = f'decimal = "{found.decimal}"' if found.decimal else f'decimal = "?"    # {found.question}'
        lines.append(decimal)
    lines.append(
        f"header_row = {found.header_row}"
        + ("" if found.header_row else "           # none: columns are #1, #2")
    )
    if found.units_row is not None:
        lines.append(f"units_row = {found.units_row}")
    if found.comment:
        lines.append(f"comment = {_quoted(found.comment)}               # and the header begins so")
    if found.skip:
        lines.append(f"skip = {found.skip}                     # rows below these that are no data")
    # The time is the order of the rows; it is no quantity of the model.
    lines += [f"time_column = {_quoted(name)}" for name in _times(found)[:1]]
    if found.others:
        some = ", ".join(map(str, found.others[:5])) + (" ..." if len(found.others) > 5 else "")
        lines.append(f"# lines among the data that are not like them: {some}; comment, missing or last_row")
    if found.merged:
        lines.append(
            f"fill_down = [{', '.join(map(_quoted, found.merged))}]      # empty cells repeat the one above"
        )
    return "\n".join(lines) + "\n" + FILE


def _columns(found: Found) -> str:
    lines = []
    times = _times(found)[:1]
    for k, (name, beside) in enumerate(zip(found.names, found.units, strict=True)):
        if name in found.names[:k]:
            lines.append(
                f"# {_quoted(name)} is there twice, which is refused: give one another name in the file"
            )
            continue
        # A name of the contract says what it is, its axis and its unit.
        if not name or name in times or name in known_columns(()):
            continue
        what = quantity_of(name, beside)
        unit = header_unit(name)[1] or beside
        if what in CHOICES:
            said = "" if unit else ', unit = "?"'
            lines.append(f'{_quoted(name)} = {{ is = "?", sign = "?"{said} }}   # {CHOICES[what]}')
        elif what in SIMPLE:
            lines.append(f'{_quoted(name)} = {{ is = "{SIMPLE[what] if what != "time" else "ignore"}" }}')
        else:
            lines.append(f'{_quoted(name)} = {{ is = "?" }}   # what it is, or "ignore"')
    head = "\n[columns]                    # value = sign * (reading - zero), in its unit\n"
    return head + "\n".join(lines) + "\n" if lines else ""


def _times(found: Found) -> list[str]:
    """Columns of time, those that go on first: a date may stand beside its time of day."""
    every = [
        n for n, beside in zip(found.names, found.units, strict=True) if quantity_of(n, beside) == "time"
    ]
    return sorted(every, key=lambda name: name in found.still)


def _control(kind: str, found: Found | None) -> str:
    """What controls each coordinate; what the rig needs held is clamped where no column of the file can read it."""
    ways = {c: _way_of_held(c, found) if c in KINDS[kind].held else FORCE for c in COORDINATES}
    return ", ".join(f'{c} = "{way}"' for c, way in ways.items())


def _way_of_held(coordinate: str, found: Found | None) -> str:
    if found is None:
        return DISPLACEMENT
    quantity = "angle" if coordinate.startswith("r") else "length"
    for name, beside in zip(found.names, found.units, strict=True):
        mine = name == DISPLACEMENTS[COORDINATES.index(coordinate)]
        if mine or (name not in known_columns(()) and quantity_of(name, beside) in (quantity, None)):
            return DISPLACEMENT
    return SUPPORT


def _further(kind: str, name: str, control: str) -> str:
    """A test after the first, of which every key is explained."""
    angle = f"{KINDS[kind].posture_key}\n" if KINDS[kind].posture_key else ""
    return f'\n[[tests]]\nid = {_quoted(name)}\n{angle}role = "fit"\ncontrol = {{ {control} }}\n'


def _test(kind: str, name: str, control: str) -> str:
    angle = KINDS[kind].posture_template
    return f"""
[[tests]]                    # one for each run of the bench, from the unloaded state
id = {_quoted(name)}
{angle}role = "fit"                 # or "holdout": kept to look at the result with
# zero = "nominal"           or "first_row" (sensors zeroed there), "fitted" (offsets not known)
# "displacement" for what was moved or held and is read by a column, "held" for what a clamp keeps where it is unloaded
# (no column), "force" for what was pushed or left free (an empty cell is no force)
control = {{ {control} }}
"""


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")


def plain_header(columns: Sequence[str]) -> str:
    """The header of measurements.csv; columns that were not measured are left out by hand."""
    return ",".join(columns) + "\n"
