"""Friction that begins to slip little by little: many sliders, their reaches spread evenly."""

from __future__ import annotations

from collections.abc import Sequence

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
    equation = "y = T (s1 + ... + s12) / 12, reaches spread evenly up to r"
    places = ("parallel",)
    amplitudes = (Quantity("limit", 1, 0, "when all slips", positive=True),)
    shapes = (Quantity("reach", 0, 1, "travel at which all slips", positive=True),)
    memory = True
    grows = "bounded"

    def reaches(self, shapes: Array) -> Array:
        """(12,) of the sliders."""
        return np.asarray(shapes[0] * (np.arange(SLIDERS) + 0.5) / SLIDERS)

    def columns(self, x: Array, first: np.ndarray, shapes: Array) -> Array:
        return np.asarray(followed(x, first, self.reaches(shapes)).mean(axis=1, keepdims=True))

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Sliders(0.0, np.full(SLIDERS, amplitudes[0] / SLIDERS), self.reaches(shapes))

    def starts(self, largest: float) -> Sequence[Array]:
        return [np.array([share * largest]) for share in (0.05, 0.3, 1.0)]
