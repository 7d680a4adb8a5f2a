"""Nothing about zero, a slope beyond: a joint that is free in a gap; in series, what gives from a preload on."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class DeadZone(CurveForm):
    """y = k (x - clip(x, ±x0))."""

    name = "dead_zone"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "dead zone, linear beyond"
    equation = "y = k (x - x0 sign x) where abs(x) > x0, else 0"
    amplitudes = (Quantity("beyond", 1, -1, "slope beyond the zone"),)
    shapes = (Quantity("zone", 0, 1, "half width of the dead zone", positive=True),)
    and_linear = True
    begins_at = ((0.1,), (0.3,), (0.6,))

    def points(self, x: Array, shapes: Array) -> Points:
        (zone,) = shapes
        beyond = x - np.clip(x, -zone, zone)
        return Points.of((beyond, np.where(beyond == 0.0, 0.0, 1.0), 0.5 * beyond**2))
