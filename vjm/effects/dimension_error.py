"""Both bars are longer, both widths wider than the drawing."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars
from vjm.mechanisms.parallelogram import Parallelogram

_LENGTH = Parameter("length_mm", "mm", 0.0, 0.1, -20.0, 20.0, "all bars longer by")
_WIDTH = Parameter("width_mm", "mm", 0.0, 0.2, -20.0, 20.0, "base and platform wider by")


class DimensionError(Effect):
    """Lengths and widths that differ from the nominal ones in the same way on both sides."""

    name = "dimension_error"
    parts = "bars"
    title = "dimensions differ from the drawing"
    equation = "L -> L + length, d -> d + width; a uniform bar's 6x6 follows its length"
    signature = "a constant x offset (length); rotational stiffness changes with the square of the width"
    limits = "the same error in both bars and in both widths; a single bar has no width: no test of it says anything"
    source = "geometry; Eq. 11 of the paper for the width"
    parameters = (_LENGTH, _WIDTH)

    def change(self, rig: Rig, values: Values) -> Rig:
        longer = for_bars(rig, lambda link: link.lengthened(values["length_mm"]))
        if not isinstance(longer, Parallelogram):
            return longer
        return replace(longer, wider=longer.wider + values["width_mm"])
