"""What the mechanisms of bars share: the chain of one bar between its two hinges, with all that acts on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from vjm.bars import BarModel, X
from vjm.chain import Chain, Element, Fixed, Joint, Mark, Role
from vjm.frames import Array, exp
from vjm.gauges import Gauge, gauge
from vjm.laws import Law, Spring
from vjm.link import Link
from vjm.loads import DeadLoads
from vjm.mechanism import Drive, ElasticChain

Alteration = Callable[[int, Link], Link]
"""From the number (0, 1) of a bar and the bar so far to the bar as it is instead."""

HINGE = Joint("rotation", (0.0, 1.0, 0.0), Role.PASSIVE)


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

    link, model: the bar. start: elements before its base hinge, end: after its tip hinge.
    hinged: whether there is a hinge at the base and at the tip. angle: nominal rotation of the bar, rad.
    hinges: laws of the turn of each hinge from where it stands in the unloaded linkage. settled: turns (..., 2) of the
    hinges at base and tip from their nominal angles there, at nominal rotations (...); none where they stand as drawn.
    line_load: (3,) N/mm, base frame.
    """

    link: Link
    model: BarModel
    start: tuple[Element, ...] = ()
    end: tuple[Element, ...] = ()
    hinged: tuple[bool, bool] = (True, True)
    angle: float = 0.0
    hinges: tuple[Law, ...] = ()
    settled: Callable[[Array], Array] | None = None
    line_load: Array = field(default_factory=lambda: np.zeros(3))

    def chain(self) -> ElasticChain:
        """Coordinates: base hinge, slides, bar, tip hinge; those that there are."""
        limb = self.model.limb(self.link)
        chain = Chain((*self._before, *limb.elements, *self._hinge(1), *self.end))
        slides = len(self.link.slides)
        first = int(self.hinged[0])
        bar = slice(first + slides, first + slides + limb.rest.size)
        rest = np.zeros(chain.size)
        rest[bar] = limb.rest
        stiffness = np.zeros((slides + limb.rest.size, slides + limb.rest.size))
        stiffness[slides:, slides:] = limb.stiffness
        springs = [Spring((first + k,), law) for k, law in enumerate(self.link.slides)]
        springs += limb.numbered_from(bar.start)
        nominal = np.zeros(chain.size)
        for k, sign, there in zip((0, chain.size - 1), (1.0, -1.0), self.hinged, strict=True):
            if there:
                nominal[k] = sign
                springs += [Spring((k,), law) for law in self.hinges]
        rest += self.angle * nominal + self._turned(chain.size, 0.0)
        drives = [Drive("q", self.angle, nominal, posture=True)] if any(self.hinged) else []
        if self.settled is not None:
            here = self._turned(chain.size, 0.0)
            drives = [replace(drives[0], curve=lambda change: self._turned(chain.size, change) - here)]
        for name, rate in self.link.elongation:
            slope = np.zeros(chain.size)
            slope[bar] = rate * limb.stretch
            drives.append(Drive(name, 0.0, slope))
        loads = (self._loads(limb.stations, chain),) if np.any(self.line_load) else ()
        return ElasticChain(chain, stiffness, rest, tuple(springs), loads, tuple(drives))

    def _turned(self, size: int, change: ArrayLike) -> Array:
        """(..., size) turns of the hinges in the unloaded linkage from as drawn, at departures (...) from the angle."""
        out = np.zeros((*np.shape(change), size))
        if self.settled is not None:
            out[..., [0, -1]] = self.settled(self.angle + np.asarray(change))
        return out

    def gauge(self, number: int, chain: ElasticChain, place: GaugeAt) -> Gauge:
        """Gauge on the bar, whose chain has this number, or on the platform at its end."""
        if place.offset is not None:
            arm = Fixed(translation=np.asarray(place.offset, dtype=float))
            return gauge(number, (*chain.chain.elements, arm), chain.chain, place.direction)
        elements = (*self._before, *self.model.reach(self.link, place.station))
        return gauge(number, elements, chain.chain, place.direction)

    @property
    def _before(self) -> tuple[Element, ...]:
        slides = tuple(Joint("translation", X, Role.VIRTUAL) for _ in self.link.slides)
        return (*self.start, *self._hinge(0), *slides)

    def _hinge(self, end: int) -> tuple[Element, ...]:
        return (HINGE,) if self.hinged[end] else ()

    def _loads(self, stations: Sequence[tuple[Mark, float]], chain: Chain) -> DeadLoads:
        before = len(self._before)
        marks = tuple(replace(mark, elements=before + mark.elements) for mark, _ in stations)
        shares = np.array([share for _, share in stations])
        return DeadLoads(
            chain, np.arange(chain.size), marks, shares[:, None] * self.link.length * self.line_load
        )


def as_built(nominal: Link, count: int, alterations: tuple[Alteration, ...]) -> tuple[Link, ...]:
    """The bars after all alterations in turn."""
    links = []
    for number in range(count):
        link = nominal
        for alter in alterations:
            link = alter(number, link)
        links.append(link)
    return tuple(links)


def mounted(mount: Array) -> tuple[Element, ...]:
    """The rotation of the whole linkage against the base frame; nothing where there is none."""
    return (Fixed(rotation=exp(mount)),) if np.any(mount) else ()
