"""The kinematic parallelogram: two bars between four parallel hinges (Eq. 1).

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science (EUCOMES 2010), Springer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import ClassVar

import numpy as np

from vjm import checks
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.link import Link
from vjm.mechanism import ElasticChain
from vjm.mechanisms.assembled import FourBar
from vjm.mechanisms.assembly import Assembly, GaugeAt, as_built, mounted
from vjm.mechanisms.of_bars import OfBars
from vjm.mechanisms.on_base import OnBase
from vjm.parts import Frame
from vjm.site_joint import SiteJoint


@dataclass(frozen=True, eq=False)
class Parallelogram(OfBars):
    """Parallelogram linkage at nominal bar angle q; the platform point lies midway between the outer hinges.

    length, width: L and d, mm. bar_stiffness: K_b (6, 6) of one bar at its tip, base clamped, bar frame.
    q: nominal rotation R_y of the bars, rad; the unloaded platform is at (L cos q, 0, -L sin q). It is the
    default of the input "q". Eq. 1 ends with the constant rotation R_y(q); the rotation vector counts from
    there, so both are left out here. (Printed as R_y(-q_i2), it would let the platform slip: rank 4.)
    wider: mm added to both widths. What else it may have: `vjm.mechanisms.of_bars`.
    ValueError for lengths that are not positive, |q| of 90 degrees or more, a K_b that is not
    symmetric positive definite.
    """

    number_of_bars: ClassVar[int] = 2
    length: float
    width: float
    bar_stiffness: Array
    q: float = 0.0
    wider: float = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.positive("length", self.length)
        checks.positive("width", self.width)
        if not abs(self.q) < np.pi / 2:
            raise ValueError(f"q must lie between -pi/2 and pi/2 rad, got {self.q}")
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
        half, laws = 0.5 * (self.width + self.wider), self.hinge_laws
        sides = (self.links, (-half, half), self._settled, (laws[:2], laws[2:]))
        apart = self._based_apart
        before: tuple[Frame | SiteJoint, ...] = () if apart else (*self.base_joints, *mounted(self.mount))
        return tuple(
            Assembly(
                link,
                self.model,
                start=(*before, Frame(np.array([0.0, 0.0, offset]))),
                end=(Frame(np.array([0.0, 0.0, -offset])),),
                angle=self.q,
                hinges=(laws[0], laws[1]),
                settled=settled,
                line_load=self.line_load,
            )
            for link, offset, settled, laws in zip(*sides, strict=True)
        )
