"""Every hinge springs back: flexure hinges, seals, preloaded bearings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.laws import Linear


class JointTorsionalStiffness(Effect):
    """A linear spring about each hinge axis, relaxed in the unloaded linkage."""

    name = "joint_torsional_stiffness"
    title = "hinges spring back"
    equation = "M = -k (angle - unloaded angle) in each hinge; along z 4 k / (L cos q)² with ry held"
    signature = "the free direction z carries a force proportional to the displacement; no loop"
    limits = "linear; all four hinges alike, relaxed where the test begins"
    source = "L. L. Howell, Compliant Mechanisms, Wiley 2001, chapter 5"
    parameters = (Parameter("stiffness_Nmm_per_rad", "N·mm/rad", 0.0, 2e3, 0.0, 1e6, "spring of one hinge"),)
    hinge = "any"

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, hinges=(*rig.hinges, Linear(np.array([[values["stiffness_Nmm_per_rad"]]]))))
