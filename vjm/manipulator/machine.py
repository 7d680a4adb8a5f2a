"""A manipulator as the solvers see it: every leg a chain with its loops, its posture among the inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.leg_chain import leg_chain, posture_input
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import Postures
from vjm.mechanism import ElasticChain
from vjm.sensors import Sensor


@dataclass(frozen=True, eq=False)
class Machine:
    """A manipulator as a `vjm.mechanism.Mechanism`; inputs are the coordinates of the posture of each leg.

    turning: whether the turns at which its hinges are relaxed are inputs too (`vjm.manipulator.assembled`).
    """

    manipulator: Manipulator
    turning: bool = False
    gauges: tuple[Gauge, ...] = ()

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One for each leg."""
        return tuple(leg_chain(leg, str(k), self.turning) for k, leg in enumerate(self.manipulator.legs))

    @property
    def unloaded_pose(self) -> Array:
        """(6,) of the end of the first leg at home."""
        chain = self.chains[0]
        return chain.chain.pose(chain.rest[chain.main.numbers])

    @property
    def length(self) -> float:
        """A characteristic length, mm."""
        return self.manipulator.length

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """From true pose and load to what is read."""
        return self.manipulator.sensors


@lru_cache(maxsize=256)
def machine(manipulator: Manipulator) -> Machine:
    """The machine of a manipulator; the same one each time."""
    return Machine(manipulator, _laws_about_turned_hinges(manipulator))


def posture_inputs(at: Postures) -> dict[str, Array]:
    """Inputs (...) of the postures. ValueError for one that is not reached."""
    if not np.all(at.reached):
        raise ValueError(str(at.reason[~at.reached][0]))
    legs = enumerate(at.coordinates)
    return {posture_input(str(k), number): x[..., number] for k, x in legs for number in range(x.shape[-1])}


def known_inputs(of: Machine, inputs: Mapping[str, ArrayLike]) -> dict[str, ArrayLike]:
    """The inputs that something in the machine follows; others change nothing."""
    names = {drive.name for chain in of.chains for drive in chain.drives}
    return {name: value for name, value in inputs.items() if name in names}


def _laws_about_turned_hinges(manipulator: Manipulator) -> bool:
    """Whether a law acts about hinges of a pair of bars that are not as drawn."""
    parts = (p for leg in manipulator.legs for p in leg.parts if isinstance(p, Parallelogram))
    return any(
        p.bars == "pair"
        and any(p.as_built.hinges)
        and any(link.length != p.length for link in p.as_built.links)
        for p in parts
    )
