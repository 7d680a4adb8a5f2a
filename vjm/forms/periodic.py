"""Periodic in the coordinate, as of detents, balls of a bearing, teeth."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Quantity
from vjm.forms.curve import CurveForm, Points
from vjm.frames import Array


class Periodic(CurveForm):
    """y = S sin(2π x / x0) + C (cos(2π x / x0) - 1)."""

    name = "periodic"
    title = "periodic"
    equation = "y = S sin(2π x / x0) + C (cos(2π x / x0) - 1)"
    limits = "needs several periods in the range"
    places = ("parallel",)
    amplitudes = (
        Quantity("sine", 1, 0, "amplitude of the sine"),
        Quantity("cosine", 1, 0, "amplitude of the cosine"),
    )
    shapes = (Quantity("period", 0, 1, "period", positive=True, span=(0.03, 2.0)),)
    grows = "bounded"
    and_linear = True
    begins_at = ((0.08,), (0.12,), (0.18,), (0.27,), (0.4,), (0.6,), (0.9,), (1.4,))

    def points(self, x: Array, shapes: Array) -> Points:
        w = 2.0 * np.pi / shapes[0]
        return Points.of(
            (np.sin(w * x), w * np.cos(w * x), (1.0 - np.cos(w * x)) / w),
            (np.cos(w * x) - 1.0, -w * np.sin(w * x), np.sin(w * x) / w - x),
        )
