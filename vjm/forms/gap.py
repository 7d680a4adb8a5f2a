"""A gap in series: free travel about zero load, a slope beyond."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vjm.clearance import STOP, Clearance
from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array
from vjm.laws import Law

WITHIN = (2e-4, 2e-3, 0.02, 0.1)
"""Of the largest load, over which the travel is gone through where influences are known: a gap has no place at no
load, and loads are those of the model without it, in which bars share small ones otherwise. In the mechanism it has a
soft centring spring."""


class Gap(CurveForm):
    """y = g clip(x / x0, ±1) + k x: free travel 2 g, in a load x0 that is small."""

    name = "gap"
    title = "gap"
    equation = "y = g sign(x) + k x, g gone through while abs(x) < x0"
    places = ("series",)
    kinked = True
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {"along": ("joint_clearance",)}
    amplitudes = (
        Quantity("gap", 1, 0, "half of the free travel", positive=True),
        Quantity("slope", 1, -1, "compliance beside it", positive=True),
    )
    fixed = ("within",)
    shapes = (Quantity("within", 0, 1, "load within which the gap is gone through", positive=True),)
    begins_at = tuple((share,) for share in WITHIN)

    def points(self, x: Array, shapes: Array) -> Points:
        (within,) = shapes
        t = np.clip(x / within, -1.0, 1.0)
        integral = np.where(np.abs(t) < 1.0, 0.5 * within * t**2, np.abs(x) - 0.5 * within)
        slope = np.where(np.abs(t) < 1.0, 1.0 / within, 0.0)
        return Points.of((t, slope, integral), (x, np.ones_like(x), 0.5 * x**2))

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        """A play whose stops give: rows choose on which side of it they are (`vjm.clearance`)."""
        gap, slope = (float(each) for each in amplitudes)
        return Clearance(gap, 1.0 / max(slope, 1.0 / STOP))
