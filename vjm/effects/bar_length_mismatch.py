"""Bar 1 is longer than bar 2; the pins stay at their distance, so the unloaded platform tilts."""

from __future__ import annotations

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars


class BarLengthMismatch(Effect):
    """Bar 1 = length + mismatch, bar 2 = length."""

    name = "bar_length_mismatch"
    title = "bars of different length"
    equation = "unloaded: ry = -m / (d cos q), x moves by m / (2 cos q) with z held"
    signature = (
        "a constant ry and x offset at every load; constant forces where ry or x is held; grows as 1/cos q"
    )
    limits = "the longer bar keeps its section; its 6x6 follows the length as a uniform bar's"
    source = "geometry of the four-bar loop"
    parameters = (Parameter("mismatch_mm", "mm", 0.0, 0.05, -5.0, 5.0, "length of bar 1 less that of bar 2"),)
    kinds = ("parallelogram",)

    def change(self, rig: Rig, values: Values) -> Rig:
        return for_bars(rig, lambda link: link.lengthened(values["mismatch_mm"]), only=0)
