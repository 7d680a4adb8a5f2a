"""A table: straight from knot to knot, rising all the way, for a law that is in no other form.

It says what was measured, within the range in which that was; beyond it the last piece goes on.
"""

from __future__ import annotations

from itertools import pairwise
from typing import ClassVar

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array

KNOTS = (0.0, 0.1, 0.3, 0.6, 1.0)
"""In the range, on either side: denser about zero, where most laws begin to act and all tests have been."""
PIECES = len(KNOTS) - 1


def _rises(side: str) -> tuple[Quantity, ...]:
    return tuple(
        Quantity(f"{side}_{k}", 1, 0, f"rise from {a:g} to {b:g} of the range {side} zero", positive=True)
        for k, (a, b) in enumerate(pairwise(KNOTS), start=1)
    )


class Table(CurveForm):
    """y rises by one number in each of four pieces above zero and four below."""

    name = "table"
    title = "table, straight from knot to knot"
    equation = "y = 0 at 0, and rises by above_k in piece k above zero, by below_k in piece k below"
    limits = "valid within the range; the last piece goes on beyond it"
    amplitudes: ClassVar[tuple[Quantity, ...]] = (*_rises("above"), *_rises("below"))
    shapes = (Quantity("range", 0, 1, "largest coordinate that was seen", positive=True),)
    fixed = ("range",)
    begins_at = ((1.0,),)

    def points(self, x: Array, shapes: Array) -> Points:
        ends = shapes[0] * np.array(KNOTS)
        parts = [
            _piece(sign, x, float(a), float(b), last=k == PIECES - 1)
            for sign in (1.0, -1.0)
            for k, (a, b) in enumerate(pairwise(ends))
        ]
        return Points.of(*parts)


def _piece(sign: float, x: Array, a: float, b: float, last: bool) -> tuple[Array, Array, Array]:
    """Value, slope and integral of what rises by one from a to b on one side of zero; the last one goes on."""
    there, size = sign * x - a, b - a
    inside = np.maximum(there, 0.0) if last else np.clip(there, 0.0, size)
    rising = (there > 0.0) & (last | (there <= size))
    beyond = np.maximum(there, 0.0) - inside
    return sign * inside / size, rising / size, 0.5 * inside**2 / size + beyond
