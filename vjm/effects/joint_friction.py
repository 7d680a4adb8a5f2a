"""Coulomb friction in every hinge, elastic before it slips."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from vjm import checks
from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.frames import Array
from vjm.laws import Response


@dataclass(frozen=True)
class Jenkins:
    """Scalar law: force = stiffness x (strain - slip), its size at most `limit`: a spring in series with a slider.

    G. M. Jenkin, "The resolution of the yielding of metals", 1922; W. D. Iwan, "A distributed-element model for
    hysteresis and its steady-state dynamic response", Journal of Applied Mechanics 33 (1966) 893-900.
    limit: N or N·mm. presliding: strain, mm or rad, at which a relaxed element begins to slip.
    memory: slip, and the work lost so far, N·mm. The force follows the end of the step (backward Euler), which
    is exact while the strain does not turn back within a step. The energy is that of the spring alone.
    ValueError unless both numbers are positive and finite.
    """

    limit: float
    presliding: float

    def __post_init__(self) -> None:
        checks.positive("limit", self.limit)
        checks.positive("presliding", self.presliding)

    @property
    def stiffness(self) -> float:
        """Slope before slip, limit over presliding."""
        return self.limit / self.presliding

    @property
    def initial_memory(self) -> Array:
        return np.zeros(2)

    def respond(self, strain: Array, memory: Array) -> Response:
        slip, lost = memory[..., :1], memory[..., 1:]
        trial = self.stiffness * (strain - slip)
        force = np.clip(trial, -self.limit, self.limit)
        tangent = np.where(np.abs(trial) < self.limit, self.stiffness, 0.0)[..., None]
        new = strain - force / self.stiffness
        remembered = np.concatenate([new, lost + self.limit * np.abs(new - slip)], axis=-1)
        return Response(0.5 * force[..., 0] ** 2 / self.stiffness, force, tangent, remembered)


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
