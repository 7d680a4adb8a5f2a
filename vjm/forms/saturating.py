"""Saturating: steep about zero, level far from it."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Saturating(CurveForm):
    """Both have a level and a knee."""

    places = ("parallel",)
    beside = ("parallel", "series")
    amplitudes = (Quantity("level", 1, 0, "value far from zero"),)
    shapes = (Quantity("knee", 0, 1, "where it turns level", positive=True),)
    grows = "bounded"
    and_linear = True
    begins_at = ((0.05,), (0.25,), (1.0,))


class Tanh(Saturating):
    """y = A tanh(x / x0)."""

    name = "tanh"
    title = "saturating, fast"
    equation = "y = A tanh(x / x0)"

    def points(self, x: Array, shapes: Array) -> Points:
        (knee,) = shapes
        t = x / knee
        # ln cosh without overflow.
        integral = knee * (np.abs(t) + np.log1p(np.exp(-2.0 * np.abs(t))) - np.log(2.0))
        return Points.of((np.tanh(t), (1.0 - np.tanh(t) ** 2) / knee, integral))


class Atan(Saturating):
    """y = A 2/π atan(x / x0)."""

    name = "atan"
    title = "saturating, slowly"
    equation = "y = A (2/π) atan(x / x0)"

    def points(self, x: Array, shapes: Array) -> Points:
        (knee,) = shapes
        t, share = x / knee, 2.0 / np.pi
        integral = share * knee * (t * np.arctan(t) - 0.5 * np.log1p(t**2))
        return Points.of((share * np.arctan(t), share / (knee * (1.0 + t**2)), integral))
