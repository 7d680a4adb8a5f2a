"""A mechanism whose sensors read otherwise: nothing that bears load is built again."""

from __future__ import annotations

from dataclasses import dataclass

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.mechanism import ElasticChain, Mechanism
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
