"""Hertz-like contact in each base hinge: soft at small loads, hard at large ones."""

from __future__ import annotations

from dataclasses import replace

from vjm.contact import Contact
from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars


class ContactStiffening(Effect):
    """A slide along the bar in each base hinge that follows the power 2/3 of the force."""

    name = "contact_stiffening"
    title = "contact in the base hinges stiffens"
    equation = "delta = c sign(F) abs(F)^(2/3)"
    signature = "steep about zero load, ever stiffer with load of either sign; no loop"
    limits = "point contact; linear below the force of 1 N; hardly to be told from soft axes if small"
    source = "H. Hertz, Journal für die reine und angewandte Mathematik 92 (1882) 156-171"
    parameters = (Parameter("c_mm_per_N23", "mm/N^(2/3)", 0.0, 5e-5, 0.0, 1e-2, "give of one hinge at 1 N"),)
    hinge = "base"

    def change(self, rig: Rig, values: Values) -> Rig:
        contact = Contact(values["c_mm_per_N23"])
        return for_bars(rig, lambda link: replace(link, slides=(*link.slides, contact)))
