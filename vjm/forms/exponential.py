"""Stiffening by an exponential, as of rubber near its stop."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points, odd
from vjm.frames import Array

MOST = 50.0
"""Of the exponent, beyond which the curve goes on as a straight line: no linkage gets there."""


class Exponential(CurveForm):
    """y = A sign(x) (exp(abs(x) / x0) - 1)."""

    name = "exponential"
    title = "exponential"
    equation = "y = A sign(x) (exp(abs(x) / x0) - 1)"
    limits = "beyond the loads measured it grows faster than anything else here"
    amplitudes = (Quantity("scale", 1, 0, "factor of the exponential"),)
    shapes = (Quantity("x0", 0, 1, "over which it grows by e", positive=True, span=(0.05, 20.0)),)
    grows = "exponential"
    begins_at = ((0.25,), (0.6,), (2.0,))

    def points(self, x: Array, shapes: Array) -> Points:
        (x0,) = shapes
        t = np.abs(x) / x0
        near, over = np.minimum(t, MOST), np.maximum(t - MOST, 0.0)
        e = np.exp(near)
        value, slope = np.expm1(near) + e * over, e / x0
        integral = x0 * (np.expm1(near) - near + (e - 1.0) * over + 0.5 * e * over**2)
        return Points.of(odd(x, (value, slope, integral)))
