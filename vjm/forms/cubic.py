"""Odd and stiffening, or softening, with the third power."""

from __future__ import annotations

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Cubic(CurveForm):
    """y = c x³, alone or beside a slope."""

    name = "cubic"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "third power"
    equation = "y = c x³"
    limits = "a power beyond the loads measured: it grows fast there"
    amplitudes = (Quantity("cubic", 1, -3, "factor of the third power"),)
    grows = "power"
    and_linear = True

    def points(self, x: Array, shapes: Array) -> Points:
        return Points.of((x**3, 3.0 * x**2, 0.25 * x**4))
