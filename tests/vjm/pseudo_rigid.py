"""The equivalent pseudo-rigid bar: one rigid link and five coupled virtual springs (paper, abstract)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm import checks
from vjm.bars import spring_joints
from vjm.chain import Chain, Fixed, Joint, Role
from vjm.frames import Array, rotation_y
from vjm.gauges import Gauge
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import Sensor
from vjm.stiffness import unloaded_stiffness

_FREE = 2


@dataclass(frozen=True, eq=False)
class PseudoRigidBar:
    """Bar-type element with the unloaded stiffness of a parallelogram; first order only.

    length: mm. q: nominal angle, rad. springs: (5, 5) stiffness of (x, y, rx, ry, rz) at the tip in the bar
    frame, N, mm, rad. The translation along the bar frame's z is a passive joint: there the linkage is free.
    ValueError for a length that is not positive or springs that are not a 5x5 matrix.
    """

    length: float
    springs: Array
    q: float = 0.0
    sensors: tuple[Sensor, ...] = ()
    gauges: tuple[Gauge, ...] = ()

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        if np.shape(self.springs) != (5, 5):
            raise ValueError(f"springs must be a 5x5 matrix, got shape {np.shape(self.springs)}")

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One chain: turn by q, rigid length, passive z, then five springs."""
        nominal = rotation_y(self.q)
        virtual = spring_joints()
        free = Joint("translation", virtual[_FREE].axis, Role.PASSIVE)
        springs = virtual[:_FREE] + virtual[_FREE + 1 :]
        start = Fixed(rotation=nominal)
        link = Fixed(np.array([self.length, 0.0, 0.0]))
        chain = Chain((start, link, free, *springs), nominal)
        return (ElasticChain(chain, np.asarray(self.springs, dtype=float), np.zeros(chain.size)),)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) base frame."""
        return np.array([self.length * np.cos(self.q), 0.0, -self.length * np.sin(self.q), 0.0, 0.0, 0.0])


def pseudo_rigid_bar(linkage: Parallelogram) -> PseudoRigidBar:
    """The pseudo-rigid bar of a parallelogram: its unloaded K_p, bar frame, without the row and column of z.

    Nothing is lost by dropping them: the five other coordinates carry all of K_p, whose rank is five.
    """
    stiffness = unloaded_stiffness(linkage, linkage.q)
    kept = [i for i in range(6) if i != _FREE]
    springs = stiffness[np.ix_(kept, kept)]
    return PseudoRigidBar(linkage.length, 0.5 * (springs + springs.T), linkage.q)
