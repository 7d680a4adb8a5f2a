"""Input files of Abaqus and CalculiX: nodes, solid elements, sets; what changes the stiffness otherwise is refused."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from meshes.brought.as_found import found_on_one_mesh
from meshes.brought.child import Arrays
from meshes.brought.collected import Collected
from meshes.brought.raw import NODES

SUFFIXES = (".inp",)
KINDS = {
    "C3D4": "tetra",
    "C3D10": "tetra10",
    "C3D10M": "tetra10",
    "C3D10T": "tetra10",
    "C3D6": "wedge",
    "C3D15": "wedge15",
    "C3D8": "hexahedron",
    "C3D8R": "hexahedron",
    "C3D8I": "hexahedron",
    "C3D20": "hexahedron20",
    "C3D20R": "hexahedron20",
}
# Of no effect on nodes, cells and sets. What they say of loads and output is of another question than K_b.
PAST = {
    "HEADING", "PREPRINT", "MATERIAL", "ELASTIC", "DENSITY", "EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "PLASTIC",
    "PHYSICAL CONSTANTS", "AMPLITUDE", "RESTART", "PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "END INSTANCE",
    "INITIAL CONDITIONS", "SURFACE", "ORIENTATION", "NODE PRINT", "NODE FILE", "EL FILE", "EL PRINT",
}  # fmt: skip
SYMMETRY = ("XSYMM", "YSYMM", "ZSYMM", "XASYMM", "YASYMM", "ZASYMM")


@dataclass
class _File:
    """What has been read so far."""

    got: Collected = field(default_factory=Collected)
    instances: int = 0
    in_step: bool = False
    past: dict[str, int] = field(default_factory=dict)
    section_of: dict[str, str] = field(default_factory=dict)


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """In the child: the mesh at `asked["path"]` as it is; keys as in `meshes.brought.cad.work`."""
    text = Path(asked["path"]).read_bytes().decode("utf-8", "replace")
    if "\0" in text:
        raise ValueError("is no text")
    file = _File()
    for line, name, options, rows in blocks(text):
        _block(file, line, name, options, rows)
    said = [f"read past: {', '.join(f'*{name}' for name in sorted(file.past))}"] if file.past else []
    regions = {name: file.got.cell_sets[name] for name in file.section_of if name in file.got.cell_sets}
    return found_on_one_mesh(file.got.raw(regions, said), asked)


def blocks(text: str) -> Iterator[tuple[int, str, dict[str, str], list[tuple[int, list[str]]]]]:
    """Line number, keyword, options and data rows (line, fields) of every keyword; ValueError for data before one."""
    head: tuple[int, str, dict[str, str]] | None = None
    rows: list[tuple[int, list[str]]] = []
    pending = ""
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if line.startswith("*") or pending:
            line, pending = pending + line, ""
            if line.endswith(","):
                pending = line
                continue
            if head is not None:
                yield (*head, rows)
            name, *options = (part.strip() for part in line[1:].split(","))
            pairs = (option.partition("=")[::2] for option in options if option)
            head = (number, " ".join(name.upper().split()), {k.strip().upper(): v.strip() for k, v in pairs})
            rows = []
        elif head is None:
            raise ValueError(
                f"line {number}: stands before any keyword, this is no input file of Abaqus or CalculiX"
            )
        else:
            rows.append((number, [part.strip() for part in line.split(",")]))
    if head is not None:
        yield (*head, rows)


def _block(
    file: _File, line: int, name: str, options: dict[str, str], rows: list[tuple[int, list[str]]]
) -> None:
    if name in _READ:
        _READ[name](file, line, options, rows)
    elif name == "STEP":
        file.in_step = True
        file.past["STEP"] = line
    elif name == "END STEP":
        file.in_step = False
    elif not (file.in_step or name in PAST):
        raise ValueError(
            f"line {line}: *{name} is not read and could change the stiffness, allowed are nodes, solid elements and "
            "sets; take it out, or mesh the part alone"
        )
    elif name in PAST and name not in (
        "HEADING",
        "PART",
        "END PART",
        "ASSEMBLY",
        "END ASSEMBLY",
        "END INSTANCE",
    ):
        file.past[name] = line


def _instance(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
    file.instances += 1
    if file.instances > 1:
        raise ValueError(f"line {line}: has a second *INSTANCE, allowed is one: a bar is one part")
    if rows:
        raise ValueError(f"line {rows[0][0]}: its *INSTANCE is moved, allowed is a part where it was drawn")


def _boundary(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
    for number, fields in rows:
        if any(f.upper() in SYMMETRY for f in fields):
            raise ValueError(
                f"line {number}: a symmetry condition ({', '.join(fields)}): this is a half model, allowed is the "
                "whole bar; mirror the mesh"
            )
    if not file.in_step:
        raise ValueError(
            f"line {line}: *BOUNDARY holds nodes of the part, allowed is a free part: the case says what is held"
        )


def _node(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
    if (system := options.get("SYSTEM", "R").upper()) not in ("R", "RECTANGULAR"):
        raise ValueError(f"line {line}: nodes in system {system}, allowed are rectangular coordinates")
    for number, fields in rows:
        values = [_number(number, f) for f in fields[1:4]]
        file.got.node(_whole(number, fields[0]), [*values, *[0.0] * (3 - len(values))], number)
    if name := options.get("NSET"):
        file.got.node_set(name.upper(), [_whole(n, f[0]) for n, f in rows])


def _element(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
    given = options.get("TYPE", "").upper()
    kind = KINDS.get(given)
    if kind is None:
        what = (
            "shells, planes or beams have no thickness of their own" if given[:1] in "SCBTM" else "not read"
        )
        raise ValueError(
            f"line {line}: elements of type {given or 'none'}, allowed are {', '.join(KINDS)}"
            + (f": {what}" if not given.startswith("C3D") else "")
        )
    numbers = [(n, f) for n, fields in rows for f in fields if f]
    width = NODES[kind] + 1
    if len(numbers) % width:
        raise ValueError(
            f"line {line}: {given} has {NODES[kind]} nodes, here the numbers do not come out even"
        )
    ids = []
    for start in range(0, len(numbers), width):
        row = [_whole(n, f) for n, f in numbers[start : start + width]]
        ids.append(row[0])
        file.got.cell(kind, row[0], row[1:], numbers[start][0])
    if name := options.get("ELSET"):
        file.got.cell_set(name.upper(), ids)


def _set(kind: str) -> Callable[..., None]:
    def read(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
        name = options.get(kind)
        if name is None:
            raise ValueError(f"line {line}: *{kind} has no name")
        known = file.got.node_sets if kind == "NSET" else file.got.cell_sets
        members: list[int] = []
        for number, fields in rows:
            own = [f for f in fields if f]
            if "GENERATE" in options:
                first, last, *step = (_whole(number, f) for f in own)
                if not 0 <= last - first < 10**8:
                    raise ValueError(f"line {number}: *{kind} is generated from {first} to {last}")
                members += range(first, last + 1, step[0] if step and step[0] > 0 else 1)
            else:
                for f in own:
                    members += known[f.upper()] if f.upper() in known else [_whole(number, f)]
        (file.got.node_set if kind == "NSET" else file.got.cell_set)(name.upper(), members)

    return read


def _section(file: _File, line: int, options: dict[str, str], rows: list[tuple[int, list[str]]]) -> None:
    if "ORIENTATION" in options:
        raise ValueError(
            f"line {line}: a section with an orientation, allowed is a material with axes in the case, in its place"
        )
    file.section_of[options.get("ELSET", "").upper()] = options.get("MATERIAL", "")


def _number(line: int, text: str) -> float:
    try:
        value = float(text.upper().replace("D", "E"))
    except ValueError:
        raise ValueError(f"line {line}: {text[:30]!r} is no number") from None
    if not np.isfinite(value):
        raise ValueError(f"line {line}: {text[:30]!r} is no finite number")
    return value


def _whole(line: int, text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"line {line}: {text[:30]!r} is no whole number and no known set") from None


_READ: dict[str, Callable[..., None]] = {
    "INSTANCE": _instance,
    "BOUNDARY": _boundary,
    "NODE": _node,
    "ELEMENT": _element,
    "NSET": _set("NSET"),
    "ELSET": _set("ELSET"),
    "SOLID SECTION": _section,
}
