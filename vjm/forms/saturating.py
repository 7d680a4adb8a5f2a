"""Saturating: steep about zero, level far from it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array

KNEE = Quantity("knee", 0, 1, "where it turns level", positive=True)


class Tanh(CurveForm):
    """y = A tanh(x / x0)."""

    name = "tanh"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "saturating, fast"
    equation = "y = A tanh(x / x0)"
    amplitudes = (Quantity("level", 1, 0, "value far from zero"),)
    shapes = (KNEE,)
    grows = "bounded"
    and_linear = True

    def points(self, x: Array, shapes: Array) -> Points:
        (knee,) = shapes
        t = x / knee
        # ln cosh without overflow.
        integral = knee * (np.abs(t) + np.log1p(np.exp(-2.0 * np.abs(t))) - np.log(2.0))
        return Points.of((np.tanh(t), (1.0 - np.tanh(t) ** 2) / knee, integral))

    def starts(self, largest: float) -> Sequence[Array]:
        return [np.array([share * largest]) for share in (0.05, 0.25, 1.0)]


class Atan(CurveForm):
    """y = A 2/π atan(x / x0)."""

    name = "atan"
    places = ("parallel",)
    beside = ("parallel", "series")
    title = "saturating, slowly"
    equation = "y = A (2/π) atan(x / x0)"
    amplitudes = (Quantity("level", 1, 0, "value far from zero"),)
    shapes = (KNEE,)
    grows = "bounded"
    and_linear = True

    def points(self, x: Array, shapes: Array) -> Points:
        (knee,) = shapes
        t, share = x / knee, 2.0 / np.pi
        integral = share * knee * (t * np.arctan(t) - 0.5 * np.log1p(t**2))
        return Points.of((share * np.arctan(t), share / (knee * (1.0 + t**2)), integral))

    def starts(self, largest: float) -> Sequence[Array]:
        return [np.array([share * largest]) for share in (0.05, 0.25, 1.0)]
