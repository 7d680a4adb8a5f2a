"""Bars grow with temperature above the reference."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars

DRIVE = "temperature_rise_K"
"""Name of the input of every mechanism whose bars grow with temperature."""


class ThermalExpansion(Effect):
    """A stress-free lengthening of all bars; base and platform keep their width."""

    name = "thermal_expansion"
    title = "bars grow with temperature"
    equation = "L -> L (1 + alpha (T - T_ref))"
    signature = (
        "x or fx follows the temperature, whatever the load; at a constant temperature it is a length error"
    )
    limits = (
        "one temperature for both bars; the width does not grow, and bars keep the 6x6 of their reference length "
        "(at 15 K above it, aluminium: forces good to 0.04 % along, 0.1 % across); needs a measured temperature"
    )
    source = "the definition of the coefficient of linear expansion"
    parameters = (
        Parameter("alpha_per_K", "1/K", 0.0, 2.3e-5, -1e-4, 2e-4, "coefficient of expansion of the bars"),
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        alpha = values["alpha_per_K"]
        return for_bars(
            rig, lambda link: replace(link, elongation=(*link.elongation, (DRIVE, alpha * link.length)))
        )
