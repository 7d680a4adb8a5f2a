"""The bars' section is not the nominal one: axial, bending and torsional stiffness are each scaled."""

from __future__ import annotations

import numpy as np

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars

_OF = {"ea": "axial stiffness EA", "eiy": "bending stiffness EI_y", "eiz": "bending stiffness EI_z"}
_TURNS = "torsional stiffness GJ"


def _parameter(name: str, meaning: str) -> Parameter:
    return Parameter(name, "1", 1.0, 0.05, 0.3, 3.0, f"{meaning} of all bars over the nominal one")


class BarSectionError(Effect):
    """K_b of every bar is scaled as the section's four stiffnesses scale it."""

    name = "bar_section_error"
    title = "stiffnesses of the section of all bars scaled, each by its own factor"
    equation = "K_b -> D K_b D, D = diag(√ea, √eiz, √eiy, √gj, √eiy, √eiz)"
    signature = "slopes change by a share of their own in each direction, alike at every angle; no curvature"
    limits = "the same section along the bars and in all of them; a bar's mode of bending stays what it is"
    source = "linear elasticity of a straight beam: no term of its 6x6 has the stiffness of two modes"
    parameters = (*(_parameter(name, meaning) for name, meaning in _OF.items()), _parameter("gj", _TURNS))

    nominal = ("EA", "EIy", "EIz", "GJ")

    def change(self, rig: Rig, values: Values) -> Rig:
        ea, eiy, eiz, gj = (np.sqrt(values[p.name]) for p in self.parameters)
        scales = np.array([ea, eiz, eiy, gj, eiy, eiz])
        return for_bars(rig, lambda link: link.scaled(scales))
