"""Dry friction at one level, with an elastic start."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vjm.forms.base import Form, Quantity
from vjm.forms.sliders import Sliders, followed
from vjm.frames import Array
from vjm.laws import Law

REACH = Quantity("reach", 0, 1, "travel before it slips", positive=True)


class Coulomb(Form):
    """y = T s, s a slider of reach r."""

    name = "coulomb"
    title = "dry friction"
    equation = "abs(y) <= T, dy = T/r dx while it sticks"
    places = ("parallel",)
    amplitudes: ClassVar[tuple[Quantity, ...]] = (Quantity("limit", 1, 0, "while it slips", positive=True),)
    shapes = (REACH,)
    memory = True
    grows = "bounded"
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {"hinge_torque": ("joint_friction",)}
    begins_at = ((0.01,), (0.06,), (0.3,))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return followed(x, first, shapes)

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Sliders(0.0, amplitudes, shapes)


class LinearCoulomb(Coulomb):
    """y = k x + T s."""

    name = "linear+coulomb"
    title = "dry friction beside a spring"
    equation = "y = k x + z, abs(z) <= T, dz = T/r dx while it sticks"
    amplitudes = (
        Quantity("slope", 1, -1, "slope of the spring", positive=True),
        Quantity("limit", 1, 0, "friction while it slips", positive=True),
    )
    grows = "linear"
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "hinge_torque": ("joint_friction", "joint_torsional_stiffness")
    }

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return np.column_stack([x, followed(x, first, shapes)])

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Sliders(float(amplitudes[0]), amplitudes[1:], shapes)
