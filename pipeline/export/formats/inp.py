"""Input decks: CalculiX in the file that was asked for, Abaqus beside it under the same name with `_abaqus`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from pipeline.export import calculix
from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export, Spring, commented, head, lost_by_springs
from pipeline.export.decks import Numbered, numbered

ONE = True
_USE = (
    "Small rotations only: the matrix does not turn with its nodes. Node BASE, then node TIP, degrees 1 to 6 each. "
    "Clamp: *BOUNDARY, BASE,1,6."
)


def lost(it: Export) -> tuple[str, ...]:
    """What neither of the two decks can hold."""
    turns = "The matrices do not turn with their nodes: a linear analysis alone takes them."
    masses = "Neither of the decks has masses."
    return (*lost_by_springs(it), turns, masses)


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """Two files."""
    lines = head(it, UNITS, lost(it))
    other = out.with_name(f"{out.stem}_abaqus{out.suffix}")
    return {
        out: calculix.deck(it.springs, ("For CalculiX", *lines)).encode(),
        other: _abaqus(it.springs, ("For Abaqus", *lines)).encode(),
    }


def _abaqus(springs: Sequence[Spring], comments: Sequence[str]) -> str:
    """For Abaqus, to be named in an *INCLUDE: a linear user element whose stiffness matrix is given.

    The upper triangle column by column, each column on lines of its own, four numbers a line (Abaqus Keywords
    Reference, *MATRIX and *USER ELEMENT).
    """
    lines = commented("** ", (*comments, _USE))
    for each in numbered(springs):
        lines += _spring(each)
    return "\n".join(lines) + "\n"


def _spring(it: Numbered) -> Iterator[str]:
    spring, mark = it.spring, "" if it.number == 1 else str(it.number)
    base, tip = it.first, it.first + 1
    yield from commented("** ", (f"{spring.what}; {spring.frame}",))
    for name, node, place in (("BASE", base, spring.base), ("TIP", tip, spring.point)):
        yield f"*NODE, NSET={name}{mark}"
        yield f"{node}, {_line(place)}"
    kind = f"U{900 + it.number}"
    yield f"*USER ELEMENT, TYPE={kind}, NODES=2, COORDINATES=3, LINEAR"
    yield "1, 2, 3, 4, 5, 6"
    yield "*MATRIX, TYPE=STIFFNESS"
    matrix = spring.between
    for column in range(12):
        for start in range(0, column + 1, 4):
            yield _line(matrix[start : min(start + 4, column + 1), column])
    yield f"*ELEMENT, TYPE={kind}, ELSET=STIFFNESS{mark}"
    yield f"{it.first}, {base}, {tip}"
    yield f"*UEL PROPERTY, ELSET=STIFFNESS{mark}"


def _line(values: np.ndarray) -> str:
    return ", ".join(f"{value:.16e}" for value in values)
