"""In series: a spring beside dry friction, so that a joint slips under load and springs back with a loop."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Form, Quantity
from vjm.forms.sliders import Sliders, driven
from vjm.frames import Array
from vjm.laws import Law


class Slip(Form):
    """x = x0 (y / r + m s), s a slider of reach r: y = r times a function of x / x0."""

    name = "slip"
    title = "slip beside a spring"
    equation = "x = x0 (y/r + m s), abs(s) <= 1, ds = dy/r while it sticks"
    places = ("series",)
    amplitudes = (Quantity("reach", 1, 0, "displacement before it slips", positive=True),)
    shapes = (
        Quantity("x0", 0, 1, "load of the spring at that displacement", positive=True, span=(1e-4, 10.0)),
        Quantity("friction", 0, 0, "friction in that load", positive=True, span=(0.01, 1e3)),
    )
    memory = True
    begins_at = ((0.02, 5.0), (0.1, 2.0), (0.3, 0.5), (0.02, 0.5))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return driven(x, first, self._unit(shapes))[:, None]

    def _unit(self, shapes: Array, reach: float = 1.0) -> Sliders:
        x0, friction = shapes
        return Sliders(float(x0 / reach), np.array([x0 * friction]), np.array([reach]))

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return self._unit(shapes, float(amplitudes[0]))
