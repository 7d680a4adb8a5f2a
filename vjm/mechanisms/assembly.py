"""What the mechanisms of bars share: the chain of one bar between its two hinges, with all that acts on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vjm.bars import BarModel, X, Y
from vjm.built_leg import Built
from vjm.chain import Fixed, Mark
from vjm.frames import Array, exp
from vjm.gauges import Gauge, gauge
from vjm.laws import Law
from vjm.leg_chain import build
from vjm.link import Link
from vjm.loads import DeadLoads
from vjm.mechanism import Drive, ElasticChain
from vjm.parts import Elastic, Frame, Leg, Part, hinge
from vjm.site_joint import SiteJoint

Alteration = Callable[[int, Link], Link]
"""From the number (0, 1) of a bar and the bar so far to the bar as it is instead."""


@dataclass(frozen=True, eq=False)
class GaugeAt:
    """Place of a displacement gauge: bar 1 or 2, station 0 (base) to 1 (tip), unit direction in the base frame.

    offset: of a gauge on the platform, its point from that of the platform in the nominal pose, mm, base frame; it is
    then seen through the chain of the bar, all of it.
    """

    bar: int
    station: float
    direction: tuple[float, float, float]
    offset: tuple[float, float, float] | None = None


@dataclass(frozen=True, eq=False)
class Assembly:
    """One bar as a chain from the base to the platform.

    link, model: the bar. start: rigid links, and joints of the base body, before its base hinge. end: rigid links after
    its tip hinge.
    hinged: whether there is a hinge at the base and at the tip. angle: nominal rotation of the bar, rad.
    hinges: laws of the turn of the hinges at base and tip from where they stand in the unloaded linkage. settled: turns
    (..., 2) of the hinges from their nominal angles there, at nominal rotations (...); none where they stand as drawn.
    line_load: (3,) N/mm, base frame. overhang: mm of the bar beyond its tip, which carries its own weight only.
    """

    link: Link
    model: BarModel
    start: tuple[Frame | SiteJoint, ...] = ()
    end: tuple[Frame, ...] = ()
    hinged: tuple[bool, bool] = (True, True)
    angle: float = 0.0
    hinges: tuple[tuple[Law, ...], tuple[Law, ...]] = ((), ())
    settled: Callable[[Array], Array] | None = None
    line_load: Array = field(default_factory=lambda: np.zeros(3))
    overhang: float = 0.0

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """From the base to the platform."""
        bar = Elastic(self.link, self.model, self.line_load)
        base, tip = (
            (hinge(Y, *laws),) if there else () for laws, there in zip(self.hinges, self.hinged, strict=True)
        )
        return (*self.start, *base, bar, *tip, *self.end)

    @cached_property
    def _built(self) -> Built:
        return build(Leg("bar", self.parts))

    def chain(self) -> ElasticChain:
        """Coordinates: joints of the base body, base hinge, slides, bar, tip hinge; those that there are."""
        chain = posed(self._built, (self,))
        if not (self.overhang and np.any(self.line_load)):
            return chain
        # What a uniform load does to a rigid piece: its resultant in the middle of it.
        middle = Mark(len(chain.chain.elements), 0.5 * self.overhang * np.array(X))
        force = self.overhang * self.line_load[None, :]
        weight = DeadLoads(chain.chain, np.arange(chain.chain.size), (middle,), force)
        return replace(chain, loads=(*chain.loads, weight))

    def gauge(self, number: int, chain: ElasticChain, place: GaugeAt) -> Gauge:
        """Gauge on the bar, whose chain has this number, or on the platform at its end."""
        if place.offset is not None:
            arm = Fixed(translation=np.asarray(place.offset, dtype=float))
            return gauge(number, (*chain.chain.elements, arm), chain.chain, place.direction)
        (bar,) = self._built.members
        return gauge(number, bar.reach(place.station), chain.chain, place.direction)


def posed(of: Built, bars: tuple[Assembly, ...]) -> ElasticChain:
    """The leg that is built of these bars side by side, or of one, with their nominal angle among its inputs.

    Each hinge is one coordinate of its posture, that at the base before that at the tip, bar after bar.
    """
    first, posture = bars[0], iter(of.posture)
    nominal, hinges = np.zeros(of.rest.size), []
    for bar in bars:
        for sign, there in zip((1.0, -1.0), bar.hinged, strict=True):
            if there:
                own = next(posture)
                nominal += sign * own
                hinges.append(int(np.argmax(own)))

    def turned(change: ArrayLike) -> Array:
        """(..., n) turns of the hinges in the unloaded linkage from as drawn, at departures (...) from the angle."""
        out = np.zeros((*np.shape(change), of.rest.size))
        turns = [bar.settled(bar.angle + np.asarray(change)) for bar in bars if bar.settled is not None]
        if turns:
            out[..., hinges] = np.concatenate(turns, axis=-1)
        return out

    here = turned(0.0)
    drives = [Drive("q", first.angle, nominal, posture=True)] if hinges else []
    if any(bar.settled is not None for bar in bars):
        drives = [replace(drives[0], curve=lambda change: turned(change) - here)]
    return of.set_by(tuple(drives), of.rest + first.angle * nominal + here)


def as_built(nominal: Link, count: int, alterations: tuple[Alteration, ...]) -> tuple[Link, ...]:
    """The bars after all alterations in turn."""
    links = []
    for number in range(count):
        link = nominal
        for alter in alterations:
            link = alter(number, link)
        links.append(link)
    return tuple(links)


def mounted(mount: Array) -> tuple[Frame, ...]:
    """The rotation of the whole linkage against the base frame, of a rotation vector (3,) rad; nothing where there is
    none."""
    return (Frame(rotation=exp(mount)),) if np.any(mount) else ()
