"""Sizes of effects follow the rig: what is typical on a large stiff linkage is not on a small soft one.

The catalogue states typical sizes and bounds for the bench of the paper: bars of 310 mm with the K_b of its Eq. 12.
Under another rig a length scales with its length l, a compliance along the bars with their axial stiffness, torques and
what is per angle with their bending stiffness, a weight with that over the length. By the units alone, so that another
unit of force or length, or a model to scale, changes no verdict. Angles, ratios, strains and 1/K are pure numbers.

A base that gives counts by what it carries. A linkage of bars on hinges resists it by forces along them, and what is
typical is a tenth of what these give. A single bar resists by bending, a thousand times softer: there a tenth of what
the bar gives in the same direction is as typical.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from vjm import paper
from vjm.effects import shipped
from vjm.effects.base import Effect
from vjm.frames import Array

COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
LENGTH = 310.0
"""mm, of the bench that the catalogue is for."""
ONE = 1e-9
"""A rig within this part of that bench is that bench."""


@dataclass(frozen=True)
class Scale:
    """Of a rig against the bench of the paper. length: of mm. axial: of N/mm along a bar. bending: of N·mm/rad. give:
    of its compliance from base to platform by direction, "x" to "rz", where that is not as its bars' along them."""

    length: float = 1.0
    axial: float = 1.0
    bending: float = 1.0
    give: Mapping[str, float] = field(default_factory=dict)

    @property
    def force(self) -> float:
        """Of N that bend a bar."""
        return self.bending / self.length

    def of(self, unit: str, along: str = "") -> float:
        """Of a number in this unit, 1 where it has none of length or force; along: as in `Parameter`."""
        if along in self.give:
            return self.give[along]
        factors = {
            "mm": self.length,
            "mm/N": 1.0 / self.axial,
            "mm/N^(2/3)": self.length * (self.axial * self.length) ** (-2.0 / 3.0),
            "N": self.force,
            "N/mm": self.force / self.length,
            "N·mm": self.bending,
            "Nmm": self.bending,
            "N·mm/rad": self.bending,
            "rad/(N·mm)": 1.0 / self.bending,
        }
        return factors.get(unit, 1.0)


def scale_of(length: float, stiffness: Array) -> Scale:
    """Of a rig with bars of this length, mm, and K_b (6, 6), N, mm, rad."""
    own, known = (_sizes(k) for k in (stiffness, paper.BAR_STIFFNESS))
    axial, bending = own[0] / known[0], own[1] / known[1]
    length, axial, bending = (
        1.0 if abs(r - 1.0) < ONE else float(r) for r in (length / LENGTH, axial, bending)
    )
    return Scale(length, axial, bending)


def scale_of_bar(length: float, stiffness: Array) -> Scale:
    """Of a single bar of this length, mm, and K_b (6, 6), N, mm, rad."""
    along = 2.0 * paper.BAR_STIFFNESS[0, 0]
    about = along * (paper.WIDTH / 2.0) ** 2
    resisted = np.array([along] * 3 + [about] * 3) / np.diag(stiffness)
    return replace(scale_of(length, stiffness), give=dict(zip(COORDINATES, resisted.tolist(), strict=True)))


def _sizes(stiffness: Array) -> tuple[float, float]:
    return float(stiffness[0, 0]), float(np.sqrt(stiffness[4, 4] * stiffness[5, 5]))


def sized(effect: Effect, scale: Scale) -> Effect:
    """The effect with typical sizes, bounds and probes of a rig; a user's own effect stays as it is."""
    as_it_is = scale == Scale() and effect.parameters == type(effect).parameters
    if as_it_is or not shipped(effect) or not effect.parameters:
        return effect
    return effect.sized_by(scale.of)


def all_sized(effects: Mapping[str, Effect], scale: Scale) -> dict[str, Effect]:
    """Every effect by its name."""
    return {name: sized(effect, scale) for name, effect in effects.items()}
