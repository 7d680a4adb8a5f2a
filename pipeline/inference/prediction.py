"""What a model predicts for the load cases of a campaign, with the derivatives that a fit and an error bar need."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.rig import Solvable
from pipeline.inference.bifurcation import Sight, branched
from pipeline.inference.history import history
from pipeline.inference.load_cases import INPUTS, Group, LoadCases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction, no_slides, no_stops, zeroed
from pipeline.inference.sensor_faults import faulted, in_mechanism, inputs_off
from pipeline.inference.settings import DIFFERENCES
from vjm.effects.bar_initial_bow import BarInitialBow
from vjm.effects.thermal_expansion import DRIVE
from vjm.equilibrium import Equilibrium, drive_values, equilibrium
from vjm.history import by_history
from vjm.lagrangian import layout
from vjm.mechanism import initial_memory
from vjm.newton import CONVERGED
from vjm.reasons import Reason
from vjm.sensitivity import (
    TARGETS,
    AnyDirection,
    Direction,
    DriveDirection,
    Sensitivity,
    SensorDirection,
    by_parameters,
    differences,
)
from vjm.slides import slides, with_slides
from vjm.stops import pressed, slid
from vjm.tight import tight

Array = NDArray[np.float64]
_KELVIN = 1.0
_GAUGES = 12
"""Channels from which on readings are those of gauges."""
OVERFLOW = "the numbers of the model leave the range of arithmetic there"


@dataclass(frozen=True, eq=False)
class _Part:
    """One group's share: arrays (R, ...) of its rows, states (T, S)."""

    values: Array
    by_inputs: Array
    by_free: Array
    state: Equilibrium
    stops: Array
    slides: Array


def predict(
    model: Model,
    load_cases: LoadCases,
    slopes: bool = True,
    start: Prediction | None = None,
    shift: Array | None = None,
    order: int = 2,
    held: bool = False,
    bent: bool = True,
) -> Prediction:
    """Readings at all rows; start: a prediction of a like model, from whose states to begin.

    shift: (R, 7) added to the measured inputs and temperature. order: of the differences in derivatives by numbers,
    see `vjm.sensitivity`; 0 where readings alone are wanted: a bench has zeros for all derivatives then. held: each
    row by itself, with the memory that its state at the start had. bent: whether rows beyond a bifurcation are followed
    on their branch.
    ValueError for an effect that the rig cannot have.
    """
    count = len(model.free) if slopes else 0
    rows, channels = load_cases.measured.shape
    out = Prediction(
        np.zeros((rows, channels)),
        np.zeros((rows, channels, INPUTS)),
        np.zeros((rows, channels, count)),
        np.zeros((rows, INPUTS)) if shift is None else shift,
        no_stops(rows),
        no_slides(rows),
        np.zeros(rows, dtype=bool),
        {},
        (),
    )
    states, off = [], out.shift + inputs_off(model, load_cases)
    for number, group in enumerate(load_cases.groups):
        begin = None if start is None else start.states[number]
        place, real = load_cases.rows_of(group), group.real
        stood = _shifted(group.turned(model.turn), off[place])
        part = _group(model, load_cases, stood, slopes, begin, order, held, bent)
        out.values[place], out.by_inputs[place] = part.values, part.by_inputs
        out.by_free[place] = part.by_free
        count = part.stops.shape[-2]
        if count > out.stops.shape[1]:
            out = replace(out, stops=no_stops(rows, count), slides=no_slides(rows, count))
        out.stops[place, :count], out.slides[place, :count] = part.stops, part.slides
        lost = ~part.state.converged | (part.state.unstable > 0)
        out.lost[place] = lost[real]
        for row, reason in zip(place[lost[real]], part.state.reason[real][lost[real]], strict=True):
            out.reasons[int(row)] = Reason.UNSTABLE if reason == CONVERGED else Reason.of(reason)
        states.append(part.state)
    read = faulted(model, load_cases, _finite(out))
    return replace(zeroed(read, load_cases), states=tuple(states))


def _finite(found: Prediction) -> Prediction:
    """The prediction with rows lost of which a number is none: no weighting can be made of them."""
    parts = (found.values, found.by_inputs, found.by_free, found.slides[..., 2:], found.stops[..., 1:])
    good = np.all([np.isfinite(part.reshape(len(part), -1)).all(axis=1) for part in parts], axis=0)
    if good.all():
        return found
    arrays: dict[str, Any] = {
        name: np.where(good.reshape(-1, *[1] * (getattr(found, name).ndim - 1)), getattr(found, name), blank)
        for name, blank in (
            ("values", 0.0),
            ("by_inputs", 0.0),
            ("by_free", 0.0),
            ("stops", no_stops(1, found.stops.shape[1])),
            ("slides", no_slides(1, found.slides.shape[1])),
        )
    }
    said = {int(row): OVERFLOW for row in np.flatnonzero(~good)}
    return replace(found, lost=found.lost | ~good, reasons=said | found.reasons, **arrays)


def _group(
    model: Model,
    load_cases: LoadCases,
    group: Group,
    slopes: bool,
    start: Equilibrium | None,
    order: int,
    held: bool,
    bent: bool,
) -> _Part:
    mechanism, rows = model.mechanism(group, load_cases.campaign.gauges), load_cases.rows_of(group)
    if held or not initial_memory(mechanism).size:
        # Filling would be solved for nothing; it gets the state that it repeats.
        alone = group.by_steps
        begin = None if start is None else start.member(np.nonzero(group.real)).reshaped(len(alone.q), 1)
        part = _solved(model, load_cases, alone, rows[:, None], mechanism, slopes, begin, order, held, bent)
        state = part.state.member((group.places, np.zeros_like(group.places)))
        return replace(part, state=state)
    return _solved(model, load_cases, group, rows[group.places], mechanism, slopes, start, order, held, bent)


def _solved(
    model: Model,
    load_cases: LoadCases,
    group: Group,
    rows: NDArray[np.int64],
    mechanism: Solvable,
    slopes: bool,
    start: Equilibrium | None,
    order: int,
    held: bool,
    bent: bool,
) -> _Part:
    """rows: (T, S) of the steps of the group in the load cases."""
    drives, inputs = layout(mechanism).drives, _whole(group, mechanism)
    count = len(model.free) if slopes else 0
    moving = in_mechanism(model)[:count]
    asked: list[AnyDirection] = []
    if order:
        asked += [*TARGETS, *(_direction(model, k, group, load_cases) for k in moving)]
        asked += [DriveDirection(DRIVE, _KELVIN)] if DRIVE in drives else []
    begin = _begin(mechanism, group, inputs, start)
    if held and begin is not None:
        channels, memory = group.channels[:, None], begin.memory
        state = equilibrium(mechanism, group.targets, channels, begin, drives=inputs, memory=memory)
        by, change = _changes(by_parameters, state, asked, order)
    elif initial_memory(mechanism).size:
        state = history(mechanism, group, inputs, begin)
        by, change = _changes(by_history, state, asked, order)
    else:
        state = equilibrium(mechanism, group.targets, group.channels[:, None], begin, drives=inputs)
        state = _branched(mechanism, group, inputs, state)
        if bent:
            state = branched(mechanism, group, Sight.of(load_cases, rows), inputs, state, begin)
        by, change = _changes(by_parameters, state, asked, order)
    stops, slides = _stops(state, change, DRIVE in drives)
    values = state.readings.copy()
    values[..., :6] -= group.nominal
    if not asked:
        by = np.zeros((*values.shape, 7 + len(moving)))
    warm = by[..., -1:] if DRIVE in drives else np.zeros((*values.shape, 1))
    by_inputs = np.concatenate([by[..., :6], warm], axis=-1)
    real, by_free = group.real, np.zeros((*values.shape, count))
    by_free[..., moving] = by[..., 6 : 6 + len(moving)]
    return _Part(values[real], by_inputs[real], by_free[real], state, stops[real], slides[real])


def _changes(
    along: Callable[..., Sensitivity],
    state: Equilibrium,
    asked: Sequence[AnyDirection],
    order: int,
) -> tuple[Array, Array]:
    """Derivatives of readings and unknowns in the directions asked for; of the unknowns zeros where there are none."""
    if not asked:
        return np.zeros((*state.readings.shape, 0)), np.zeros((*state.unknowns.shape, INPUTS))
    found = along(state, asked, order=order)
    return found.readings, found.unknowns


def _stops(state: Equilibrium, unknowns: Array, heated: bool) -> tuple[Array, Array]:
    """(T, S, K, 8) and (T, S, K, 9) as in `Prediction`, from the derivatives of the unknowns in the directions asked
    for."""
    force, pressing = pressed(state, unknowns)
    strain, half, sliding = slid(state, unknowns)
    width = np.broadcast_to(half, strain.shape)
    return (
        np.concatenate([force[..., None], _inputs(pressing, heated)], axis=-1),
        np.concatenate([strain[..., None], width[..., None], _inputs(sliding, heated)], axis=-1),
    )


def _inputs(slopes: Array, heated: bool) -> Array:
    """(..., 7) by the targets and, where there is heat, by the temperature, of slopes in the directions asked for."""
    warm = slopes[..., -1:] if heated else np.zeros((*slopes.shape[:-1], 1))
    return np.concatenate([slopes[..., :6], warm], axis=-1)


def _whole(group: Group, mechanism: Solvable) -> dict[str, Array]:
    """(T, S) of each input of a mechanism."""
    shape = group.rise.shape
    return {name: np.broadcast_to(value, shape) for name, value in group.inputs(mechanism).items()}


def _branched(mechanism: Solvable, group: Group, inputs: dict[str, Array], state: Equilibrium) -> Equilibrium:
    """Rows that a gauge drives and that were lost, once more from bowed bars: straight ones bend only past a
    bifurcation, and from rest no load moves the gauge."""
    lost = ~state.converged | (state.unstable > 0)
    if not lost.any() or np.all(group.channels < _GAUGES):
        return state
    slight = DIFFERENCES.slight * mechanism.length
    bowed = BarInitialBow().apply(mechanism, {"bow_y_mm": slight, "bow_z_mm": slight})
    bent = equilibrium(bowed, group.targets, group.channels[:, None], drives=_whole(group, bowed))
    if bent.unknowns.shape != state.unknowns.shape:
        return state
    again = equilibrium(
        mechanism, group.targets, group.channels[:, None], replace(bent, mechanism=mechanism), drives=inputs
    )
    better = lost & again.converged & (again.unstable == 0)
    return state.with_members(better, again.member(better))


def _begin(
    mechanism: Solvable, group: Group, inputs: dict[str, Array], start: Equilibrium | None
) -> Equilibrium | None:
    """Where to begin: at the start where it fits; with slides, where the linkage without them would be."""
    if start is not None and layout(start.mechanism).drives != layout(mechanism).drives:
        # A model with heat may follow one without: the start is at the inputs of now.
        start = replace(start, drives=drive_values(mechanism, inputs))
    remembers = initial_memory(mechanism).size > 0
    if start is not None and not remembers:
        # A model that remembers nothing may follow one that does.
        start = replace(start, memory=start.memory[..., :0])
    sliding = slides(mechanism)
    if start is not None and start.unknowns.shape[-1] == layout(mechanism).size:
        there = replace(start, mechanism=mechanism)
        return with_slides(start, mechanism) if sliding and not remembers else there
    if not sliding:
        return None
    bare = mechanism.changed(tight(mechanism.view))
    fits = start is not None and start.unknowns.shape[-1] == layout(bare).size
    near = replace(start, mechanism=bare) if start is not None and fits else None
    # Its coordinates have other numbers, by which inputs are named.
    own = _whole(group, bare)
    if not remembers:
        state = equilibrium(bare, group.targets, group.channels[:, None], near, drives=own)
    elif near is not None:
        state = history(bare, group, own, near)
    else:
        return None
    return with_slides(replace(state, drives=drive_values(mechanism, inputs)), mechanism)


def _shifted(group: Group, shift: Array) -> Group:
    """The group with its real steps' inputs shifted by (rows, 7)."""
    whole = np.zeros((*group.rise.shape, INPUTS))
    whole[group.real] = shift
    return replace(group, targets=group.targets + whole[..., :6], rise=group.rise + whole[..., 6])


def _direction(model: Model, number: int, group: Group, load_cases: LoadCases) -> Direction | SensorDirection:
    each = model.free[number]
    parameter = each.parameter
    # Differences stay on the same side of a bound as the value; of one at a bound they are taken beside it.
    value = float(np.clip(model.values[number], *each.bounds))
    room = min(value - parameter.low, parameter.high - value)
    size = min(abs(parameter.typical), room / DIFFERENCES.inside)
    # Differences that reach across a kink are no derivative of either side: few states are so near to one.
    smooth = next(t.effect.smooth for t in model.terms if t.effect.name == each.effect)
    size *= 1.0 if smooth else DIFFERENCES.near_kinks
    gauges = load_cases.campaign.gauges

    @cache
    def moved(other: float) -> Solvable:
        values = model.values
        values[number] = other
        return model.at(values).mechanism(group, gauges)

    # As far as differences go, and no further: bounds are near.
    *_, (change, _) = differences(1, size)
    if model.reads_alone(each, value + change, group, gauges):
        return SensorDirection(lambda other: moved(other).sensors, value, size)
    return Direction(moved, value, size, lambda other: group.standing(moved(other)))
