"""Bars that are not straight before any load."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars
from vjm.link import Link


class BarInitialBow(Effect):
    """Both bars bowed alike as half sines; their hinges stand as in straight bars."""

    name = "bar_initial_bow"
    title = "bars bowed before loading"
    equation = (
        "y0 = bow sin(pi x / L); more deflection bow P / (P_cr - P); axial compliance + bow² L / (2 EI)"
    )
    signature = (
        "axial load bends the bars from the start: sideways force or motion proportional to the axial load, "
        "growing as the load nears the critical one; apparent axial stiffness falls with the square of the bow"
    )
    limits = (
        "half sine, both bars alike; without bar_geometric_nonlinearity only the unloaded compliance sees it"
    )
    source = "W. E. Ayrton, J. Perry, On struts, The Engineer 62 (1886)"
    parameters = (
        Parameter("bow_y_mm", "mm", 0.0, 0.3, -20.0, 20.0, "amplitude along y of the bar frame"),
        Parameter("bow_z_mm", "mm", 0.0, 0.3, -20.0, 20.0, "amplitude along z of the bar frame"),
    )

    def change(self, rig: Rig, values: Values) -> Rig:
        def bowed(link: Link) -> Link:
            bow = (link.bow[0] + values["bow_y_mm"], link.bow[1] + values["bow_z_mm"])
            return replace(link, bow=bow)

        return for_bars(rig, bowed)
