"""Even: not the same in both directions."""

from __future__ import annotations

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Square(CurveForm):
    """y = s x², beside a slope."""

    name = "square"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "square"
    equation = "y = s x²"
    limits = "a power beyond the loads measured"
    amplitudes = (Quantity("square", 1, -2, "factor of the square"),)
    grows = "power"
    and_linear = True

    def points(self, x: Array, shapes: Array) -> Points:
        return Points.of((x**2, 2.0 * x, x**3 / 3.0))
