"""Coulomb friction in every hinge, elastic before it slips."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.friction import Jenkins


class JointFriction(Effect):
    """A Jenkins element about each hinge axis: a spring in series with a slider, relaxed in the unloaded linkage."""

    name = "joint_friction"
    title = "friction in the hinges"
    equation = "abs(M) <= T, dM = T / presliding x d(angle) while it sticks"
    signature = "a loop between loading and unloading; a step when the direction turns; no growth with load"
    limits = "T does not follow the hinge's load; without a reversal it looks like a constant force"
    source = "W. D. Iwan, Journal of Applied Mechanics 33 (1966) 893-900"
    parameters = (
        Parameter("torque_Nmm", "N·mm", 0.0, 300.0, 0.0, 1e5, "torque of one hinge while it slips"),
        Parameter(
            "presliding_rad", "rad", 0.002, 0.002, 1e-5, 0.05, "turn of a relaxed hinge before it slips"
        ),
    )
    hinge = "any"
    smooth = False
    probes = (300.0,)
    history = True

    def absent(self, values: Values) -> bool:
        return values["torque_Nmm"] == 0.0

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, hinges=(*rig.hinges, Jenkins(values["torque_Nmm"], values["presliding_rad"])))
