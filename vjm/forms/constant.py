"""A constant: a preload, a difference of lengths, a place that was mounted otherwise."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Constant(CurveForm):
    """y = y0 from the first load step on."""

    name = "constant"
    title = "constant"
    equation = "y = y0"
    limits = "it looks like a dimension, a zero or a weight that is not as written"
    amplitudes = (Quantity("level", 1, 0, "value at all loads"),)
    places = ("parallel",)
    beside = ("parallel", "series")
    grows = "bounded"
    and_linear = True
    effects = MappingProxyType({"along": ("bar_length_mismatch", "dimension_error")})

    def points(self, x: Array, shapes: Array) -> Points:
        return Points.of((np.ones_like(x), np.zeros_like(x), x))
