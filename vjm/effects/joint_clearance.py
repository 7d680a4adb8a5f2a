"""Play along the bar in each base hinge."""

from __future__ import annotations

from dataclasses import replace

from vjm.clearance import Clearance
from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars


class JointClearance(Effect):
    """A slide along the bar that is free within ± play and hard beyond."""

    name = "joint_clearance"
    title = "play in the base hinges"
    equation = "F = 20 N/mm x u for abs(u) < play, then the stop"
    signature = "a dead band about zero in the axial direction; beyond it the slope of the tight linkage"
    limits = (
        "a centring spring of 20 N/mm inside; under loads of one sign it looks like an offset of x; where the axial "
        "load is within its noise a row may lie on either side of the play, and is taken to lie on the better one: "
        "below one sigma of the displacement sensor such choices look like play, so its interval begins at null "
        "unless the data say more than they could"
    )
    source = (
        "the dead-zone law, as in F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996"
    )
    parameters = (
        Parameter("play_mm", "mm", 0.0, 0.01, 0.0, 2.0, "half of the free travel of one base hinge"),
    )
    hinge = "base"
    smooth = False
    probes = (0.003, 0.01, 0.03)

    def change(self, rig: Rig, values: Values) -> Rig:
        play = Clearance(values["play_mm"])
        return for_bars(rig, lambda link: replace(link, slides=(*link.slides, play)))
