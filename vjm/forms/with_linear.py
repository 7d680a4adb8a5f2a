"""A form with a linear part beside it."""

from __future__ import annotations

import numpy as np

from vjm.forms.curve import CurveForm, Points
from vjm.forms.linear import SLOPE
from vjm.frames import Array


class WithLinear(CurveForm):
    """y = k x + that of another form, which is a curve."""

    def __init__(self, other: CurveForm) -> None:
        of = {
            "name": f"linear+{other.name}",
            "title": f"{other.title}, beside a slope",
            "equation": f"y = k x + y1, {other.equation.replace('y =', 'y1 =')}",
            "limits": other.limits,
            "places": other.beside or other.places,
            "amplitudes": (SLOPE, *other.amplitudes),
            "shapes": other.shapes,
            "begins_at": other.begins_at,
            "grows": "linear" if other.grows == "bounded" else other.grows,
        }
        # Attributes of the instance stand before those of its class.
        vars(self).update(of, other=other, fixed=other.fixed)

    def points(self, x: Array, shapes: Array) -> Points:
        there: Points = vars(self)["other"].points(x, shapes)
        return Points.of((x, np.ones_like(x), 0.5 * x**2)).beside(there)
