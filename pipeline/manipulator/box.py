"""The grid of a sweep as a command line asks for it."""

from math import isfinite

import numpy as np
from numpy.typing import NDArray

from pipeline.errors import InputError
from pipeline.manipulator.grid import Grid
from vjm.manipulator.parts import Manipulator

REACH = 0.25
"""Half edge of the default cube about home, over the characteristic length of the manipulator."""
POINTS = 21


def box(
    manipulator: Manipulator, home: NDArray[np.float64], low: str | None, high: str | None, points: str
) -> Grid:
    """The grid from texts: low and high corner "X,Y,Z", mm, and points along each axis "N" or "NX,NY,NZ".

    Without corners a cube about home (6,), mm and rad. InputError for what is no such text, and for a bad grid.
    """
    reach = REACH * manipulator.length
    begin = numbers("--low", low, 3) if low is not None else [float(x) - reach for x in home[:3]]
    end = numbers("--high", high, 3) if high is not None else [float(x) + reach for x in home[:3]]
    counts = numbers("--points", points, 1 if "," not in points else 3)
    if any(n != int(n) for n in counts):
        raise InputError(f"--points is {points}, allowed are whole numbers")
    many = [int(n) for n in (counts * 3 if len(counts) == 1 else counts)]
    # A flat box has one point across.
    many = [1 if a == b else n for a, b, n in zip(begin, end, many, strict=True)]
    return Grid((begin[0], begin[1], begin[2]), (end[0], end[1], end[2]), (many[0], many[1], many[2]))


def numbers(option: str, text: str, count: int) -> list[float]:
    """So many finite numbers between commas."""
    try:
        out = [float(part) for part in text.split(",")]
    except ValueError:
        out = []
    if len(out) != count or not all(isfinite(x) for x in out):
        allowed = "is a number" if count == 1 else f"are {count} numbers between commas"
        raise InputError(f"{option} is {text or 'empty'}, allowed {allowed}")
    return out
