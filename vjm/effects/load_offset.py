"""The load cell's point is not the platform point."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, vector
from vjm.sensors import CellOffset


class LoadOffset(Effect):
    """The cell stands at r from the platform point, so its moment lacks r x f."""

    name = "load_offset"
    parts = "sensors"
    title = "load cell off the platform point"
    equation = "moment reading = m - r x f"
    signature = "moments proportional to the forces across them"
    limits = "r keeps its direction while the platform turns"
    source = "moving the point of a wrench"
    parameters = tuple(
        Parameter(
            f"{n}_mm", "mm", 0.0, 1.0, -100.0, 100.0, f"the cell's point from the platform point along {n}"
        )
        for n in ("x", "y", "z")
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, sensors=(*rig.sensors, CellOffset(vector(values, "x_mm", "y_mm", "z_mm"))))
