"""Small campaigns of the virtual bench, and faults of sensors that no effect of the catalogue explains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign, Data
from pipeline.simulate import bench_rig

AXIAL = ("axial_held_q+0", "axial_held_q+30", "axial_held_q-30")
MIXED = ("axial_held_q+0", "lateral_q+0", "swing_q+0", "axial_held_q+30", "axial_held_q+15")
Fault = Callable[[Data], Data]
COARSE = replace(
    SENSORS,
    displacement=10.0 * SENSORS.displacement,
    wrench=10.0 * SENSORS.wrench,
    gauges=10.0 * SENSORS.gauges,
)
"""Sensors ten times coarser than those of a good bench."""


@cache
def bench(effect: str = "", value: float = 0.0, ids: tuple[str, ...] = MIXED, seed: int = 1) -> Campaign:
    """With one hidden parameter "effect.parameter"."""
    plan = [test for test in bench_plan(12) if test.id in ids]
    return measure("small", bench_rig(), plan, SENSORS, {effect: value} if effect else {}, seed, GAUGES)


def with_fault(campaign: Campaign, fault: Fault) -> Campaign:
    """Every test as a faulty sensor would have read it."""
    return replace(campaign, tests=tuple(replace(t, data=fault(t.data)) for t in campaign.tests))


def growing_gain(data: Data) -> Data:
    """The load cell reads 1 % too much at 4 kN, in proportion to the load."""
    wrench = data.wrench.copy()
    wrench[:, 0] *= 1.0 + 2.5e-6 * np.abs(wrench[:, 0])
    return replace(data, wrench=wrench)


def creeping_gauge(data: Data) -> Data:
    """The gauge's zero moves by 10 µm during each test."""
    return replace(data, gauges=data.gauges + 0.01 * np.linspace(0.0, 1.0, len(data.steps))[:, None])


def cross_talk(data: Data) -> Data:
    """A thousandth of the axial force appears as a side force."""
    wrench = data.wrench.copy()
    wrench[:, 1] += 2e-3 * wrench[:, 0]
    return replace(data, wrench=wrench)
