"""Axial force changes bending stiffness, bending shortens the bar, large deflection, buckling."""

from __future__ import annotations

from vjm.effects.base import Effect, Rig, Values


class BarGeometricNonlinearity(Effect):
    """Bars of several segments with frames of their own in place of one lumped 6x6; see `vjm.refined`."""

    name = "bar_geometric_nonlinearity"
    title = "geometric nonlinearity of the bars"
    equation = "K_b -> K_b + P K_g, x shortens by 0.6 y²/L when guided, P_cr = pi² EI / (effective length)²"
    signature = (
        "x or fx curves with the square of y; lateral stiffness falls in compression and rises in tension; "
        "runs away near a critical load"
    )
    limits = "slender bars, small strain; discretised in segments, see vjm.refined for how good"
    source = "S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed. 1961, chapters 1 and 2"

    def change(self, rig: Rig, values: Values) -> Rig:
        return rig.refined()
