"""A manipulator at one posture, as a mechanism that effects can change: what a campaign measures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.manipulator.assembled import settled
from vjm.manipulator.effects import MachinePlace, changed_at, places, seen_at, view_of, with_view
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import Sensor


@dataclass(frozen=True, eq=False)
class Posed:
    """A manipulator at a posture (no batch axes), which its drives hold; hinges are relaxed where they stand unloaded.

    Its inputs are at their defaults there. ValueError for a posture that is not reached.
    """

    manipulator: Manipulator
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

    @property
    def length(self) -> float:
        """A characteristic length, mm."""
        return self.manipulator.length

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """From true pose and load to what is read."""
        return self.manipulator.sensors

    @property
    def view(self) -> Parallelogram:
        """What effects see of it (`vjm.effects.base`)."""
        return view_of(self.manipulator)

    def places(self, parts: str) -> tuple[MachinePlace, ...]:
        """The hinges or bars of its parallelograms one by one; none for other parts."""
        return places(self.manipulator, parts)

    def seen_at(self, place: MachinePlace) -> Parallelogram:
        """What effects see of it at one of these."""
        return seen_at(self.manipulator, place)

    def changed_at(self, place: MachinePlace, view: object) -> Posed:
        """It as what is `seen_at` a place has been changed."""
        return replace(self, manipulator=changed_at(self.manipulator, place, view))

    def changed(self, view: object) -> Posed:
        """It as its view has been changed."""
        return replace(self, manipulator=with_view(self.manipulator, view))
