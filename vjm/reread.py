"""A mechanism whose sensors read otherwise: nothing that bears load is built again."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.mechanism import ElasticChain, Mechanism
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import Sensor


@dataclass(frozen=True, eq=False)
class Reread:
    """The chains and gauges of a mechanism, read through other sensors (`vjm.sensors`)."""

    mechanism: Mechanism
    sensors: tuple[Sensor, ...]

    @property
    def chains(self) -> tuple[ElasticChain, ...]:
        """Those of the mechanism."""
        return self.mechanism.chains

    @property
    def unloaded_pose(self) -> Array:
        """(6,) nominal, base frame."""
        return self.mechanism.unloaded_pose

    @property
    def length(self) -> float:
        """A characteristic length, mm."""
        return self.mechanism.length

    @property
    def gauges(self) -> tuple[Gauge, ...]:
        """Those of the mechanism."""
        return self.mechanism.gauges


def in_sensors_alone(one: Parallelogram | Bar, other: Parallelogram | Bar) -> bool:
    """Whether two mechanisms differ at most in their sensors. What cannot be told to be the same is not."""
    names = (each.name for each in fields(one) if each.name != "sensors")
    return type(one) is type(other) and all(_same(getattr(one, n), getattr(other, n)) for n in names)


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    return one is other
