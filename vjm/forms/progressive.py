"""Progressive in series: a compliance that gives less and less, F = u / a + c u³."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Progressive(CurveForm):
    """y = A v(x / x0), v + v³ = x / x0: the load is x0 (y / A + (y / A)³)."""

    name = "progressive"
    title = "progressive spring in series"
    equation = "x = x0 (y / A + (y / A)³)"
    places = ("series",)
    amplitudes = (
        Quantity("knee", 1, 0, "displacement where slope and third power are equal", positive=True),
    )
    shapes = (Quantity("x0", 0, 1, "half of the load there", positive=True, span=(1e-4, 30.0)),)
    begins_at = ((0.03,), (0.2,), (1.0,))

    def points(self, x: Array, shapes: Array) -> Points:
        (x0,) = shapes
        root = 1.5 * np.sqrt(3.0)
        v = 2.0 / np.sqrt(3.0) * np.sinh(np.arcsinh(root * x / x0) / 3.0)
        rise = 1.0 + 3.0 * v**2
        return Points.of((v, 1.0 / (x0 * rise), x0 * (0.5 * v**2 + 0.75 * v**4)))
