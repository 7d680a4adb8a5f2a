"""Which prescribed quantity drives a test: the load that its readings are looked at against."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Gauge, Test
from pipeline.campaign.control import control_channels
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.inference.settings import GOOD_SENSOR

Array = NDArray[np.float64]


def column_name(channel: int, gauges: tuple[Gauge, ...]) -> str:
    """Channel of a `LoadCases` as in campaign.toml: a coordinate, a force or a gauge, without its unit."""
    names = [name.rpartition("_")[0] for name in (*DISPLACEMENTS, *WRENCHES)]
    return [*names, *(gauge.name for gauge in gauges)][channel]


def unit_of(channel: int) -> str:
    """Unit of a channel as in the column's name: mm, rad, N, Nmm."""
    return ([name.rpartition("_")[2] for name in (*DISPLACEMENTS, *WRENCHES)] + ["mm"])[min(channel, 12)]


def driving(test: Test, gauges: tuple[Gauge, ...]) -> tuple[int, Array]:
    """The channel whose prescribed quantity travels farthest, in sizes of `GOOD_SENSOR` on the rig, and its values
    (N,)."""
    channels = control_channels(test, gauges)
    values = test.inputs(gauges)
    scale = test.rig.scale
    sizes = np.array([GOOD_SENSOR[unit_of(channel)] * scale.of(unit_of(channel)) for channel in channels])
    number = int(np.argmax(np.ptp(values / sizes, axis=0)))
    return channels[number], values[:, number]
