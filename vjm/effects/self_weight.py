"""Weight that nobody entered: of the platform, and along the bars."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, vector
from vjm.sensors import DeadWeight

_FORCE = [
    Parameter(f"platform_{n}_N", "N", 0.0, 5.0, -1e3, 1e3, f"weight of the platform along {n}")
    for n in ("x", "y", "z")
]


class SelfWeight(Effect):
    """A dead force on the platform point that the cell does not read, and one along the bars."""

    name = "self_weight"
    parts = "platform"
    title = "weight of platform and bars"
    equation = "the linkage carries F + W; bars bend by w L⁴ / (8 EI) at a free tip"
    signature = "a constant force or deflection, the same at every load; a tare of the cell looks the same"
    limits = "line weight along the rig's gravity, the same in all bars; buoyancy of moving parts left out"
    source = (
        "S. P. Timoshenko, Strength of Materials, part I, 3rd ed. 1955, on cantilevers under uniform load"
    )
    parameters = (
        *_FORCE,
        Parameter(
            "line_N_per_mm", "N/mm", 0.0, 3e-3, 0.0, 1.0, "weight of one bar per length, along gravity"
        ),
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        weight = DeadWeight(vector(values, *(p.name for p in _FORCE)))
        line_load = rig.line_load + values["line_N_per_mm"] * rig.gravity
        return replace(rig, sensors=(*rig.sensors, weight), line_load=line_load)
