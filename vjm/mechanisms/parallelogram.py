"""The kinematic parallelogram: two bars between four parallel hinges (Eq. 1).

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science (EUCOMES 2010), Springer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import get_args

import numpy as np

from vjm import checks
from vjm.bars import BarModel
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.laws import Law
from vjm.link import Link
from vjm.lumped import Lumped, SpringAt
from vjm.mechanism import ElasticChain
from vjm.mechanisms.assembled import FourBar
from vjm.mechanisms.assembly import Alteration, Assembly, GaugeAt, as_built, mounted
from vjm.mechanisms.on_base import OnBase
from vjm.mechanisms.sites import WithPlaces
from vjm.parts import Frame
from vjm.refined import SEGMENTS, Refined
from vjm.sensors import Sensor
from vjm.site_joint import SiteJoint


@dataclass(frozen=True, eq=False)
class Parallelogram(WithPlaces):
    """Parallelogram linkage at nominal bar angle q; the platform point lies midway between the outer hinges.

    length, width: L and d, mm. bar_stiffness: K_b (6, 6) of one bar at its tip, base clamped, bar frame.
    q: nominal rotation R_y of the bars, rad; the unloaded platform is at (L cos q, 0, -L sin q). It is the
    default of the input "q". Eq. 1 ends with the constant rotation R_y(q); the rotation vector counts from
    there, so both are left out here. (Printed as R_y(-q_i2), it would let the platform slip: rank 4.)
    spring_at: where along the bar K_b is lumped. Eq. 1 says the tip. The unloaded stiffness does not depend
    on it, the critical loads do (`vjm.closed_forms`).
    bar: another model of the bars than K_b lumped at that place, such as `vjm.refined.Refined`.
    hinges: laws of the turn of each of the four hinges, none in a perfect one. They are relaxed where the linkage
    stands without load (`vjm.mechanisms.assembled`): at the nominal angle, but for bars of different lengths.
    single_hinges: further laws of each hinge by itself, at base and tip of bar 1, then of bar 2; or none.
    alterations: what the bars are instead of what is drawn, applied in turn. wider: mm added to both widths.
    mount: (3,) rotation vector, rad, of the whole linkage against the base frame. base_joints: between ground and base
    body, at the base origin along and about the axes of the base frame. line_load: (3,) N/mm along
    the bars, base frame. gravity: (3,) unit vector of weights given without a direction. sensors, gauge_at:
    what is read (`vjm.sensors`, `vjm.gauges`). fibre_y, fibre_z: outermost fibres of the bars, mm, where known.
    polar_radius: radius of gyration of the section by which an axial force stiffens the twist of refined bars, mm.
    ValueError for lengths that are not positive, |q| of 90 degrees or more, a K_b that is not
    symmetric positive definite.
    """

    length: float
    width: float
    bar_stiffness: Array
    q: float = 0.0
    spring_at: SpringAt = "tip"
    bar: BarModel | None = None
    hinges: tuple[Law, ...] = ()
    single_hinges: tuple[tuple[Law, ...], ...] = ()
    alterations: tuple[Alteration, ...] = ()
    wider: float = 0.0
    mount: Array = field(default_factory=lambda: np.zeros(3))
    base_joints: tuple[SiteJoint, ...] = ()
    line_load: Array = field(default_factory=lambda: np.zeros(3))
    gravity: Array = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))
    sensors: tuple[Sensor, ...] = ()
    gauge_at: tuple[GaugeAt, ...] = ()
    fibre_y: float | None = None
    fibre_z: float | None = None
    polar_radius: float = 0.0

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        checks.positive("width", self.width)
        if not abs(self.q) < np.pi / 2:
            raise ValueError(f"q must lie between -pi/2 and pi/2 rad, got {self.q}")
        if self.spring_at not in get_args(SpringAt):
            raise ValueError(f"spring_at must be one of {get_args(SpringAt)}, got {self.spring_at!r}")
        if wrong := [place.bar for place in self.gauge_at if place.bar not in (1, 2)]:
            raise ValueError(f"bar must be 1 or 2, got {wrong[0]}")
        object.__setattr__(
            self, "bar_stiffness", checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        )

    @cached_property
    def links(self) -> tuple[Link, ...]:
        """Bar 1 and bar 2 as built."""
        return as_built(Link(self.length, self.bar_stiffness), 2, self.alterations)

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """Chain 1 starts at z = -d/2, chain 2 at +d/2; coordinates q_i1, theta_i1..6, q_i2. One of both bars where laws
        hold the base body."""
        if self._based is not None:
            return (self._based.chain(),)
        return tuple(assembly.chain() for assembly in self._assemblies)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) nominal, base frame."""
        return np.array([self.length * np.cos(self.q), 0.0, -self.length * np.sin(self.q), 0.0, 0.0, 0.0])

    @cached_property
    def gauges(self) -> tuple[Gauge, ...]:
        """Those of `gauge_at`."""
        return tuple(self._gauge(place) for place in self.gauge_at)

    def gauge(self, bar: int, station: float, direction: tuple[float, float, float]) -> Gauge:
        """Displacement of the axis of bar 1 or 2 at `station` (0 base, 1 tip) along a base-frame direction."""
        place = GaugeAt(bar, station, direction)
        return replace(self, gauge_at=(place,))._gauge(place)

    @property
    def hinged(self) -> tuple[bool, bool]:
        """Whether bars have hinges at base and tip."""
        return (True, True)

    @property
    def hinge_laws(self) -> tuple[tuple[Law, ...], ...]:
        """Laws of each hinge: those of `single_hinges`, then those that all have; base and tip of each bar in turn."""
        own = self.single_hinges or ((),) * 4
        return tuple((*laws, *self.hinges) for laws in own)

    def altered(self, *alterations: Alteration) -> Parallelogram:
        """The linkage with further alterations of its bars."""
        return replace(self, alterations=(*self.alterations, *alterations))

    def refined(self, segments: int = SEGMENTS) -> Parallelogram:
        """The linkage with both bars refined into segments."""
        return replace(self, bar=Refined(segments, self.polar_radius))

    def _gauge(self, place: GaugeAt) -> Gauge:
        if self._based is not None:
            return self._based.gauge(self.chains[0], place)
        return self._assemblies[place.bar - 1].gauge(place.bar - 1, self.chains[place.bar - 1], place)

    @property
    def _settled(self) -> tuple[Callable[[Array], Array] | None, ...]:
        """Of each bar, how far its hinges are turned in the unloaded linkage."""
        first, second = (link.length for link in self.links)
        if first == second:
            return None, None
        loop = FourBar((first, second), self.width + self.wider)
        return partial(loop.hinges, 0), partial(loop.hinges, 1)

    @property
    def _based_apart(self) -> bool:
        """Whether the base body moves by laws, and so is one for both bars."""
        return any(joint.law is not None or joint.apart for joint in self.base_joints)

    @cached_property
    def _based(self) -> OnBase | None:
        if not self._based_apart:
            return None
        return OnBase(self.base_joints, mounted(self.mount), self._assemblies)

    @cached_property
    def _assemblies(self) -> tuple[Assembly, ...]:
        model = Lumped(self.spring_at, self.polar_radius) if self.bar is None else self.bar
        half, laws = 0.5 * (self.width + self.wider), self.hinge_laws
        sides = (self.links, (-half, half), self._settled, (laws[:2], laws[2:]))
        apart = self._based_apart
        before: tuple[Frame | SiteJoint, ...] = () if apart else (*self.base_joints, *mounted(self.mount))
        return tuple(
            Assembly(
                link,
                model,
                start=(*before, Frame(np.array([0.0, 0.0, offset]))),
                end=(Frame(np.array([0.0, 0.0, -offset])),),
                angle=self.q,
                hinges=(laws[0], laws[1]),
                settled=settled,
                line_load=self.line_load,
            )
            for link, offset, settled, laws in zip(*sides, strict=True)
        )
