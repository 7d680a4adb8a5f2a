"""The dimensions of the drawing."""

from __future__ import annotations

from typing import ClassVar

from vjm.effects.dimension_error import DimensionError
from vjm.tolerances.base import Tolerance


class Drawing(DimensionError, Tolerance):
    """Length and width of the drawing, each known to a few hundredths of a millimetre."""

    name = "drawing"
    title = "dimensions of the drawing"
    keys: ClassVar = {"length_mm": "length_mm", "width_mm": "width_mm"}
    deviations: ClassVar = {"length_mm": 0.05, "width_mm": 0.05}
