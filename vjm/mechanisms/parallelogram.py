"""The kinematic parallelogram: two bars between four parallel hinges (Eq. 1).

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science (EUCOMES 2010), Springer.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from vjm import checks
from vjm.chain import Chain, Element, Fixed, Joint, Role
from vjm.frames import Array, move_stiffness, rotation_y
from vjm.mechanism import ElasticChain

SpringAt = Literal["tip", "middle", "base"]
STATION: dict[SpringAt, float] = {"base": 0.0, "middle": 0.5, "tip": 1.0}

_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def spring_joints() -> tuple[Joint, ...]:
    """The six virtual joints of Eq. 1 in its order: T_x T_y T_z R_x R_y R_z."""
    shifts = tuple(Joint("translation", axis, Role.VIRTUAL) for axis in (_X, _Y, _Z))
    return shifts + tuple(Joint("rotation", axis, Role.VIRTUAL) for axis in (_X, _Y, _Z))


def elastic_bar(length: float, stiffness: Array, station: float) -> tuple[tuple[Element, ...], Array]:
    """Elements of a bar along x whose springs sit at `station` (0 base, 1 tip), and their 6x6 moved there.

    stiffness: (6, 6) of the bar at its tip, base clamped, bar frame.
    """
    rest = (1.0 - station) * length
    before, after = Fixed(np.array([length - rest, 0.0, 0.0])), Fixed(np.array([rest, 0.0, 0.0]))
    return (before, *spring_joints(), after), move_stiffness(stiffness, [-rest, 0.0, 0.0])


@dataclass(frozen=True, eq=False)
class Parallelogram:
    """Parallelogram linkage at nominal bar angle q; the platform point lies midway between the outer hinges.

    length, width: L and d, mm. bar_stiffness: K_b (6, 6) of one bar at its tip, base clamped, bar frame.
    q: nominal rotation R_y of the bars, rad; the unloaded platform is at (L cos q, 0, -L sin q).
    spring_at: where along the bar K_b is lumped. Eq. 1 says the tip. The unloaded stiffness does not depend
    on it, the critical loads do (`vjm.closed_forms`).
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
        return tuple(self._chain(side * 0.5 * self.width) for side in (-1.0, 1.0))

    @property
    def unloaded_pose(self) -> Array:
        """(6,) base frame."""
        return np.array([self.length * np.cos(self.q), 0.0, -self.length * np.sin(self.q), 0.0, 0.0, 0.0])

    def _chain(self, offset: float) -> ElasticChain:
        bar, stiffness = elastic_bar(self.length, self.bar_stiffness, STATION[self.spring_at])
        hinge = Joint("rotation", _Y, Role.PASSIVE)
        start = Fixed(np.array([0.0, 0.0, offset]))
        nominal = rotation_y(self.q)
        end = Fixed(np.array([0.0, 0.0, -offset]), nominal)
        rest = np.array([self.q, *np.zeros(6), -self.q])
        return ElasticChain(Chain((start, hinge, *bar, hinge, end), nominal), stiffness, rest)
