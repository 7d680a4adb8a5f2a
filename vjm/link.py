"""One bar between its two hinge axes, as drawn or as built, whatever model is made of it."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from vjm.fibres import Fibres
from vjm.frames import Array
from vjm.laws import Law
from vjm.site_joint import SiteJoint


def _rigid() -> Array:
    return np.zeros((6, 6))


@dataclass(frozen=True, eq=False)
class Link:
    """A bar along x from the axis of its base hinge to that of its tip hinge.

    length: mm. stiffness: (6, 6) at the tip, base clamped, of the bar alone and straight. like: (6, 6) of the bar by
    whose segments it bends, which it differs from by little; None where that is its own.
    base_give, tip_give: (6, 6) compliance between a hinge axis and the bar's end there, bar frame.
    bow: amplitudes, mm, of the half sines along y and z of the bar frame that the unloaded bar has; the frames
    of its hinges stay where they are without.
    slides: laws in series of a displacement along the bar at its base hinge.
    base_joints, tip_joints: further axes between a hinge axis and the bar's end there, bar frame, from the hinge on.
    elongation: stress-free lengthening per unit of an input, mm, by the name of the input.
    fibres: of a bar that yields; such a bar is always modelled in segments (`vjm.refined`).
    """

    length: float
    stiffness: Array
    base_give: Array = field(default_factory=_rigid)
    tip_give: Array = field(default_factory=_rigid)
    bow: tuple[float, float] = (0.0, 0.0)
    slides: tuple[Law, ...] = ()
    base_joints: tuple[SiteJoint, ...] = ()
    tip_joints: tuple[SiteJoint, ...] = ()
    elongation: tuple[tuple[str, float], ...] = ()
    fibres: Fibres | None = None
    like: Array | None = None

    def lengthened(self, change: float) -> Link:
        """The bar with `change`, mm, added to its length at the same section: a uniform bar's 6x6 follows it.

        So does what it grows by per unit of an input.
        """
        length = self.length + change
        ratio = self.length / length
        powers = np.sqrt(ratio ** np.array([1.0, 3.0, 3.0, 1.0, 1.0, 1.0]))
        elongation = tuple((name, rate / ratio) for name, rate in self.elongation)
        return replace(self.scaled(powers), length=length, elongation=elongation)

    def stiffened(self, scale: float) -> Link:
        """The bar with its stiffness scaled."""
        return self.scaled(np.full(6, np.sqrt(scale)))

    def scaled(self, roots: Array) -> Link:
        """The bar with its 6x6 multiplied by (6,) from the left and from the right."""
        like = None if self.like is None else roots[:, None] * self.like * roots
        return replace(self, stiffness=roots[:, None] * self.stiffness * roots, like=like)

    def with_little_more(self, compliance: Array) -> Link:
        """The bar with a compliance (6, 6) at its tip more, of either sign, small against its own.

        It bends by the segments of the bar without that: whether what is added is shear or makes the ends stiffer is
        not known, and where it changes its sign nothing jumps.
        """
        whole = np.linalg.inv(self.stiffness) + compliance
        stiffness = np.asarray(np.linalg.inv(0.5 * (whole + whole.T)), dtype=np.float64)
        return replace(self, stiffness=stiffness, like=self.stiffness if self.like is None else self.like)

    @cached_property
    def by_value(self) -> ByValue:
        """The bar as a key, equal to that of every bar of the same shape and stiffness."""
        like = self.stiffness if self.like is None else self.like
        arrays = (self.stiffness, like, self.base_give, self.tip_give)
        return ByValue((self.length, *(each.tobytes() for each in arrays), *self.bow, self.fibres), self)

    @property
    def give(self) -> Array:
        """(6, 6) compliance at the tip of what stands between bar and hinges."""
        lever = np.eye(6)
        lever[1, 5], lever[2, 4] = self.length, -self.length
        return lever @ self.base_give @ lever.T + self.tip_give


@dataclass(frozen=True)
class ByValue:
    """A bar by what its model is made of: all but its slides, its joints and what it grows by. For a cache: fits build
    the same bar a hundred times for one that differs."""

    values: tuple[Hashable, ...]
    link: Link = field(compare=False)
