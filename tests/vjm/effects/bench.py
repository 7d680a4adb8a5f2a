"""Rigs and load histories on which every effect shows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from vjm import paper
from vjm.effects import catalogue, for_kind, from_file
from vjm.effects.base import Effect, Rig, kind_of
from vjm.effects.thermal_expansion import DRIVE
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.frames import Array
from vjm.lagrangian import layout
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensitivity import Direction, by_parameters
from vjm.sensors import TrueMoment

HERE = Path(__file__).parent
EVERY: dict[str, Effect] = {**catalogue(), **from_file(HERE / "seal_spring.py")}
EFFECTS = {**for_kind("parallelogram"), **from_file(HERE / "seal_spring.py")}
"""What rigs of bars can have."""
NOISE = np.array([1e-3] * 3 + [2e-5] * 3 + [1.0] * 3 + [50.0] * 3 + [1e-3])
"""What a bench resolves of the readings: mm, rad, N, N·mm, mm."""

_FIBRES = {"fibre_y": 8.0, "fibre_z": 9.0}
PARALLELOGRAM = Parallelogram(
    paper.LENGTH,
    paper.WIDTH,
    paper.BAR_STIFFNESS,
    0.3,
    sensors=(TrueMoment(),),
    gauge_at=(GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),),
    **_FIBRES,  # type: ignore[arg-type]
)
BAR = Bar(
    paper.LENGTH,
    paper.BAR_STIFFNESS,
    base="pinned",
    sensors=(TrueMoment(),),
    gauge_at=(GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),),
    **_FIBRES,  # type: ignore[arg-type]
)
RIGS: dict[str, Rig] = {
    "lumped parallelogram": PARALLELOGRAM,
    "refined parallelogram": PARALLELOGRAM.refined(3),
    "lumped bar": BAR,
    "refined bar": BAR.refined(3),
}
QUICK = "lumped parallelogram"
CASES = [
    pytest.param(name, rig, marks=[] if rig == QUICK else pytest.mark.long)
    for name, effect in EFFECTS.items()
    for rig in RIGS
    if kind_of(RIGS[rig]) in effect.kinds
]
"""Every effect on every rig that can have it; on the quick one by default."""

# Two trials side by side, three steps each: forces along x with the rest moved, and forces everywhere but along z.
# The last step turns back by less than what friction takes to slip.
_CHANNELS = np.array([[6, 1, 2, 3, 10, 5], [6, 7, 2, 9, 10, 11]])
_VALUES = np.array(
    [
        [[-700.0, 1.5, 8.0, 0.004, 200.0, 0.02], [-700.0, 6.0, 12.0, 0.4, 300.0, -0.4]],
        [[900.0, 2.5, 3.0, 0.01, 100.0, -0.045], [-900.0, 9.0, 20.0, 0.6, 300.0, -900.0]],
        [[-400.0, 1.0, 2.6, 0.01, -150.0, 0.01], [500.0, -9.0, 19.5, 400.0, 300.0, 600.0]],
    ]
)


@dataclass(frozen=True, eq=False)
class History:
    """Readings (steps, 2, 13) of both trials, and their derivatives (steps, 2, 13, k) if parameters were given."""

    states: list[Equilibrium]
    readings: Array
    slopes: Array


def run(rig: Rig, directions: list[Direction] | None = None, steps: int = 3) -> History:
    """Both trials on a rig, warm where that matters; derivatives of the readings by the directions."""
    targets = _VALUES + np.where(_CHANNELS < 6, np.append(rig.unloaded_pose, np.zeros(6))[_CHANNELS], 0.0)
    warm = DRIVE in layout(rig).drives
    states: list[Equilibrium] = []
    slopes, memory = [], np.zeros(())
    for k, target in enumerate(targets[:steps]):
        drives = {DRIVE: np.full(2, 5.0 * (k + 1))} if warm else None
        states.append(equilibrium(rig, target, _CHANNELS, states[-1] if states else None, drives=drives))
        if directions:
            found = by_parameters(states[-1], directions, memory_slope=memory if memory.size else 0.0)
            slopes.append(found.readings)
            memory = found.memory
    readings = np.array([state.readings for state in states])
    assert all(np.all(state.converged) for state in states), [state.reason for state in states]
    return History(states, readings, np.array(slopes))


def with_values(name: str, rig: Rig, values: Mapping[str, float]) -> Rig:
    """The rig with an effect; parameters not given are of typical size."""
    return EFFECTS[name].apply(rig, {**EFFECTS[name].typicals, **values})
