"""Faults of sensors in what a model predicts: read as a faulty sensor reads it, prescribed as it was read.

A fault adds e(y) to a reading y. Of a column that is predicted, the prediction becomes y + e(y). Of one that controls
a coordinate, what was really done is the y that makes y + e(y) the reading, which acts through the mechanism. Faults
are small: how they change the derivatives by everything else is left out, but where a reading stands still.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import SUPPORT
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, Term
from pipeline.inference.predicted import Prediction
from pipeline.inference.settings import DIFFERENCES
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault

Array = NDArray[np.float64]


def faults(model: Model) -> list[Term]:
    """Terms that are faults of sensors, gains that are known to a tolerance among them."""
    every = (*model.nominals, *model.terms)
    return [term for term in every if isinstance(term.effect, SensorFault)]


def in_mechanism(model: Model) -> list[int]:
    """Numbers of the free parameters that are not those of a sensor's fault."""
    names = {term.effect.name for term in faults(model)}
    return [number for number, each in enumerate(model.free) if each.effect not in names]


def moves(effect: Effect, load_cases: LoadCases) -> bool:
    """Whether the linkage stands otherwise with an effect: not with the fault of a sensor that controls nothing."""
    if not isinstance(effect, SensorFault):
        return True
    return bool(np.any(load_cases.channels == load_cases.rows.columns.index(effect.column)))


def inputs_off(model: Model, load_cases: LoadCases) -> Array:
    """(R, 7) by which what was really prescribed differs from what was read of it."""
    out = np.zeros((len(load_cases.test), 7))
    for term in faults(model):
        rows, coordinates = _controlled(load_cases, term)
        if rows.size:
            noise = np.zeros(len(out))
            noise[rows] = load_cases.input_sigma[rows, coordinates]
            read = moved(_fault(term), np.nan_to_num(load_cases.measured), load_cases, noise)
            out[rows, coordinates] -= _error_of_input(term, read, load_cases)[rows]
    return out


def faulted(model: Model, load_cases: LoadCases, found: Prediction) -> Prediction:
    """A prediction as faulty sensors read it; the prediction is of what was really prescribed."""
    terms = faults(model)
    if not terms:
        return found
    every = _as_read(load_cases, found)
    values, by_free, by_inputs = found.values.copy(), found.by_free.copy(), found.by_inputs.copy()
    for term in terms:
        channel = _channel(load_cases, term)
        read = moved(_fault(term), every, load_cases, noise_of(found, channel, load_cases))
        rows, coordinates = _controlled(load_cases, term)
        free = np.ones(len(values), dtype=bool)
        free[rows] = False
        values[free, channel] += _error(term, read, load_cases)[free]
        still, last = _still(term, read, load_cases, free)
        by_inputs[still, channel] = 0.0
        by_free[still, channel] = by_free[last, channel]
        for number, column, done in _slopes(term, read, load_cases, model) if by_free.shape[-1] else ():
            by_free[..., number] = 0.0
            by_free[free, channel, number] = column[free]
            through = found.by_inputs[rows, :, coordinates] * done[rows][:, None]
            by_free[rows, :, number] -= through
    lost = found.lost
    for part, before in ((values, found.values), (by_free, found.by_free), (by_inputs, found.by_inputs)):
        part[lost] = before[lost]
    return replace(found, values=values, by_free=by_free, by_inputs=by_inputs)


def _fault(term: Term) -> SensorFault:
    assert isinstance(term.effect, SensorFault)
    return term.effect


def _channel(load_cases: LoadCases, term: Term) -> int:
    return load_cases.rows.columns.index(_fault(term).column)


def _controlled(load_cases: LoadCases, term: Term) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows in which the sensor of a fault controls a coordinate, and which."""
    held = np.array([[by == SUPPORT for by in test.control] for test in load_cases.campaign.tests])[
        load_cases.test
    ]
    # What a support holds is where it is, whatever a sensor says.
    return np.nonzero((load_cases.channels == _channel(load_cases, term)) & ~held)  # type: ignore[return-value]


def _as_read(load_cases: LoadCases, found: Prediction) -> Array:
    """(R, C) what is there: predicted, and prescribed where it is that."""
    out = found.values.copy()
    given = np.take_along_axis(np.nan_to_num(load_cases.measured), load_cases.channels, axis=1)
    np.put_along_axis(out, load_cases.channels, given + found.shift[:, :6], axis=1)
    return out


def noise_of(found: Prediction, channel: int, load_cases: LoadCases) -> Array:
    """(R,) what the noise of the inputs does to a predicted channel."""
    return np.asarray(np.linalg.norm(found.by_inputs[:, channel] * load_cases.input_sigma, axis=-1))


def moved(fault: SensorFault, read: Array, load_cases: LoadCases, noise: Array) -> Array:
    """Readings (R, C) of which the column of a fault with a history stands still in each test until it has moved beyond
    its noise (R,): which way it goes is not told by that."""
    if not fault.history:
        return read
    out = read.copy()
    column = out[:, load_cases.rows.columns.index(fault.column)]
    for first, end in pairwise(load_cases.first.tolist()):
        if _stands(column[first:end], noise[first:end]):
            column[first:end] = column[first]
        for row in range(first + 1, end):
            if abs(column[row] - column[row - 1]) < DIFFERENCES.fault_motion * noise[row]:
                column[row] = column[row - 1]
    return out


def _stands(readings: Array, noise: Array) -> bool:
    """Whether readings (n,) of a test have no order and scatter little more than their noise (n,)."""
    away = readings - readings.mean()
    square = float(away @ away)
    still = square <= (DIFFERENCES.fault_still**2) * float(noise @ noise)
    return still and float(np.sum(np.diff(readings) ** 2)) >= DIFFERENCES.order * square


def _error(term: Term, read: Array, load_cases: LoadCases) -> Array:
    return _fault(term).error(read, load_cases.rows, term.values)


def _still(
    term: Term, read: Array, load_cases: LoadCases, free: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows that are free to be read and in which the sensor of a fault stands still though there is a motion, and the
    rows that moved it last.

    Such a reading answers to nothing of its own step, and to the model as in the step that moved it."""
    last = _fault(term).follows(read, load_cases.rows, term.values)
    moves = np.diff(read[:, _channel(load_cases, term)], prepend=np.nan) != 0.0
    still = np.flatnonzero((last != np.arange(len(last))) & moves & free)
    return still, last[still]


def _error_of_input(term: Term, read: Array, load_cases: LoadCases) -> Array:
    """(R,) what its column read too much where it controls a coordinate."""
    done, channel = read.copy(), _channel(load_cases, term)
    for _ in range(DIFFERENCES.fault_turns):
        done[:, channel] = read[:, channel] - _error(term, done, load_cases)
    return np.asarray(read[:, channel] - done[:, channel])


def _slopes(
    term: Term, read: Array, load_cases: LoadCases, model: Model
) -> Iterator[tuple[int, Array, Array]]:
    """Number of each free parameter of a fault, and (R,) derivatives by it: of its error where it is only read, and
    where it controls a coordinate. read: without the noise of what was prescribed, which a slope would follow."""
    for number, each in enumerate(model.free):
        if each.effect != term.effect.name:
            continue
        size, name = DIFFERENCES.fault_step * abs(each.parameter.typical), each.parameter.name
        ends = [
            replace(term, values={**term.values, name: term.values[name] + step}) for step in (-size, size)
        ]
        low, high = (_error(end, read, load_cases) for end in ends)
        less, more = (_error_of_input(end, read, load_cases) for end in ends)
        yield number, (high - low) / (2.0 * size), (more - less) / (2.0 * size)
