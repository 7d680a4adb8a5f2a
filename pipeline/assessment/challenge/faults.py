"""What no effect of the catalogue explains: faults of sensors, a hinge that sticks at one angle, bars that creep."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.benches import Bench
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES

Array = NDArray[np.float64]
Fault = Callable[[Bench, list[Readings], float], list[Readings]]
LOAD = 4000.0


def growing_gain(bench: Bench, found: list[Readings], size: float) -> list[Readings]:
    """The load cell reads 1 % of `size` too much along x at its largest load, less in proportion below."""
    largest = max(float(np.max(np.abs(it.wrench[:, 0]))) for it in found)
    return [_wrench(it, 0, it.wrench[:, 0] * 0.01 * size * np.abs(it.wrench[:, 0]) / largest) for it in found]


def cross_talk(bench: Bench, found: list[Readings], size: float) -> list[Readings]:
    """So many thousandths of the axial force are read as a side force, and of its square as a moment about z."""
    out = []
    for it in found:
        axial = it.wrench[:, 0]
        it = _wrench(it, 1, 1e-3 * size * axial)
        out.append(_wrench(it, 3, 1e-2 * size * bench.rig.length * axial * np.abs(axial) / LOAD))
    return out


def creeping_gauge(bench: Bench, found: list[Readings], size: float) -> list[Readings]:
    """The gauge's zero moves by so many hundredths of a millimetre during each test, fast at first."""
    out = []
    for it in found:
        way = 1.0 - np.exp(-3.0 * np.linspace(0.0, 1.0, len(it.gauges)))
        out.append(replace(it, gauges=it.gauges + 0.01 * size * way[:, None]))
    return out


def sticking_hinge(bench: Bench, found: list[Readings], size: float) -> list[Readings]:
    """Friction of so many typical torques in the tests at one angle, none at the others."""
    angles = sorted({t.q_deg for t in bench.plan if not t.holdout})
    mine = [k for k, test in enumerate(bench.plan) if test.q_deg == angles[-1] and not test.holdout]
    hidden = {"joint_friction.torque_Nmm": 300.0 * size, "joint_friction.presliding_rad": 0.001}
    stuck = true_readings(bench.rig, [bench.plan[k] for k in mine], hidden, GAUGES)
    out = list(found)
    for k, it in zip(mine, stuck, strict=True):
        out[k] = it
    return out


def creeping_bars(bench: Bench, found: list[Readings], size: float) -> list[Readings]:
    """Bars of a standard linear solid: where a load stands its displacement goes on by 1 % of `size`, in five steps;
    where a displacement is prescribed its load relaxes by as much."""
    rate = np.exp(-1.0 / 5.0)
    out = []
    for test, it in zip(bench.plan, found, strict=True):
        displacement, wrench = it.displacement.copy(), it.wrench.copy()
        for k, by in enumerate(test.control):
            read, sign = (displacement, 1.0) if by == "force" else (wrench, -1.0)
            read[:, k] += sign * 0.01 * size * _late(read[:, k], rate)
        out.append(replace(it, displacement=displacement, wrench=wrench))
    return out


def _late(values: Array, rate: float) -> Array:
    """What an exponential memory has taken up of a history."""
    out, held = np.zeros_like(values), 0.0
    for k, value in enumerate(values):
        held = rate * held + (1.0 - rate) * value
        out[k] = held
    return out


def _wrench(it: Readings, channel: int, more: Array) -> Readings:
    wrench = it.wrench.copy()
    wrench[:, channel] += more
    return replace(it, wrench=wrench)


FAULTS: Mapping[str, Fault] = {
    "growing_gain": growing_gain,
    "cross_talk": cross_talk,
    "creeping_gauge": creeping_gauge,
    "sticking_hinge": sticking_hinge,
    "creeping_bars": creeping_bars,
}

AT_FAULT: Mapping[str, tuple[str, ...]] = {
    "growing_gain": ("fx_N",),
    "cross_talk": ("fy_N", "mx_Nmm"),
    "creeping_gauge": ("mid_mm",),
}
"""Columns that a fault is in: who names these sensors and nothing else is right, whatever its form."""


def of_sensor(name: str, columns: Sequence[str]) -> bool:
    """Whether an effect is a fault of one of these sensors."""
    return name.partition("@")[2].partition("<")[0] in columns
