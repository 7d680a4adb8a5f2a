"""The fixture gives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vjm.effects.base import Effect, Parameter, Rig, Values, vector
from vjm.sensors import BaseSpring

_NAMES = ("x", "y", "z", "rx", "ry", "rz")
_SHIFT = [
    Parameter(f"{n}_mm_per_N", "mm/N", 0.0, 2e-6, 0.0, 1e-2, f"give of the base along {n}", n)
    for n in _NAMES[:3]
]
_TURN = [
    Parameter(f"{n}_rad_per_Nmm", "rad/(N·mm)", 0.0, 1e-9, 0.0, 1e-5, f"give of the base about {n[1]}", n)
    for n in _NAMES[3:]
]


class BaseCompliance(Effect):
    """Six springs between ground and base, at the base origin, along the base frame's axes."""

    name = "base_compliance"
    parts = "base"
    title = "base on springs"
    equation = "base displacement = C x wrench at the base origin, C diagonal"
    signature = "softer, in directions fixed in the base frame whatever the angle of the bars; linear"
    limits = "linear, diagonal; hardly to be told from soft hinge axes (correlation 0.996)"
    source = "springs in series"
    parameters = (*_SHIFT, *_TURN)

    def change(self, rig: Rig, values: Values) -> Rig:
        compliance = np.diag(vector(values, *(p.name for p in self.parameters)))
        return replace(rig, sensors=(*rig.sensors, BaseSpring(compliance)))
