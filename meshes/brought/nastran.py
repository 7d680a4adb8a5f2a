"""Bulk data of Nastran: GRID, CTETRA, CHEXA, CPENTA in free, small and large fields; other cards are refused."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from meshes.brought.as_found import found_on_one_mesh
from meshes.brought.child import Arrays
from meshes.brought.collected import Collected

SUFFIXES = (".bdf", ".nas", ".dat")
SOLIDS = {
    "CTETRA": {4: "tetra", 10: "tetra10"},
    "CPENTA": {6: "wedge", 15: "wedge15"},
    "CHEXA": {8: "hexahedron", 20: "hexahedron20"},
}
# Nastran has the upright edges of hexahedra and wedges before the upper ones.
ORDER = {
    "hexahedron20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15],
    "wedge15": [*range(9), 12, 13, 14, 9, 10, 11],
}
PAST = {"MAT1", "MAT9", "PARAM", "EIGRL", "EIGR", "MAT4"}
# Loads say nothing about K_b.
LOADS = {"FORCE", "MOMENT", "PLOAD", "PLOAD2", "PLOAD4", "LOAD", "GRAV", "TEMP", "TEMPD"}
SHELLS = ("CQUAD", "CTRIA", "CSHEAR", "CBAR", "CBEAM", "CROD", "CONROD", "CTUBE")
_SHORT = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+))([+-]\d+)$")


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """In the child: the mesh at `asked["path"]` as it is; keys as in `meshes.brought.cad.work`."""
    text = Path(asked["path"]).read_bytes().decode("utf-8", "replace")
    if "\0" in text:
        raise ValueError("is no text")
    got, past = Collected(), set()
    regions: dict[str, list[int]] = {}
    for line, fields in cards(text):
        name = fields[0]
        if name == "GRID":
            _grid(got, line, fields)
        elif name in SOLIDS:
            regions.setdefault(f"property {_whole(line, fields, 2)}", []).append(_solid(got, line, fields))
        elif name == "PSOLID":
            if _blank(fields, 3) not in ("", "0"):
                raise ValueError(
                    f"line {line}: PSOLID has a material frame CORDM, allowed are axes in the case"
                )
        elif name in PAST or name in LOADS:
            past.add(name)
        else:
            raise ValueError(f"line {line}: {_refused(name)}")
    said = [f"read past: {', '.join(sorted(past))}"] if past else []
    return found_on_one_mesh(got.raw(regions, said), asked)


def _refused(name: str) -> str:
    if name.startswith(SHELLS):
        return f"{name} is a shell, a beam or a rod, allowed are solids: CTETRA, CHEXA, CPENTA"
    if name.startswith("SPC") or name == "SUPORT":
        return f"{name} holds nodes of the part, allowed is a free part; a symmetry condition makes it a half model"
    return f"{name} is not read and could change the stiffness, allowed are GRID, CTETRA, CHEXA, CPENTA, PSOLID, MAT1"


def cards(text: str) -> Iterator[tuple[int, list[str]]]:
    """Line number and fields of every bulk data card, continuations joined; ValueError for one of none."""
    lines = text.splitlines()
    start = next((k + 1 for k, line in enumerate(lines) if line.strip().upper().startswith("BEGIN BULK")), 0)
    card: list[str] | None = None
    first = 0
    for number, raw in enumerate(lines[start:], start + 1):
        line = raw.split("$")[0].rstrip()
        if not line.strip():
            continue
        if line.strip().upper().startswith("ENDDATA"):
            break
        head, body = _fields(line)
        if not head or head[0] in "+*":
            if card is None:
                raise ValueError(f"line {number}: continues a card that is not there, this is no bulk data")
            card += body
            continue
        if card is not None:
            yield first, card
        card, first = [head.rstrip("*").upper(), *body], number
    if card is not None:
        yield first, card


def _fields(line: str) -> tuple[str, list[str]]:
    """Name and data fields of one line: free (commas), large (16 columns, name with *) or small (8 columns)."""
    if "," in line:
        parts = [part.strip() for part in line.split(",")]
        body = parts[1:9]
        return parts[0], body + [""] * (8 - len(body))
    wide = line.expandtabs(8)
    head = wide[:8].strip()
    size, count = (16, 4) if "*" in head else (8, 8)
    return head, [wide[8 + size * k : 8 + size * (k + 1)].strip() for k in range(count)]


def _grid(got: Collected, line: int, fields: list[str]) -> None:
    for k, what in ((2, "its place in"), (6, "its displacements in")):
        if _blank(fields, k) not in ("", "0"):
            raise ValueError(
                f"line {line}: GRID has {what} coordinate system {fields[k]}, allowed is the basic one: write the "
                "model out in basic coordinates"
            )
    if _blank(fields, 7):
        raise ValueError(f"line {line}: GRID is held in {fields[7]}, allowed is a free part")
    at = [_real(line, _blank(fields, k)) for k in (3, 4, 5)]
    got.node(_whole(line, fields, 1), at, line)


def _solid(got: Collected, line: int, fields: list[str]) -> int:
    number = _whole(line, fields, 1)
    nodes = [f for f in fields[3:] if f]
    kind = SOLIDS[fields[0]].get(len(nodes))
    if kind is None:
        raise ValueError(
            f"line {line}: {fields[0]} {number} has {len(nodes)} nodes, allowed are "
            f"{' or '.join(map(str, SOLIDS[fields[0]]))}: all middle nodes or none"
        )
    values = [_whole(line, [*nodes], k) for k in range(len(nodes))]
    got.cell(kind, number, [values[k] for k in ORDER.get(kind, range(len(values)))], line)
    return number


def _blank(fields: list[str], k: int) -> str:
    return fields[k] if k < len(fields) else ""


def _whole(line: int, fields: list[str], k: int) -> int:
    try:
        return int(_blank(fields, k))
    except ValueError:
        raise ValueError(f"line {line}: {_blank(fields, k)[:30]!r} is no whole number") from None


def _real(line: int, text: str) -> float:
    """A number, also in Nastran's short form 1.5-3; an empty field is zero."""
    if short := _SHORT.match(text):
        text = f"{short[1]}E{short[2]}"
    try:
        value = float(text.upper().replace("D", "E")) if text else 0.0
    except ValueError:
        raise ValueError(f"line {line}: {text[:30]!r} is no number") from None
    if not np.isfinite(value):
        raise ValueError(f"line {line}: {text[:30]!r} is no finite number")
    return value
