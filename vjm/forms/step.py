"""Another slope about one place off zero: a step where it is steep, as of a seat that gives way or a catch, a landing
where it is flat, as of a preload that is overcome."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import LEAST_SLOPE, CurveForm, Points
from vjm.frames import Array


class Step(CurveForm):
    """y rises with one slope at a place and with another one far from it, and at the place by a twentieth of that at
    least: what is flat there in series would be rigid."""

    name = "step"
    title = "step or landing at a place, beside a slope"
    equation = "y = k (x - 0.95 s) + k0 s, s = w (tanh((x - c) / w) + tanh(c / w)), c = side x0"
    amplitudes = (
        Quantity("slope", 1, -1, "slope far from the place", positive=True),
        Quantity("there", 1, -1, "slope at the place beside k/20", positive=True),
    )
    shapes = (
        Quantity("place", 0, 1, "how far from zero it is", positive=True, span=(0.02, 1.0)),
        Quantity(
            "width", 0, 1, "half of that over which three quarters of it are made", True, span=(5e-3, 0.5)
        ),
        Quantity("side", 0, 0, "of zero on which it is, 1 above and -1 below"),
    )
    fixed = ("side",)
    begins_at = tuple((place, 0.08, side) for side in (1.0, -1.0) for place in (0.15, 0.4, 0.7))

    def points(self, x: Array, shapes: Array) -> Points:
        place, width, side = shapes
        at = side * place
        t, at_zero = (x - at) / width, np.tanh(at / width)
        there = np.tanh(t)
        own, slope = width * (there + at_zero), 1.0 - there**2
        integral = width * (width * (_log_cosh(t) - _log_cosh(at / width)) + at_zero * x)
        rest = 1.0 - LEAST_SLOPE
        far = x - rest * own, 1.0 - rest * slope, 0.5 * x**2 - rest * integral
        return Points.of(far, (own, slope, integral))


def _log_cosh(t: Array) -> Array:
    """Without overflow."""
    return np.asarray(np.abs(t) + np.log1p(np.exp(-2.0 * np.abs(t))) - np.log(2.0))
