"""A dead zone that is not about the middle, with another slope on either side: a stop beside a softer one."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class TwoZones(CurveForm):
    """y = k+ (x - a) above a, k- (x + b) below -b, nothing between."""

    name = "two_zones"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "dead zone with unlike sides"
    equation = "y = k+ (x - a) where x > a, k- (x + b) where x < -b, else 0"
    amplitudes = (
        Quantity("above", 1, -1, "slope beyond the zone above zero"),
        Quantity("below", 1, -1, "slope beyond the zone below zero"),
    )
    shapes = (
        Quantity("zone_above", 0, 1, "end of the dead zone above zero", positive=True),
        Quantity("zone_below", 0, 1, "end of the dead zone below zero", positive=True),
    )
    and_linear = True
    begins_at = ((0.15, 0.15), (0.2, 0.5), (0.5, 0.2), (0.5, 0.5))

    def points(self, x: Array, shapes: Array) -> Points:
        up, down = np.maximum(x - shapes[0], 0.0), np.minimum(x + shapes[1], 0.0)
        return Points.of(
            (up, np.where(up > 0.0, 1.0, 0.0), 0.5 * up**2),
            (down, np.where(down < 0.0, 1.0, 0.0), 0.5 * down**2),
        )
