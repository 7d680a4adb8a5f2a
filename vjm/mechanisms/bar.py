"""One elastic bar along x: the virtual joint model of a link (Salisbury 1980, as used in Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, Literal, get_args

import numpy as np

from vjm import checks
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.link import Link
from vjm.mechanism import ElasticChain
from vjm.mechanisms.assembly import Assembly, GaugeAt, as_built, mounted
from vjm.mechanisms.of_bars import OfBars

Base = Literal["clamped", "pinned"]
Tip = Literal["free", "pinned", "guided"]
HELD: dict[Tip, tuple[str, ...]] = {
    "free": (),
    "pinned": ("y", "z", "rx", "ry", "rz"),
    "guided": ("rx", "ry", "rz"),
}
"""Platform coordinates that each kind of tip holds."""


@dataclass(frozen=True, eq=False)
class Bar(OfBars):
    """A bar whose base is clamped, or pinned about y; the platform point is its tip.

    length: mm. bar_stiffness: (6, 6) at the tip, base clamped. Base frame and bar frame coincide.
    tip: "free" carries nothing; "guided" shifts but does not turn; "pinned" has a hinge about y to a block,
    the platform, that slides along x only. `held` names the coordinates that this holds.
    overhang: mm that the bar goes on beyond the platform point, as a rigid piece that carries its own weight only: the
    sag of this piece itself is not part of the model. `vjm.sensors.ReadAt` reads its end.
    ValueError for a length that is not positive, a stiffness that is not symmetric positive definite or a
    support that is none of those named.
    """

    number_of_bars: ClassVar[int] = 1
    length: float
    bar_stiffness: Array
    base: Base = "clamped"
    tip: Tip = field(default="free", kw_only=True)
    overhang: float = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.positive("length", self.length)
        if self.base not in get_args(Base):
            raise ValueError(f"base must be one of {get_args(Base)}, got {self.base!r}")
        if self.tip not in get_args(Tip):
            raise ValueError(f"tip must be one of {get_args(Tip)}, got {self.tip!r}")
        object.__setattr__(
            self, "bar_stiffness", checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        )

    @cached_property
    def links(self) -> tuple[Link, ...]:
        """The bar as built."""
        return as_built(Link(self.length, self.bar_stiffness), 1, self.alterations)

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One chain: the bar between the hinges it has."""
        return (self._assembly.chain(),)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) nominal, base frame."""
        return np.array([self.length, 0.0, 0.0, 0.0, 0.0, 0.0])

    @property
    def held(self) -> tuple[str, ...]:
        """Platform coordinates that the tip's support holds at their unloaded values."""
        return HELD[self.tip]

    @cached_property
    def gauges(self) -> tuple[Gauge, ...]:
        """Those of `gauge_at`."""
        return tuple(self._assembly.gauge(0, self.chains[0], place) for place in self.gauge_at)

    def gauge(self, station: float, direction: tuple[float, float, float]) -> Gauge:
        """Displacement of the bar's axis at `station` (0 base, 1 tip) along a base-frame direction."""
        return self._assembly.gauge(0, self.chains[0], GaugeAt(1, station, direction))

    @property
    def hinged(self) -> tuple[bool, bool]:
        """Whether bars have hinges at base and tip."""
        return (self.base == "pinned", self.tip == "pinned")

    @cached_property
    def _assembly(self) -> Assembly:
        return Assembly(
            self.links[0],
            self.model,
            start=(*self.base_joints, *mounted(self.mount)),
            hinged=self.hinged,
            hinges=(self.hinge_laws[0], self.hinge_laws[1]),
            line_load=self.line_load,
            overhang=self.overhang,
        )
