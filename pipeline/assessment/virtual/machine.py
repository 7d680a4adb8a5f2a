"""A whole manipulator with errors, at rest, by frame finite elements: where its platform goes under small loads.

Every error is that of `fem.frame.errors`, done to beams, joints and readings here; none of the effects of the virtual
springs is used, so that a wrong sign in one of the two shows as a difference.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from fem.frame.errors import Errors
from fem.frame.so3 import exp, hat, log
from pipeline.manipulator.frame import frame_stiffness
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures

Array = NDArray[np.float64]
OF_LINKAGES = (
    "modulus_error",
    "bar_stiffness_asymmetry",
    "axis_flexibility",
    "joint_torsional_stiffness",
    "dimension_error",
)
"""Errors of the bars and hinges of parallelograms."""
OF_LEGS = ("actuator_compliance", "link_compliance")
"""Errors of other parts of the legs."""
AROUND = ("base_compliance", "mounting_tilt", "load_misalignment", "load_offset", "self_weight")
"""Errors of what stands around any manipulator."""
NOT_AT_REST = (
    "dimension_error.length_mm",
    *(f"self_weight.line_{axis}_N_per_mm" for axis in "xyz"),
)


def refused(errors: Errors, linkages: bool) -> str:
    """Why frame elements at rest cannot have these errors; empty where they can. linkages: whether there are any."""
    null = Errors()
    given = [f.name for f in fields(errors) if getattr(errors, f.name) != getattr(null, f.name)]
    for name in given:
        if name not in OF_LINKAGES + OF_LEGS + AROUND:
            return f"{name} does not show in finite elements at rest"
        if name in OF_LINKAGES and not linkages:
            return f"{name} needs a parallelogram"
    none = null.values()
    for path in NOT_AT_REST:
        if errors.values()[path] != none[path]:
            return f"{path} does not show in finite elements at rest"
    return ""


@dataclass(frozen=True, eq=False)
class Machine:
    """A manipulator with errors at one posture, unloaded, as drawn."""

    manipulator: Manipulator
    errors: Errors
    at: Postures

    def displacements(self, read: Array, weight: Array) -> Array:
        """(S, 6) of the platform from the nominal pose under loads of which the cell reads `read` (S, 6); N, N·mm.

        weight: (3,) known dead force on the platform, which the cell does not read. ValueError for what the frame at
        rest does not have.
        """
        turn = exp(self._vector("mounting_tilt", "rad"))
        own = self.errors.self_weight
        loads = np.linalg.solve(self._cell, read.T).T
        loads[:, :3] += weight + np.array([own.fx_N, own.fy_N, own.fz_N])
        moved = loads @ self._compliance(turn).T
        drawn = self.at.pose[:3]
        place = turn @ drawn + moved[:, :3]
        turned = exp(moved[:, 3:]) @ turn
        return np.concatenate([place - drawn, log(turned)], axis=-1)

    def _compliance(self, turn: Array) -> Array:
        """(6, 6) at the platform point as mounted: the frame's own, and its base on springs at the base origin."""
        stiffness = frame_stiffness(self.manipulator, self.at.pose, self.at.coordinates, errors=self.errors)
        both = np.kron(np.eye(2), turn)
        lever = np.eye(6)
        lever[:3, 3:] = -hat(turn @ self.at.pose[:3])
        springs = self.errors.base_compliance
        base = np.diag([getattr(springs, f.name) for f in fields(springs)])
        return np.asarray(both @ np.linalg.inv(stiffness) @ both.T + lever @ base @ lever.T)

    @property
    def _cell(self) -> Array:
        """(6, 6) from the wrench on the platform to what the cell reads: its place, then its turn."""
        offset, turn = np.eye(6), np.kron(np.eye(2), exp(self._vector("load_misalignment", "rad")).T)
        offset[3:, :3] = -hat(self._vector("load_offset", "mm"))
        return np.asarray(turn @ offset)

    def _vector(self, name: str, unit: str) -> Array:
        record, first = getattr(self.errors, name), "r" if unit == "rad" else ""
        return np.array([getattr(record, f"{first}{axis}_{unit}") for axis in "xyz"])
