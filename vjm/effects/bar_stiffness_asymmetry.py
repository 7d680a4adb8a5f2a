"""The two bars are not equally stiff."""

from __future__ import annotations

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars


class BarStiffnessAsymmetry(Effect):
    """K_b of bar 2 is scaled, that of bar 1 is not."""

    name = "bar_stiffness_asymmetry"
    title = "bar 2 stiffer or softer than bar 1"
    equation = "K_b of bar 2 -> ratio K_b"
    signature = (
        "loads along x turn the platform (ry), loads along y turn it about x; grows linearly with load"
    )
    limits = "one factor for all entries of bar 2"
    source = "two springs in parallel of different stiffness: a central force does not act at their centre"
    parameters = (Parameter("ratio", "1", 1.0, 0.1, 0.2, 5.0, "stiffness of bar 2 over that of bar 1"),)
    kinds = ("parallelogram",)

    def change(self, rig: Rig, values: Values) -> Rig:
        return for_bars(rig, lambda link: link.stiffened(values["ratio"]), only=1)
