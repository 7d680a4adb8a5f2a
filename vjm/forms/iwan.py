"""Friction that begins to slip little by little: many springs alike, each in series with a slider, whose limits are
spread evenly from zero on (W. D. Iwan, A distributed-element model for hysteresis and its steady-state dynamic
response, Journal of Applied Mechanics 33 (1966) 893-900).

The first loading is y = T (2 x/r - (x/r)²) up to the travel r at which all slip, which the sliders follow as a polygon
of SLIDERS sides.
"""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Form, Quantity
from vjm.forms.sliders import Sliders, followed
from vjm.frames import Array
from vjm.laws import Law

SLIDERS = 12


class Iwan(Form):
    """y = T mean of s_i, reaches r_i = r (i - 1/2) / 12."""

    name = "iwan"
    title = "friction that begins little by little"
    equation = "y = T (w1 s1 + ... + w12 s12), wi ~ ri, reaches spread evenly up to r"
    places = ("parallel",)
    amplitudes = (Quantity("limit", 1, 0, "when all slips", positive=True),)
    shapes = (Quantity("reach", 0, 1, "travel at which all slips", positive=True),)
    memory = True
    grows = "bounded"
    begins_at = ((0.05,), (0.3,), (1.0,))

    def reaches(self, shapes: Array) -> Array:
        """(12,) of the sliders."""
        return np.asarray(shapes[0] * (np.arange(SLIDERS) + 0.5) / SLIDERS)

    @property
    def shares(self) -> Array:
        """(12,) of the limit: springs alike have limits as their reaches."""
        each = np.arange(SLIDERS) + 0.5
        return np.asarray(each / each.sum())

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return np.asarray(followed(x, first, self.reaches(shapes)) @ self.shares[:, None])

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Sliders(0.0, amplitudes[0] * self.shares, self.reaches(shapes))
