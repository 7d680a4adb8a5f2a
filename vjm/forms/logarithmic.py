"""A compliance that hardens exponentially: as rubber near its stop, in series."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points, odd
from vjm.frames import Array


class Logarithmic(CurveForm):
    """y = A sign(x) ln(1 + abs(x) / x0): the load grows exponentially with the displacement."""

    name = "logarithmic"
    title = "hardening exponentially, in series"
    equation = "y = A sign(x) ln(1 + abs(x) / x0)"
    places = ("series",)
    amplitudes = (Quantity("scale", 1, 0, "displacement over which the load grows by e", positive=True),)
    shapes = (Quantity("x0", 0, 1, "load from which it hardens", positive=True, span=(1e-3, 30.0)),)
    begins_at = ((0.03,), (0.2,), (1.0,))

    def points(self, x: Array, shapes: Array) -> Points:
        (x0,) = shapes
        t = np.abs(x) / x0
        integral = x0 * ((1.0 + t) * np.log1p(t) - t)
        return Points.of(odd(x, (np.log1p(t), 1.0 / (x0 * (1.0 + t)), integral)))
