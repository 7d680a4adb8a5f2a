"""Both bars are stiffer or softer than their 6x6 says: modulus, section, or the identification itself."""

from __future__ import annotations

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars


class ModulusError(Effect):
    """K_b of every bar is scaled."""

    name = "modulus_error"
    title = "stiffness of all bars scaled"
    equation = "K_b -> scale K_b"
    signature = "all slopes change by the same share, in every direction and at every angle; no curvature"
    limits = "one factor for all entries"
    source = "linear elasticity: stiffness is proportional to the modulus"
    parameters = (Parameter("scale", "1", 1.0, 0.05, 0.3, 3.0, "stiffness of all bars over the nominal one"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        return for_bars(rig, lambda link: link.stiffened(values["scale"]))
