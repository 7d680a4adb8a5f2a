"""A manipulator at one posture, as a mechanism that effects can change: what a campaign measures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.manipulator.assembled import settled
from vjm.manipulator.effects import Shown
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.posture import Postures
from vjm.mechanism import ElasticChain


@dataclass(frozen=True, eq=False)
class Posed(Shown):
    """A manipulator at a posture (no batch axes), which its drives hold; hinges are relaxed where they stand unloaded.

    Its inputs are at their defaults there. ValueError for a posture that is not reached.
    """

    at: Postures
    gauges: tuple[Gauge, ...] = ()

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One for each leg."""
        of, one = machine(self.manipulator), self.at.take(None)
        found = posture_inputs(one) | settled(of, one)
        values = {name: float(value[0]) for name, value in found.items()}
        return tuple(chain.at_inputs(values) for chain in of.chains)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) nominal, base frame."""
        return self.at.pose
