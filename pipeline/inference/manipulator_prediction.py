"""What a model predicts for the tests of a whole manipulator at one posture, with derivatives.

Derivatives by what is prescribed are those of the equilibrium; those by numbers of the model and by the temperature
are differences of two solutions that start from it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import COORDINATES
from pipeline.inference.manipulator_states import States
from pipeline.inference.model import Model
from pipeline.inference.program import INPUTS, Group
from pipeline.inference.rigs import manipulator_of
from vjm.effects.thermal_expansion import DRIVE
from vjm.manipulator.assembled import relaxed, settled
from vjm.manipulator.equilibrium import Loaded, equilibrium, unstable_directions
from vjm.manipulator.lagrangian import System, system
from vjm.manipulator.loops import looped
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures, postures
from vjm.manipulator.sensitivity import readings_along, unknowns_by_targets
from vjm.stops import pressed, slid

Array = NDArray[np.float64]
STEP = 1e-3
"""Of its typical size, over which a number is differentiated: within a share of 1e-6 of smooth effects."""
_KELVIN = 0.1
TOGETHER = 64
"""Steps that are solved at once: with refined bars some 50 MB for each of the ten arrays that a solution holds."""


@dataclass(frozen=True, eq=False)
class ManipulatorPart:
    """One group's share, arrays (T, S, ...): readings less the nominal pose, derivatives, the states, stops and
    slides as in `pipeline.inference.prediction.Prediction`."""

    values: Array
    by_inputs: Array
    by_free: Array
    state: States
    stops: Array
    slides: Array


def predict_manipulator(
    model: Model, group: Group, slopes: bool = True, start: States | None = None
) -> ManipulatorPart:
    """Readings (T, S, 12) of all steps of a group; without slopes none by numbers of the model.

    start: states of a like model. ValueError for an effect that the manipulator cannot have.
    """
    whole = _whole(model, group)
    found = _solve(whole, group, group.rise, start)
    states = found.states
    values = found.readings - np.pad(group.nominal, ((0, 0), (0, 0), (0, 6)))
    by_inputs = np.zeros((*values.shape, INPUTS))
    by_inputs[..., :6], stops, slides = found.slopes
    by_inputs[..., 6] = _by_heat(whole, group, states)
    count = len(model.free) if slopes else 0
    by_free = np.zeros((*values.shape, count))
    for number in range(count):
        by_free[..., number] = _by_number(model, number, group, states)
    return ManipulatorPart(values, by_inputs, by_free, states, stops, slides)


def _whole(model: Model, group: Group) -> Manipulator:
    return manipulator_of(group.rig, model.mechanism(group.rig, ()))


@dataclass(frozen=True, eq=False)
class _Piece:
    """Equilibria that were found together: of which tests and steps (M,), under which control."""

    loaded: Loaded
    held: tuple[str, ...]
    place: tuple[np.ndarray, np.ndarray]

    def converged(self) -> tuple[Loaded, tuple[np.ndarray, np.ndarray]]:
        """Those that are equilibria, and their place."""
        good = np.flatnonzero(self.loaded.converged)
        part = replace(self.loaded, system=self.loaded.system.take(good), unknowns=self.loaded.unknowns[good])
        return part, (self.place[0][good], self.place[1][good])


@dataclass(frozen=True, eq=False)
class _Solved:
    """Equilibria (T, S) of a group."""

    shape: tuple[int, int]
    pieces: list[_Piece]

    @property
    def readings(self) -> Array:
        """(T, S, 12)."""
        out = np.zeros((*self.shape, 12))
        for piece in self.pieces:
            out[piece.place] = piece.loaded.readings
        return out

    @property
    def slopes(self) -> tuple[Array, Array, Array]:
        """(T, S, 12, 6) derivative of the readings by the targets, (T, S, K, 8) how hard stops are pressed and
        (T, S, K, 9) where the slides are; zero where there is no equilibrium."""
        tangent = np.zeros((*self.shape, 12, 6))
        stops, slides = (np.zeros((*self.shape, 0, count + INPUTS)) for count in (1, 2))
        for piece in self.pieces:
            part, place = piece.converged()
            if not len(part.unknowns):
                continue
            change = unknowns_by_targets(part, piece.held)
            tangent[place] = readings_along(part, change)
            force, pressing = pressed(part, change)
            strain, half, sliding = slid(part, change)
            if stops.shape[2] != force.shape[1]:
                stops, slides = (np.zeros((*self.shape, force.shape[1], n + INPUTS)) for n in (1, 2))
            cold, width = np.zeros((*force.shape, 1)), np.broadcast_to(half, force.shape)[..., None]
            stops[place] = np.concatenate([force[..., None], pressing, cold], axis=-1)
            slides[place] = np.concatenate([strain[..., None], width, sliding, cold], axis=-1)
        return tangent, stops, slides

    @property
    def states(self) -> States:
        """(T, S)."""
        size = self.pieces[0].loaded.system.size
        converged, unstable = np.zeros(self.shape, dtype=bool), np.full(self.shape, -1)
        unknowns, reason = np.zeros((*self.shape, size)), np.full(self.shape, "", dtype=object)
        for piece in self.pieces:
            unknowns[piece.place], reason[piece.place] = piece.loaded.unknowns, piece.loaded.reason
            converged[piece.place] = piece.loaded.converged
            part, place = piece.converged()
            if len(part.unknowns):
                unstable[place] = unstable_directions(part, piece.held)
        return States(unknowns, converged, unstable, reason)


def _solve(whole: Manipulator, group: Group, rise: Array, start: States | None) -> _Solved:
    """Tests of one control together: all steps at once, or one after the other where laws remember."""
    pieces: list[_Piece] = []
    remembers = any(looped(leg).initial_memory.size for leg in whole.legs)
    turns = settled(whole, _posture(group))
    for channels in np.unique(group.channels, axis=0):
        tests = np.flatnonzero(np.all(group.channels == channels, axis=1))
        held = tuple(name for name, channel in zip(COORDINATES, channels, strict=True) if channel < 6)
        steps = np.arange(rise.shape[1])
        if remembers:
            pieces += _history(whole, turns, group, rise, tests, held, start)
        else:
            every = np.repeat(tests, steps.size), np.tile(steps, tests.size)
            for first in range(0, every[0].size, TOGETHER):
                place = every[0][first : first + TOGETHER], every[1][first : first + TOGETHER]
                of = _system(whole, turns, group, rise[place])
                pieces.append(_piece(of, group, place, held, start))
    return _Solved((rise.shape[0], rise.shape[1]), pieces)


def _posture(group: Group) -> Postures:
    """The one posture (1,) of a group."""
    assert group.rig.manipulator is not None
    return postures(group.rig.manipulator, group.nominal[0, :1])


def _system(whole: Manipulator, turns: tuple[Array, ...], group: Group, rise: Array) -> System:
    """One posture for all; rise: (M,). turns: of its hinges where they are relaxed, per leg (1, N)."""
    at = _posture(group)
    many = Postures(
        np.tile(at.pose, (rise.size, 1)),
        tuple(np.tile(x, (rise.size, 1)) for x in at.coordinates),
        np.full(rise.size, at.reached[0]),
        np.full(rise.size, at.reason[0], dtype=object),
    )
    return relaxed(system(whole, many, {DRIVE: rise}), turns)


def _piece(
    of: System,
    group: Group,
    place: tuple[np.ndarray, np.ndarray],
    held: tuple[str, ...],
    start: States | None,
    before: Loaded | None = None,
) -> _Piece:
    """start: states of all steps to begin from; else `before`, or without load."""
    first = before
    if start is not None and start.unknowns.shape[-1] == of.size:
        first = _begin(of, start.unknowns[place])
    return _Piece(equilibrium(of, group.targets[place], held, start=first), held, place)


def _begin(of: System, unknowns: Array) -> Loaded:
    count = len(unknowns)
    none, said = np.zeros(count), np.full(count, "", dtype=object)
    return Loaded(of, unknowns, none.astype(int), none, np.ones(count, dtype=bool), said)


def _history(
    whole: Manipulator,
    turns: tuple[Array, ...],
    group: Group,
    rise: Array,
    tests: np.ndarray,
    held: tuple[str, ...],
    start: States | None,
) -> list[_Piece]:
    """Step after step, what the laws remember handed on."""
    out: list[_Piece] = []
    for step in range(rise.shape[1]):
        place = tests, np.full(tests.size, step)
        of = _system(whole, turns, group, rise[place])
        before = out[-1].loaded if out else None
        if before is not None:
            of = replace(of, memory=before.system.after(before.unknowns).memory)
        out.append(_piece(of, group, place, held, start, before))
    return out


def _by_heat(whole: Manipulator, group: Group, start: States) -> Array | float:
    """(T, S, 12) derivative by the temperature; zero where nothing grows with it."""
    if not any(looped(leg).inputs for leg in whole.legs):
        return 0.0
    ends = [_solve(whole, group, group.rise + side, start).readings for side in (_KELVIN, -_KELVIN)]
    return np.asarray((ends[0] - ends[1]) / (2.0 * _KELVIN))


def _by_number(model: Model, number: int, group: Group, start: States) -> Array:
    """(T, S, 12) derivative by one number of the model."""
    parameter = model.free[number].parameter
    # Of a number at its bound the differences are taken beside it.
    value = float(np.clip(model.values[number], *model.free[number].bounds))
    room = min(value - parameter.low, parameter.high - value)
    step = min(STEP * abs(parameter.typical), room)
    ends = []
    for side in (1.0, -1.0):
        values = model.values
        values[number] = value + side * step
        ends.append(_solve(_whole(model.at(values), group), group, group.rise, start).readings)
    return np.asarray((ends[0] - ends[1]) / (2.0 * step))
