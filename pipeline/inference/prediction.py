"""What a model predicts for the load cases of a campaign, with the derivatives that a fit and an error bar need."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import COORDINATES
from pipeline.inference.model import Free, Model
from pipeline.inference.program import Group, Program
from vjm.effects.base import Rig
from vjm.effects.thermal_expansion import DRIVE
from vjm.equilibrium import Equilibrium, equilibrium, stack
from vjm.lagrangian import layout
from vjm.mechanism import initial_memory
from vjm.sensitivity import Direction, DriveDirection, by_parameters, by_targets

Array = NDArray[np.float64]
_KELVIN = 1.0


@dataclass(frozen=True, eq=False)
class Prediction:
    """Readings of a model, rows and channels as in `Program`.

    values: (R, C); pose channels are displacements. by_inputs: (R, C, 6) derivative by what is prescribed at the
    same step. by_temperature: (R, C) per K. by_free: (R, C, P), empty where not asked for. lost: (R,) rows without
    a stable equilibrium. reasons: of the lost rows. states: of each group, to start from again.
    """

    values: Array
    by_inputs: Array
    by_temperature: Array
    by_free: Array
    lost: np.ndarray
    reasons: dict[int, str]
    states: tuple[Equilibrium, ...]


@dataclass(frozen=True, eq=False)
class _Part:
    """One group's share, arrays (T, S, ...)."""

    values: Array
    by_inputs: Array
    by_temperature: Array
    by_free: Array
    state: Equilibrium


def predict(
    model: Model, program: Program, slopes: bool = True, start: Prediction | None = None
) -> Prediction:
    """Readings at all rows; start: a prediction of a like model, from whose states to begin.

    ValueError for an effect that the rig cannot have.
    """
    count = len(model.free) if slopes else 0
    rows, channels = program.measured.shape
    out = Prediction(
        np.zeros((rows, channels)),
        np.zeros((rows, channels, 6)),
        np.zeros((rows, channels)),
        np.zeros((rows, channels, count)),
        np.zeros(rows, dtype=bool),
        {},
        (),
    )
    states = []
    for number, group in enumerate(program.groups):
        begin = None if start is None else start.states[number]
        part = _group(model, program, group, slopes, begin)
        place, real = program.rows_of(group), group.real
        out.values[place], out.by_inputs[place] = part.values[real], part.by_inputs[real]
        out.by_temperature[place], out.by_free[place] = part.by_temperature[real], part.by_free[real]
        lost = ~part.state.converged | (part.state.unstable > 0)
        out.lost[place] = lost[real]
        for row, reason in zip(place[lost[real]], part.state.reason[real][lost[real]], strict=True):
            out.reasons[int(row)] = "unstable" if reason == "converged" else str(reason)
        states.append(part.state)
    return replace(_zeroed(out, program), states=tuple(states))


def _group(model: Model, program: Program, group: Group, slopes: bool, start: Equilibrium | None) -> _Part:
    gauges = program.campaign.gauges
    mechanism = model.mechanism(group.rig, gauges)
    drives = layout(mechanism).drives
    inputs = {"q": np.broadcast_to(group.q[:, None], group.rise.shape), DRIVE: group.rise}
    inputs = {name: value for name, value in inputs.items() if name in drives}
    directions = [_direction(model, each, k, group, program) for k, each in enumerate(model.free)]
    asked: list[Direction | DriveDirection] = list(directions) if slopes else []
    if DRIVE in drives:
        asked.append(DriveDirection(DRIVE, _KELVIN))
    if initial_memory(mechanism).size:
        state, by_inputs, by = _history(mechanism, group, inputs, asked)
    else:
        state, by_inputs, by = _at_once(mechanism, group, inputs, asked, start)
    values = state.readings
    values[..., :6] -= group.nominal
    warm = by[..., -1] if DRIVE in drives else np.zeros(values.shape)
    return _Part(values, by_inputs, warm, by[..., : len(directions) if slopes else 0], state)


def _at_once(
    mechanism: Rig,
    group: Group,
    inputs: dict[str, Array],
    asked: list[Direction | DriveDirection],
    start: Equilibrium | None,
) -> tuple[Equilibrium, Array, Array]:
    """All steps together: where the past does not matter."""
    if start is not None and start.unknowns.shape[-1] != layout(mechanism).size:
        start = None
    begin = None if start is None else replace(start, mechanism=mechanism)
    state = equilibrium(mechanism, group.targets, group.channels[:, None], begin, drives=inputs)
    by = by_parameters(state, asked).readings if asked else np.zeros((*state.readings.shape, 0))
    return state, by_targets(state).readings, by


def _history(
    mechanism: Rig, group: Group, inputs: dict[str, Array], asked: list[Direction | DriveDirection]
) -> tuple[Equilibrium, Array, Array]:
    """Step after step, all tests together, the memory and its derivatives handed on."""
    state, memory = None, np.zeros((1, len(asked)))
    states, by_inputs, by = [], [], []
    for step in range(group.targets.shape[1]):
        now = {name: value[:, step] for name, value in inputs.items()}
        state = equilibrium(mechanism, group.targets[:, step], group.channels, state, drives=now)
        states.append(state)
        by_inputs.append(by_targets(state).readings)
        if asked:
            found = by_parameters(state, asked, memory_slope=memory if step else 0.0)
            memory = found.memory
            by.append(found.readings)
        else:
            by.append(np.zeros((*state.readings.shape, 0)))
    whole = stack(states)
    whole = replace(
        whole,
        **{
            name: np.moveaxis(getattr(whole, name), 0, 1)
            for name in (
                "unknowns",
                "iterations",
                "residual",
                "converged",
                "reason",
                "unstable",
                "channels",
                "memory",
                "drives",
            )
        },
    )
    return whole, np.stack(by_inputs, axis=1), np.stack(by, axis=1)


def _direction(model: Model, each: Free, number: int, group: Group, program: Program) -> Direction:
    value = float(model.values[number])
    # Differences stay on the same side of a bound as the value.
    room = min(value - each.parameter.low, each.parameter.high - value)
    size = min(abs(each.parameter.typical), room / 3e-3)
    return Direction(partial(_moved, model, number, group, program), value, size)


def _moved(model: Model, number: int, group: Group, program: Program, value: float) -> Rig:
    values = model.values
    values[number] = value
    return model.at(values).mechanism(group.rig, program.campaign.gauges)


def _zeroed(prediction: Prediction, program: Program) -> Prediction:
    """Readings less those of the first row, in tests that were zeroed there; what is prescribed stays."""
    values = prediction.values.copy()
    by_free, warm = prediction.by_free.copy(), prediction.by_temperature.copy()
    for k, test in enumerate(program.campaign.tests):
        if test.zero != "first_row":
            continue
        rows = slice(int(program.first[k]), int(program.first[k + 1]))
        out = np.ones(values.shape[1], dtype=bool)
        out[program.channels[rows.start]] = False
        for array in (values, by_free, warm):
            array[rows] -= np.where(out.reshape(-1, *[1] * (array.ndim - 2)), array[rows.start], 0.0)
    return replace(prediction, values=values, by_free=by_free, by_temperature=warm)


def coordinate_names(program: Program) -> tuple[str, ...]:
    """Names of the channels as columns of measurements.csv without units."""
    wrench = tuple(f"{'f' if k < 3 else 'm'}{'xyz'[k % 3]}" for k in range(6))
    return (*COORDINATES, *wrench, *(g.name for g in program.campaign.gauges))
