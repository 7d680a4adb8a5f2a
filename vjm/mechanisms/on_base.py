"""A linkage whose base body stands on joints that laws hold: one leg, that body and the bars side by side on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.built_leg import Built
from vjm.chain import Fixed
from vjm.gauges import Gauge, gauge
from vjm.leg_chain import build
from vjm.mechanism import ElasticChain
from vjm.mechanisms.assembly import Assembly, GaugeAt, posed
from vjm.parts import Fork, Frame, Leg, Part
from vjm.site_joint import SiteJoint


@dataclass(frozen=True, eq=False)
class OnBase:
    """joints: between ground and base body, base frame, the first at the ground. mount: from there to the linkage.
    bars: each from the base body to the platform."""

    joints: tuple[SiteJoint, ...]
    mount: tuple[Frame, ...]
    bars: tuple[Assembly, ...]

    @cached_property
    def _built(self) -> Built:
        branches = tuple(bar.parts for bar in self.bars)
        rest: tuple[Part, ...] = (Fork(branches),) if len(branches) > 1 else branches[0]
        return build(Leg("linkage", (*self.joints, *self.mount, *rest)))

    def chain(self) -> ElasticChain:
        """Coordinates: joints of the base body, then those of the bars."""
        return posed(self._built, self.bars)

    def gauge(self, chain: ElasticChain, place: GaugeAt) -> Gauge:
        """Gauge on a bar or on the platform; chain: what `chain` makes."""
        if place.offset is not None:
            arm = Fixed(translation=np.asarray(place.offset, dtype=float))
            return gauge(0, (*chain.chain.elements, arm), chain.chain, place.direction)
        return self._built.members[place.bar - 1].gauge(0, place.station, place.direction)
