"""The hinge axes give, radially and in tilt."""

from __future__ import annotations

import numpy as np

from vjm.effects.base import Effect, Parameter, Rig, Values, adding, for_bars


class AxisFlexibility(Effect):
    """A compliance between each hinge axis and the end of its bar, the same at all four."""

    name = "axis_flexibility"
    parts = "hinges"
    title = "hinge axes give"
    equation = "K_b^-1 -> K_b^-1 + C at the base + C at the tip, C = diag(r, 0, r, t, 0, t)"
    signature = "softer along the bars at any angle (radial); softer sideways and in rx, rz (tilt); linear"
    limits = (
        "linear; the same at all hinges; hardly to be told from a soft base (correlation 0.996); refined bars "
        "take it into their end segments: 0.2 µm of x at 1e-7 rad/(N·mm) and 5 mm of y"
    )
    source = "springs in series; Table 1 of the paper has such axes without their stiffness"
    parameters = (
        Parameter("radial_mm_per_N", "mm/N", 0.0, 2e-6, 0.0, 1e-3, "give of one hinge across its axis"),
        Parameter("tilt_rad_per_Nmm", "rad/(N·mm)", 0.0, 1e-7, 0.0, 1e-4, "tilt of one hinge's axis"),
    )
    kinds = ("parallelogram",)

    def change(self, rig: Rig, values: Values) -> Rig:
        radial, tilt = values["radial_mm_per_N"], values["tilt_rad_per_Nmm"]
        give = np.diag([radial, 0.0, radial, tilt, 0.0, tilt])
        return for_bars(rig, lambda link: adding(link, base_give=give, tip_give=give))
