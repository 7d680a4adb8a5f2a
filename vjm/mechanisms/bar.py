"""One elastic bar along x: the virtual joint model of a link (Salisbury 1980, as used in Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from vjm import checks
from vjm.bars import BarModel, Lumped, SpringAt
from vjm.chain import Chain, Element, Joint, Role
from vjm.frames import Array
from vjm.gauges import Gauge, gauge
from vjm.mechanism import ElasticChain

Base = Literal["clamped", "pinned"]
Tip = Literal["free", "pinned", "guided"]
HELD: dict[Tip, tuple[str, ...]] = {
    "free": (),
    "pinned": ("y", "z", "rx", "ry", "rz"),
    "guided": ("rx", "ry", "rz"),
}
"""Platform coordinates that each kind of tip holds."""

_HINGE = Joint("rotation", (0.0, 1.0, 0.0), Role.PASSIVE)


@dataclass(frozen=True, eq=False)
class Bar:
    """A bar whose base is clamped, or pinned about y; the platform point is its tip.

    length: mm. bar_stiffness: (6, 6) at the tip, base clamped. Base frame and bar frame coincide.
    tip: "free" carries nothing; "guided" shifts but does not turn; "pinned" has a hinge about y to a block,
    the platform, that slides along x only. `held` names the coordinates that this holds.
    bar: another model of the bar than the 6x6 lumped at `spring_at`, such as `vjm.refined.Refined`.
    ValueError for a length that is not positive, a stiffness that is not symmetric positive definite or a
    support that is none of those named.
    """

    length: float
    bar_stiffness: Array
    base: Base = "clamped"
    spring_at: SpringAt = "tip"
    tip: Tip = "free"
    bar: BarModel | None = None

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        if self.base not in get_args(Base):
            raise ValueError(f"base must be one of {get_args(Base)}, got {self.base!r}")
        if self.tip not in get_args(Tip):
            raise ValueError(f"tip must be one of {get_args(Tip)}, got {self.tip!r}")
        object.__setattr__(
            self, "bar_stiffness", checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        )

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One chain: the bar between the hinges it has."""
        limb = self._model.limb(self.length, self.bar_stiffness)
        tip = (_HINGE,) if self.tip == "pinned" else ()
        chain = Chain((*self._start, *limb.elements, *tip))
        springs = limb.numbered_from(len(self._start))
        return (ElasticChain(chain, limb.stiffness, np.zeros(chain.size), springs),)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) base frame."""
        return np.array([self.length, 0.0, 0.0, 0.0, 0.0, 0.0])

    @property
    def held(self) -> tuple[str, ...]:
        """Platform coordinates that the tip's support holds at their unloaded values."""
        return HELD[self.tip]

    def gauge(self, station: float, direction: tuple[float, float, float]) -> Gauge:
        """Displacement of the bar's axis at `station` (0 base, 1 tip) along a base-frame direction."""
        reach = self._model.reach(self.length, self.bar_stiffness, station)
        return gauge(0, (*self._start, *reach), self.chains[0], direction)

    @property
    def _model(self) -> BarModel:
        return Lumped(self.spring_at) if self.bar is None else self.bar

    @property
    def _start(self) -> tuple[Element, ...]:
        return (_HINGE,) if self.base == "pinned" else ()
