"""A manipulator at many postures at once, as one mechanism that effects can change: what a campaign measures.

Where the drives hold each test is among its inputs, as departures from home, so that all postures are solved together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.manipulator.assembled import settled
from vjm.manipulator.effects import Shown
from vjm.manipulator.machine import Machine, machine, posture_inputs
from vjm.manipulator.posture import Postures
from vjm.mechanism import ElasticChain


def stacked(one: Sequence[Postures]) -> Postures:
    """Postures without batch axes, in one batch (T,)."""
    legs = zip(*(it.coordinates for it in one), strict=True)
    return Postures(
        np.stack([it.pose for it in one]),
        tuple(np.stack(leg) for leg in legs),
        np.array([bool(it.reached) for it in one]),
        np.array([str(it.reason) for it in one], dtype=object),
    )


@dataclass(frozen=True, eq=False)
class Standing(Shown):
    """A manipulator at postures (T,), which its drives hold; hinges are relaxed where they stand unloaded.

    ValueError, where inputs are asked for, for a posture that is not reached.
    """

    at: Postures
    gauges: tuple[Gauge, ...] = ()

    @property
    def machine(self) -> Machine:
        """The manipulator at home, its postures among its inputs."""
        return machine(self.manipulator)

    @property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One for each leg."""
        return self.machine.chains

    @cached_property
    def inputs(self) -> dict[str, Array]:
        """(T,) of each input, rad and mm: the coordinates of the postures, and the turns at which hinges are relaxed,
        which follow from what the bars are."""
        return posture_inputs(self.at) | settled(self.machine, self.at)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) nominal, base frame, of the first posture."""
        return np.asarray(self.at.pose[0])
