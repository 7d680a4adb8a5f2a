"""What the chain of a leg is made of, and its elastic members one by one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from vjm.chain import Chain, Element, tied_apart
from vjm.frames import Array
from vjm.gauges import Gauge, gauge
from vjm.laws import Spring
from vjm.loads import DeadLoads
from vjm.mechanism import Drive, ElasticChain, Loop, Varying
from vjm.parts import Elastic, Swinging


def named(elements: tuple[Element, ...], name: str) -> tuple[Element, ...]:
    """The elements with a name before their ties; as they are for none."""
    return tied_apart(elements, name) if name else elements


@dataclass(frozen=True, eq=False)
class Member:
    """An elastic member of a leg.

    part: as drawn. before: elements from the base to its beginning. numbers: of all coordinates up to its tip
    among those of the leg. name: before those of its ties, "" for none.
    """

    part: Elastic
    before: tuple[Element, ...]
    numbers: np.ndarray
    name: str

    def gauge(self, leg: int, station: float, direction: tuple[float, float, float]) -> Gauge:
        """Displacement of the point of its axis at `station` along a unit direction of the base frame.

        leg: number of its leg. ValueError for a station outside or a direction not of length 1.
        """
        whole = Chain((*self.before, *named(self.part.model.limb(self.part.link).elements, self.name)))
        seen = gauge(leg, self.reach(station), whole, direction)
        return replace(seen, coordinates=self.numbers[seen.coordinates])

    def reach(self, station: float) -> tuple[Element, ...]:
        """Elements from the base to the point of its axis at `station` (0 base, 1 tip). ValueError for one outside."""
        return (*self.before, *named(self.part.model.reach(self.part.link, station), self.name))


@dataclass(frozen=True, eq=False)
class Built:
    """What the chain of a leg is made of, while nothing sets its posture.

    main, stiffness, springs, loads, loops: see `vjm.mechanism.ElasticChain`. rest: (n,) at the posture zero.
    drives: the inputs by which members lengthen. posture: (m, n) change of the coordinates by those of the posture.
    swinging: pseudo-rigid bars with their number in the posture and the numbers of their five springs. members: the
    elastic ones, in the order of their coordinates.
    """

    name: str
    main: Chain
    stiffness: Array
    rest: Array
    springs: tuple[Spring, ...]
    loads: tuple[DeadLoads, ...]
    drives: tuple[Drive, ...]
    loops: tuple[Loop, ...]
    posture: Array
    swinging: tuple[tuple[Swinging, int, np.ndarray], ...]
    members: tuple[Member, ...]

    @cached_property
    def chain(self) -> ElasticChain:
        """The leg at the posture zero."""
        return self.set_by((), self.rest)

    def set_by(
        self, drives: tuple[Drive, ...], rest: Array, varying: tuple[Varying, ...] = ()
    ) -> ElasticChain:
        """The leg with inputs that set its posture, and with the coordinates (n,) where it rests at their defaults."""
        springs, drives = (self.springs, self.loads), (*drives, *self.drives)
        return ElasticChain(self.main, self.stiffness, rest, *springs, drives, self.loops, varying, self.name)

    @property
    def together(self) -> tuple[int, ...]:
        """Numbers of the coordinates that follow one of the posture with others."""
        shared = [np.flatnonzero(slope) for slope in self.posture]
        return tuple(int(k) for numbers in shared if numbers.size > 1 for k in numbers)
