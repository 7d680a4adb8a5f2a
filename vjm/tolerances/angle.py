"""The nominal angle of the bars as it was set up."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np

from vjm.effects.base import Parameter, Rig, Values
from vjm.tolerances.base import Tolerance

POSTURE, MOUNT = "posture", "mount"


class Angle(Tolerance):
    """The unloaded bars stand a little beside their nominal angle, in all tests alike.

    Either the linkage was swung there and its displacements count from there: that is no property of a mechanism but
    of the tests, and who predicts them turns their postures by it. Or it was mounted so, base and platform with it, and
    its displacements count from the nominal pose.
    """

    name = "angle"
    title = "angle of the unloaded bars as it was set up"
    equation = "q -> q + posture, the pose from which displacements count with it; p -> R_y(mount) p"
    signature = "forces along the bars appear across them, in proportion; of the mount a constant pose too"
    limits = "the same error in all tests; a rig without an angle has none"
    source = "geometry"
    parameters = (
        Parameter(POSTURE, "mrad", 0.0, 0.5, -100.0, 100.0, "angle of the bars beside the nominal one"),
        Parameter(MOUNT, "mrad", 0.0, 0.5, -100.0, 100.0, "angle of the whole linkage about y"),
    )
    kinds = ("parallelogram",)
    keys: ClassVar = {POSTURE: "q_mrad", MOUNT: "q_mrad"}
    deviations: ClassVar = {"q_mrad": 0.5}

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, mount=rig.mount + np.array([0.0, 1e-3 * values[MOUNT], 0.0]))
