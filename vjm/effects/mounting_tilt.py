"""The whole linkage stands turned against the base frame in which the sensors read."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, vector


class MountingTilt(Effect):
    """A rotation of base, bars and platform together."""

    name = "mounting_tilt"
    parts = "base"
    title = "linkage mounted at an angle"
    equation = "p -> R p, R = exp(rx, ry, rz); ry is the zero error of q"
    signature = "offsets of the pose by L x tilt; loads along x appear along y and z"
    limits = "sensors stay along the base frame; angles add as vectors, small as they are"
    source = "rigid rotation"
    parameters = tuple(
        Parameter(f"{n}_rad", "rad", 0.0, 0.002, -0.3, 0.3, f"turn about {n[1]}") for n in ("rx", "ry", "rz")
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, mount=rig.mount + vector(values, "rx_rad", "ry_rad", "rz_rad"))
