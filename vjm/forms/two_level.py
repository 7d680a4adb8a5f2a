"""Dry friction that begins to slip at two levels."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Form, Quantity
from vjm.forms.sliders import Sliders, followed
from vjm.frames import Array
from vjm.laws import Law


class TwoLevel(Form):
    """y = T1 s1 + T2 s2, sliders of two reaches."""

    name = "two_level"
    holds = ("coulomb",)
    title = "dry friction at two levels"
    equation = "y = z1 + z2, abs(zi) <= Ti, dzi = Ti/ri dx while it sticks"
    places = ("parallel",)
    amplitudes = (
        Quantity("limit1", 1, 0, "of the first level", positive=True),
        Quantity("limit2", 1, 0, "of the second level", positive=True),
    )
    shapes = (
        Quantity("reach1", 0, 1, "travel before the first slips", positive=True),
        Quantity("reach2", 0, 1, "travel before the second slips", positive=True),
    )
    memory = True
    grows = "bounded"
    begins_at = ((0.01, 0.1), (0.03, 0.3), (0.1, 0.6))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return followed(x, first, shapes)

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Sliders(0.0, amplitudes, shapes)
