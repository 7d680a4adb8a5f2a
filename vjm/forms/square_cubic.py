"""Slope, square and third power together."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class SquareCubic(CurveForm):
    """y = k x + s x² + c x³."""

    name = "square+cubic"
    title = "slope, square and third power"
    equation = "y = k x + s x² + c x³"
    limits = "a power beyond the loads measured: it grows fast there"
    amplitudes = (
        Quantity("slope", 1, -1, "slope at zero"),
        Quantity("square", 1, -2, "factor of the square"),
        Quantity("cubic", 1, -3, "factor of the third power"),
    )
    grows = "power"

    def points(self, x: Array, shapes: Array) -> Points:
        return Points.of(
            (x, np.ones_like(x), 0.5 * x**2),
            (x**2, 2.0 * x, x**3 / 3.0),
            (x**3, 3.0 * x**2, 0.25 * x**4),
        )
