"""The Orthoglide in many postures with a load in each, of which the position alone is read: frame elements, at rest, of
a machine whose parts are not as its file says."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.doubts.benches import SEED
from pipeline.assessment.virtual.manipulator import Loading, measure_manipulator
from pipeline.campaign import Campaign, ManipulatorRig, Noise
from pipeline.campaign.tolerance import usual
from pipeline.manipulator.description import read
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.parts import Actuator, Elastic, Part

Array = NDArray[np.float64]
POSTURES = 40
REACH = 0.2
"""Of the characteristic length, that a posture is off the home one along each axis at most."""
LOAD = 1000.0
"""N in each posture, in a direction of its own."""
NOISE = Noise(
    displacement=np.array([0.01, 0.01, 0.01, np.nan, np.nan, np.nan]),
    wrench=np.array([0.5, 0.5, 0.5, np.nan, np.nan, np.nan]),
    gauges=np.zeros(0),
)
"""10 um of a tracker, 0.5 N of a load cell; no turn and no moment is read."""


@dataclass(frozen=True)
class Factors:
    """Stiffness of drives, of links and of the bars of parallelograms over that of the file, the same in all legs."""

    drives: float = 1.0
    links: float = 1.0
    bars: float = 1.0


def stiffened(machine: Manipulator, by: Factors) -> Manipulator:
    """A machine with its parts so much stiffer."""
    legs = tuple(replace(leg, parts=tuple(_part(part, by) for part in leg.parts)) for leg in machine.legs)
    return replace(machine, legs=legs)


def _part(part: Part, by: Factors) -> Part:
    if isinstance(part, Actuator) and part.stiffness is not None:
        return replace(part, stiffness=by.drives * part.stiffness)
    if isinstance(part, Elastic):
        return replace(part, link=part.link.stiffened(by.links))
    if isinstance(part, Parallelogram):
        return replace(part, bar_stiffness=by.bars * part.bar_stiffness)
    return part


def loadings(number: int) -> tuple[Loading, ...]:
    """Postures and loads of the bench of that number, the same for every kind."""
    generator, rig = np.random.default_rng([SEED, number]), written()
    home = rig.nominal_pose(np.zeros(1))[0, :3]
    found: list[Loading] = []
    while len(found) < POSTURES:
        x, y, z = (home + rig.length * generator.uniform(-REACH, REACH, 3)).tolist()
        way = generator.normal(size=3)
        if not replace(rig, at=(x, y, z)).posture.reached:
            continue
        load = np.concatenate([LOAD * way / np.linalg.norm(way), np.zeros(3)])
        found.append(Loading(f"p{len(found) + 1:02d}", (x, y, z), "fit", load[None]))
    return tuple(found)


def written() -> ManipulatorRig:
    """As its file says."""
    machine = read("orthoglide").manipulator
    return ManipulatorRig(length=machine.length, manipulator=machine, file="orthoglide")


def measured(number: int, by: Factors, noise: Noise = NOISE) -> Campaign:
    """The campaign of a machine that is so much stiffer than it is written."""
    rig, plan = written(), loadings(number)
    true = replace(rig, manipulator=stiffened(rig.manipulator, by))
    found = measure_manipulator(f"machine {number}", true, plan, {}, SEED + number, noise)
    tests = tuple(
        replace(test, rig=replace(rig, at=one.point)) for test, one in zip(found.tests, plan, strict=True)
    )
    return replace(found, rig=rig, tests=tests, tolerance=usual(rig.written))
