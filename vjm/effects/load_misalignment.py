"""The load cell is turned against the base frame."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, vector
from vjm.sensors import CellTurn


class LoadMisalignment(Effect):
    """The cell reads forces and moments along its own axes."""

    name = "load_misalignment"
    parts = "sensors"
    title = "load cell turned"
    equation = "reading = R^T f, R^T m, R = exp(rx, ry, rz)"
    signature = "a share of each large force appears in the other directions, proportional to it"
    limits = "the cell keeps its direction while the platform turns"
    source = "rigid rotation"
    parameters = tuple(
        Parameter(f"{n}_rad", "rad", 0.0, 0.01, -0.5, 0.5, f"turn of the cell about {n[1]}")
        for n in ("rx", "ry", "rz")
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        turn = vector(values, "rx_rad", "ry_rad", "rz_rad")
        return replace(rig, sensors=(*rig.sensors, CellTurn(turn)))
