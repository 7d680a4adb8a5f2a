"""One elastic bar along x: the virtual joint model of a link (Salisbury 1980, as used in Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from vjm import checks
from vjm.bars import BarModel
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.laws import Law
from vjm.link import Link
from vjm.lumped import Lumped, SpringAt
from vjm.mechanism import ElasticChain
from vjm.mechanisms.assembly import Alteration, Assembly, GaugeAt, as_built, mounted
from vjm.mechanisms.sites import WithPlaces
from vjm.refined import SEGMENTS, Refined
from vjm.sensors import Sensor
from vjm.site_joint import SiteJoint

Base = Literal["clamped", "pinned"]
Tip = Literal["free", "pinned", "guided"]
HELD: dict[Tip, tuple[str, ...]] = {
    "free": (),
    "pinned": ("y", "z", "rx", "ry", "rz"),
    "guided": ("rx", "ry", "rz"),
}
"""Platform coordinates that each kind of tip holds."""


@dataclass(frozen=True, eq=False)
class Bar(WithPlaces):
    """A bar whose base is clamped, or pinned about y; the platform point is its tip.

    length: mm. bar_stiffness: (6, 6) at the tip, base clamped. Base frame and bar frame coincide.
    tip: "free" carries nothing; "guided" shifts but does not turn; "pinned" has a hinge about y to a block,
    the platform, that slides along x only. `held` names the coordinates that this holds.
    bar: another model of the bar than the 6x6 lumped at `spring_at`, such as `vjm.refined.Refined`.
    overhang: mm that the bar goes on beyond the platform point, as a rigid piece that carries its own weight only: the
    sag of this piece itself is not part of the model. `vjm.sensors.ReadAt` reads its end.
    hinges, single_hinges, alterations, mount, base_joints, line_load, gravity, sensors, gauge_at, fibre_y, fibre_z,
    polar_radius: as in `vjm.mechanisms.parallelogram`.
    ValueError for a length that is not positive, a stiffness that is not symmetric positive definite or a
    support that is none of those named.
    """

    length: float
    bar_stiffness: Array
    base: Base = "clamped"
    spring_at: SpringAt = "tip"
    tip: Tip = "free"
    bar: BarModel | None = None
    hinges: tuple[Law, ...] = ()
    single_hinges: tuple[tuple[Law, ...], ...] = ()
    alterations: tuple[Alteration, ...] = ()
    mount: Array = field(default_factory=lambda: np.zeros(3))
    base_joints: tuple[SiteJoint, ...] = ()
    line_load: Array = field(default_factory=lambda: np.zeros(3))
    gravity: Array = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))
    sensors: tuple[Sensor, ...] = ()
    gauge_at: tuple[GaugeAt, ...] = ()
    fibre_y: float | None = None
    fibre_z: float | None = None
    polar_radius: float = 0.0
    overhang: float = 0.0

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

    @property
    def hinge_laws(self) -> tuple[tuple[Law, ...], ...]:
        """Laws of each hinge: those of `single_hinges`, then those that all have; base and tip of each bar in turn."""
        own = self.single_hinges or ((),) * 2
        return tuple((*laws, *self.hinges) for laws in own)

    def altered(self, *alterations: Alteration) -> Bar:
        """The mechanism with further alterations of its bar."""
        return replace(self, alterations=(*self.alterations, *alterations))

    def refined(self, segments: int = SEGMENTS) -> Bar:
        """The mechanism with its bar refined into segments."""
        return replace(self, bar=Refined(segments, self.polar_radius))

    @cached_property
    def _assembly(self) -> Assembly:
        model = Lumped(self.spring_at, self.polar_radius) if self.bar is None else self.bar
        return Assembly(
            self.links[0],
            model,
            start=(*self.base_joints, *mounted(self.mount)),
            hinged=self.hinged,
            hinges=(self.hinge_laws[0], self.hinge_laws[1]),
            line_load=self.line_load,
            overhang=self.overhang,
        )
