"""A user's own effect: a seal that stiffens with the cube of the angle, in every hinge."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.frames import Array
from vjm.laws import Response


@dataclass(frozen=True)
class Cubic:
    """M = c angle³."""

    c: float

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def respond(self, strain: Array, memory: Array) -> Response:
        energy = 0.25 * self.c * strain[..., 0] ** 4
        return Response(energy, self.c * strain**3, 3.0 * self.c * strain[..., None] ** 2, memory)


class SealSpring(Effect):
    """A torque that follows the third power of the turn."""

    name = "seal_spring"
    title = "seals stiffen the hinges"
    equation = "M = c angle³"
    signature = "a force along z that grows with the cube of the displacement; no loop"
    limits = "all hinges alike"
    source = "Taylor series of an odd law"
    parameters = (Parameter("cubic_Nmm", "N·mm/rad³", 0.0, 5e6, 0.0, 1e9, "torque at one radian"),)
    hinge = "any"

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, hinges=(*rig.hinges, Cubic(values["cubic_Nmm"])))
