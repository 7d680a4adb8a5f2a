"""The kinematic parallelogram: two bars between four parallel hinges (Eq. 1).

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science (EUCOMES 2010), Springer.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import get_args

import numpy as np

from vjm import checks
from vjm.bars import BarModel, Lumped, SpringAt
from vjm.chain import Chain, Element, Fixed, Joint, Role
from vjm.frames import Array, rotation_y
from vjm.gauges import Gauge, gauge
from vjm.laws import Law, Spring
from vjm.mechanism import ElasticChain

_HINGE = Joint("rotation", (0.0, 1.0, 0.0), Role.PASSIVE)


@dataclass(frozen=True, eq=False)
class Parallelogram:
    """Parallelogram linkage at nominal bar angle q; the platform point lies midway between the outer hinges.

    length, width: L and d, mm. bar_stiffness: K_b (6, 6) of one bar at its tip, base clamped, bar frame.
    q: nominal rotation R_y of the bars, rad; the unloaded platform is at (L cos q, 0, -L sin q).
    spring_at: where along the bar K_b is lumped. Eq. 1 says the tip. The unloaded stiffness does not depend
    on it, the critical loads do (`vjm.closed_forms`).
    bar: another model of the bars than K_b lumped at that place, such as `vjm.refined.Refined`.
    hinges: laws of the rotation of each of the four hinges from its nominal angle; none in a perfect hinge.
    The last factor of Eq. 1 is the constant rotation R_y(q); printed as R_y(-q_i2), it would let the platform
    slip past the hinges (rank 4).
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

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        checks.positive("width", self.width)
        if not abs(self.q) < np.pi / 2:
            raise ValueError(f"q must lie between -pi/2 and pi/2 rad, got {self.q}")
        if self.spring_at not in get_args(SpringAt):
            raise ValueError(f"spring_at must be one of {get_args(SpringAt)}, got {self.spring_at!r}")
        object.__setattr__(
            self, "bar_stiffness", checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        )

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """Chain 1 starts at z = -d/2, chain 2 at +d/2; coordinates q_i1, theta_i1..6, q_i2."""
        limb = self._model.limb(self.length, self.bar_stiffness)
        nominal = rotation_y(self.q)
        chains = []
        for offset in self._offsets:
            end = Fixed(np.array([0.0, 0.0, -offset]), nominal)
            chain = Chain((*self._start(offset), *limb.elements, _HINGE, end), nominal)
            rest = np.zeros(chain.size)
            rest[0], rest[-1] = self.q, -self.q
            hinges = tuple(Spring((k,), law) for law in self.hinges for k in (0, chain.size - 1))
            chains.append(ElasticChain(chain, limb.stiffness, rest, limb.numbered_from(1) + hinges))
        return tuple(chains)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) base frame."""
        return np.array([self.length * np.cos(self.q), 0.0, -self.length * np.sin(self.q), 0.0, 0.0, 0.0])

    def gauge(self, bar: int, station: float, direction: tuple[float, float, float]) -> Gauge:
        """Displacement of the axis of bar 1 or 2 at `station` (0 base, 1 tip) along a base-frame direction."""
        if bar not in (1, 2):
            raise ValueError(f"bar must be 1 or 2, got {bar}")
        reach = self._model.reach(self.length, self.bar_stiffness, station)
        elements = (*self._start(self._offsets[bar - 1]), *reach)
        return gauge(bar - 1, elements, self.chains[bar - 1], direction)

    @property
    def _model(self) -> BarModel:
        return Lumped(self.spring_at) if self.bar is None else self.bar

    @property
    def _offsets(self) -> tuple[float, float]:
        return -0.5 * self.width, 0.5 * self.width

    @staticmethod
    def _start(offset: float) -> tuple[Element, ...]:
        return Fixed(np.array([0.0, 0.0, offset])), _HINGE
