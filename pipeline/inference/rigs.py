"""A rig as it was described, as a mechanism of virtual springs with what is known about it."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from pipeline.campaign import Gauge
from pipeline.campaign import Rig as Described
from vjm.effects.base import Rig
from vjm.effects.sized import Scale, scale_of
from vjm.manipulator.effects import Surroundings
from vjm.manipulator.machine import machine
from vjm.manipulator.posed import Posed
from vjm.manipulator.posture import Postures, postures
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import DeadWeight, Sensor, TrueMoment

Solvable = Rig | Posed
"""A mechanism that effects can change."""


def mechanism_of(rig: Described, gauges: tuple[Gauge, ...]) -> Solvable:
    """The plain mechanism: lumped springs (Eq. 1), known weights, sensors that read true moments."""
    sensors: tuple[Sensor, ...] = (TrueMoment(),)
    down = rig.down
    if down is not None and rig.platform_weight:
        sensors = (*sensors, DeadWeight(rig.platform_weight * down))
    if rig.manipulator is not None:
        down = rig.manipulator.gravity if down is None else down
        return Posed(replace(rig.manipulator, sensors=sensors, gravity=down), _posture(rig))
    places = tuple(GaugeAt(g.bar, g.station, g.vector, g.offset) for g in gauges)
    it: Rig
    if rig.kind == "parallelogram":
        assert rig.width is not None
        it = Parallelogram(rig.length, rig.width, rig.stiffness)
    else:
        it = Bar(rig.length, rig.stiffness, base=rig.base, tip=rig.tip)
    it = replace(it, sensors=sensors, gauge_at=places, fibre_y=rig.fibre_y, fibre_z=rig.fibre_z)
    if down is None:
        return it
    return replace(it, gravity=down, line_load=rig.line_weight * down)


@lru_cache(maxsize=256)
def _posture(rig: Described) -> Postures:
    """Where the joints of a manipulator stand: at the point of the rig, or at home."""
    assert rig.manipulator is not None
    if rig.point is not None:
        return postures(rig.manipulator, np.array(rig.point, dtype=float))
    pose = machine(rig.manipulator).unloaded_pose
    home = tuple(leg.home for leg in rig.manipulator.legs)
    return Postures(pose, home, np.array(True), np.array("", dtype=object))


@lru_cache(maxsize=64)
def scale_of_rig(rig: Described) -> Scale:
    """By what typical sizes of effects differ from those of the catalogue; a machine without bars has no measure."""
    view = mechanism_of(rig, ()).view
    if isinstance(view, Surroundings):
        return Scale()
    first = view.links[0]
    return scale_of(first.length, first.stiffness)


def nominal_pose(rig: Described, q: np.ndarray) -> np.ndarray:
    """(..., 6) unloaded platform of the rig as drawn at the angles q (...), rad."""
    pose = np.zeros((*np.shape(q), 6))
    if rig.point is not None:
        pose[..., :3] = rig.point
        return pose
    pose[..., 0], pose[..., 2] = rig.length * np.cos(q), -rig.length * np.sin(q)
    return pose
