"""Bars soften for good past a strain in their outer fibres."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars
from vjm.fibres import Fibres
from vjm.refined import radii_of_gyration


class MaterialYield(Effect):
    """Fibres that yield, all bars alike; lumped bars become refined ones, since a lumped one has no strains."""

    name = "material_yield"
    title = "bars yield"
    equation = "stress = E (eps - eps_p), |stress - back stress| <= E strain, tangent E / 100 while it yields"
    signature = (
        "deflection grows faster than the load past a limit, most in bending; unloading is elastic and "
        "leaves a set; a loop that does not close"
    )
    limits = (
        "section known by EA, EI and outermost fibres only; shear and twist stay elastic; at the null of 2 % "
        "no bar of a bench yields"
    )
    source = (
        "W. Prager, P. G. Hodge, Theory of Perfectly Plastic Solids, Wiley 1951, chapter 2; hardening as in "
        "J. C. Simo, T. J. R. Hughes, Computational Inelasticity, Springer 1998, section 1.4"
    )
    parameters = (Parameter("strain", "1", 0.02, -0.017, 1e-4, 0.02, "strain at which a fibre yields"),)
    smooth = False
    probes = (0.004, 0.002, 0.001)
    history = True
    # Where fibres yield is found along a refined bar, which has its geometric stiffness.
    includes = ("bar_geometric_nonlinearity",)

    def refusal(self, rig: Rig) -> str:
        """Where the rig's fibres lie within its radii of gyration."""
        fibres = self._fibres(rig, self.typicals)
        every = (fibres.inside(*radii_of_gyration(link.length, link.stiffness)) for link in rig.links)
        return next((said for said in every if said), "")

    def change(self, rig: Rig, values: Values) -> Rig:
        """ValueError where the rig's fibres are not known."""
        fibres = self._fibres(rig, values)
        return for_bars(rig, lambda link: replace(link, fibres=fibres))

    def _fibres(self, rig: Rig, values: Values) -> Fibres:
        if rig.fibre_y is None or rig.fibre_z is None:
            raise ValueError(f"{self.name} needs the rig's outermost fibres, fibre_y and fibre_z in mm")
        return Fibres(rig.fibre_y, rig.fibre_z, values["strain"])
