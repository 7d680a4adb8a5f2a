"""The drives of a machine give: screw, belt, bearing and control loop, beyond what its file says."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Parameter, Values
from vjm.effects.parts import OfParts
from vjm.parts import Actuator, Part


class ActuatorCompliance(OfParts):
    """Every drive gives along or about its axis, in addition to what is written of it."""

    name = "actuator_compliance"
    title = "compliance of all drives, along or about their axes"
    equation = "1/k -> 1/k + c, k the stiffness of a drive as given"
    signature = "gives along the drives' axes alike in every posture; in proportion to the load, no loop"
    limits = "all drives alike; linear; positions are held by control without error"
    source = "linear elasticity: compliances of what is in series add"
    parts = "drives"
    parameters = (
        Parameter("mm_per_N", "mm/N", 0.0, 5e-5, 0.0, 1e-2, "give of each linear drive along its axis"),
        Parameter(
            "rad_per_Nmm", "rad/(N·mm)", 0.0, 1e-8, 0.0, 1e-4, "give of each rotary drive about its axis"
        ),
    )

    def changed_part(self, part: Part, values: Values) -> Part:
        if not isinstance(part, Actuator):
            return part
        more = values["mm_per_N" if part.kind == "translation" else "rad_per_Nmm"]
        if more == 0.0:
            return part
        own = 0.0 if part.stiffness is None else 1.0 / part.stiffness
        return replace(part, stiffness=1.0 / (own + more))
