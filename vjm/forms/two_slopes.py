"""Not the same slope in both directions: a contact that opens, a one-sided support."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class TwoSlopes(CurveForm):
    """y = k+ x above zero, k- x below."""

    name = "two_slopes"
    holds = ("linear",)
    title = "two slopes"
    equation = "y = k+ x where x > 0, k- x where x < 0"
    amplitudes = (
        Quantity("above", 1, -1, "slope above zero"),
        Quantity("below", 1, -1, "slope below zero"),
    )

    def points(self, x: Array, shapes: Array) -> Points:
        up, down = np.maximum(x, 0.0), np.minimum(x, 0.0)
        return Points.of(
            (up, np.where(x > 0.0, 1.0, 0.0), 0.5 * up**2),
            (down, np.where(x > 0.0, 0.0, 1.0), 0.5 * down**2),
        )
