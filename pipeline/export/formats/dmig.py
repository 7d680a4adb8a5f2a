"""Nastran bulk data: a grid point at either end and the matrix as DMIG entries in long fields.

A field has sixteen columns. A number is written with a D exponent, which makes it double precision, and as many digits
as fit: never fewer than ten, so that rounding stays below 5e-10 of each number.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export, commented, head, lost_by_springs
from pipeline.export.decks import Numbered, numbered

ONE = True
WIDTH = 16
_SYMMETRIC, _DOUBLE = 6, 2


def lost(it: Export) -> tuple[str, ...]:
    """What the file cannot hold."""
    rounded = "Numbers are rounded to what a field of 16 columns holds: 10 to 12 digits."
    turns = "The matrix does not turn with its points, and has no mass."
    return (*lost_by_springs(it), rounded, turns)


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file, to be named in an INCLUDE of the bulk data."""
    each = tuple(numbered(it.springs))
    use = f"Case control: K2GG = {', '.join(_name(one) for one in each)}. Clamp: SPC1 of 123456 at the first point."
    lines = commented("$ ", (*head(it, UNITS, lost(it)), use))
    for one in each:
        lines += _spring(one)
    return {out: ("\n".join(lines) + "\n").encode()}


def field(value: float) -> str:
    """A number in 16 columns with as many digits as there is room for."""
    if value == 0.0:
        return "0.0D0".ljust(WIDTH)
    for digits in range(15, 8, -1):
        mantissa, exponent = f"{value:.{digits}e}".split("e")
        text = f"{mantissa}D{int(exponent)}"
        if len(text) <= WIDTH:
            return text.ljust(WIDTH)
    raise ValueError(f"{value} does not fit {WIDTH} columns")


def _name(it: Numbered) -> str:
    """Of a matrix: letters and digits, at most eight."""
    return it.spring.name.replace("_", "").upper()


def _spring(it: Numbered) -> Iterator[str]:
    spring, name = it.spring, _name(it)
    ends = (it.first, it.first + 1)
    yield from commented("$ ", (f"{spring.what}; {spring.frame}",))
    for node, (x, y, z) in zip(ends, (spring.base, spring.point), strict=True):
        yield f"{'GRID*':8}{node:<16}{'':16}{field(x)}{field(y)}"
        yield f"{'*':8}{field(z)}"
    yield f"{'DMIG':8}{name:8}{0:<8}{_SYMMETRIC:<8}{_DOUBLE:<8}{0:<8}"
    places = [(node, axis) for node in ends for axis in range(1, 7)]
    matrix = spring.between
    for column, (node, axis) in enumerate(places):
        rows = [row for row in range(column, 12) if matrix[row, column]]
        if not rows:
            continue
        yield f"{'DMIG*':8}{name:16}{node:<16}{axis:<16}"
        for row in rows:
            other, direction = places[row]
            yield f"{'*':8}{other:<16}{direction:<16}{field(float(np.float64(matrix[row, column])))}"
