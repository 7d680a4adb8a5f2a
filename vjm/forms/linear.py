"""A constant slope."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array

SLOPE = Quantity("slope", 1, -1, "slope")


class Linear(CurveForm):
    """y = k x."""

    name = "linear"
    title = "linear"
    equation = "y = k x"
    amplitudes = (SLOPE,)
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "hinge_torque": ("joint_torsional_stiffness",),
        **dict.fromkeys(("along", "across", "tilt_x", "tilt_z"), ("axis_flexibility",)),
        **dict.fromkeys(
            tuple(f"base_{name}" for name in ("x", "y", "z", "rx", "ry", "rz")), ("base_compliance",)
        ),
    }

    def points(self, x: Array, shapes: Array) -> Points:
        return Points.of((x, np.ones_like(x), 0.5 * x**2))
