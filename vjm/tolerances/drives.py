"""The stiffness of the drives of a machine's file, as one number."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

from vjm.effects.base import Parameter, Values
from vjm.effects.parts import OfParts
from vjm.parts import Actuator, Part
from vjm.tolerances.base import Tolerance


class Drives(OfParts, Tolerance):
    """Stiffness of all drives, known to a share of itself; a rigid drive stays rigid."""

    name = "drives"
    title = "stiffness of all drives as given"
    equation = "k -> scale k of every drive"
    signature = "gives along the drives' axes alike in every posture"
    limits = "one factor for all drives"
    source = "linear elasticity"
    parts = "drives"
    parameters = (
        Parameter("scale", "1", 1.0, 0.03, 0.2, 5.0, "stiffness of all drives over the nominal one"),
    )
    keys: ClassVar = {"scale": "drives"}
    deviations: ClassVar = {"drives": 0.03}

    def changed_part(self, part: Part, values: Values) -> Part:
        if not isinstance(part, Actuator) or part.stiffness is None:
            return part
        return replace(part, stiffness=part.stiffness * values["scale"])
