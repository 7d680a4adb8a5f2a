"""Hertz-like contact in each base hinge: soft at small loads, hard at large ones."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from vjm import checks
from vjm.effects.base import Effect, Parameter, Rig, Values, for_bars
from vjm.frames import Array
from vjm.laws import Elastic, Response

LINEAR_BELOW = 1.0
"""N."""


@dataclass(frozen=True)
class Contact(Elastic):
    """Point contact, a scalar law: strain = c sign(F) abs(F)^(2/3), c in mm/N^(2/3); linear below `LINEAR_BELOW`.

    H. Hertz, "Ueber die Berührung fester elastischer Körper", Journal für die reine und angewandte Mathematik 92
    (1882) 156-171. Below a small force the law is its chord through zero, since its slope is infinite there.
    ValueError unless c is positive and finite.
    """

    c: float

    def __post_init__(self) -> None:
        checks.positive("c", self.c)

    def respond(self, strain: Array, memory: Array) -> Response:
        size, linear = np.abs(strain), self.c * LINEAR_BELOW ** (2 / 3)
        near = size < linear
        stiffness = LINEAR_BELOW / linear
        ratio = np.where(near, 1.0, size / self.c)
        force = np.where(near, stiffness * size, ratio**1.5) * np.sign(strain)
        tangent = np.where(near, stiffness, 1.5 * ratio**0.5 / self.c)[..., None]
        start = 0.5 * stiffness * linear**2 - 0.4 * self.c * (linear / self.c) ** 2.5
        energy = np.where(near, 0.5 * stiffness * size**2, start + 0.4 * self.c * ratio**2.5)[..., 0]
        return Response(energy, force, tangent, memory)

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        size = np.abs(force) / LINEAR_BELOW
        linear = self.c * LINEAR_BELOW ** (2 / 3)
        return np.asarray(
            np.sign(force) * linear * np.where(size < 1.0, size, np.maximum(size, 1.0) ** (2 / 3))
        )


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
