"""A power of its argument, as of contacts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points, odd
from vjm.frames import Array

LEAST = 1e-3
"""Of the load at which the amplitude is told, below which it is a straight line: the slope of a power may be infinite
at zero."""


class Power(CurveForm):
    """y = A sign(x) abs(x / x0)^p, linear very near to zero."""

    name = "power"
    holds = ("linear",)
    title = "power"
    equation = "y = A sign(x) abs(x / x0)^p"
    limits = "linear below a thousandth of x0"
    amplitudes = (Quantity("at_x0", 1, 0, "value at x0"),)
    shapes = (
        Quantity("exponent", 0, 0, "exponent p", positive=True, span=(0.1, 6.0)),
        Quantity("x0", 0, 1, "where the amplitude is told", positive=True),
    )
    fixed = ("x0",)
    grows = "power"
    and_linear = True
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {"along": ("contact_stiffening",)}
    begins_at = ((0.6, 1.0), (1.6, 1.0), (2.5, 1.0))

    def points(self, x: Array, shapes: Array) -> Points:
        p, x0 = shapes
        t = np.abs(x) / x0
        far = np.maximum(t, LEAST)
        chord = LEAST ** (p - 1.0)
        value = np.where(t < LEAST, chord * t, far**p)
        slope = np.where(t < LEAST, chord, p * far ** (p - 1.0)) / x0
        start = 0.5 * chord * LEAST**2 - LEAST ** (p + 1.0) / (p + 1.0)
        integral = x0 * np.where(t < LEAST, 0.5 * chord * t**2, start + far ** (p + 1.0) / (p + 1.0))
        return Points.of(odd(x, (value, slope, integral)))
