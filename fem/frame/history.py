"""Load histories: steps in order, each from the equilibrium before, cut in halves where Newton's method needs it."""

from dataclasses import dataclass, replace

import numpy as np

from fem.frame.batch import Bools, Ints, put, take
from fem.frame.control import DISPLACEMENT, FORCE, Targets, displacement, measured, reading
from fem.frame.model import PLATFORM, Model, State, Unloaded, at_rest
from fem.frame.newton import CONVERGED, REASONS, Outcome, equilibrium
from fem.frame.placed import Anchored, held_back
from fem.frame.reference import bowed_axis, reference
from meshes.solid import Floats

FINEST = 1.0 / 64.0
"""Shortest part of a step."""
THROUGH_PLAY = 1.0 / 1024.0
"""The same where hinges have play: a bar of many elements goes through it by some newtons at a time."""
AFTER_FAILURE = "a step before it failed"


@dataclass(frozen=True, eq=False)
class Histories:
    """Prescribed steps: kind (B, 6); value (B, S, 6); temperature (B, S) C; steps (B,): how many count."""

    kind: Ints
    value: Floats
    temperature: Floats
    steps: Ints


@dataclass(frozen=True, eq=False)
class Records:
    """Measured quantities of every step, NaN where there is no equilibrium: displacement (B, S, 6), wrench (B, S, 6)
    read, gauges (B, S, G) mm. converged (B, S); reason (B, S) empty or why not; iterations (B, S), residual (B, S)
    over the allowed out-of-balance; negative (B, S) eigenvalues with the held coordinates fixed, 0: stable. memory
    (B, S, M): memories of placed laws (`placed`)."""

    displacement: Floats
    wrench: Floats
    gauges: Floats
    converged: Bools
    reason: np.ndarray
    iterations: Ints
    residual: Floats
    negative: Ints
    memory: Floats


def unloaded_bars(model: Model, temperature: Floats) -> Unloaded:
    """The bars without load at a temperature (B,)."""
    length = model.warmed(temperature)
    _, triads = bowed_axis(model.bars, length)
    return Unloaded(reference(model.bars, length), triads[:, :, [0, -1]])


def settled(model: Model, mechanism: Bools) -> Outcome:
    """The unloaded linkage as mounted, at its reference temperature, without dead load and without laws of hinges.

    mechanism (B, 6): platform coordinates in which the linkage is a mechanism; there it stands where its last bar as
    built, at the angle as drawn, brings the platform.
    """
    joints = replace(
        model.joints,
        return_spring=np.zeros_like(model.joints.return_spring),
        torque=np.zeros_like(model.joints.torque),
        placed=tuple(it for it in model.joints.placed if not it.of_hinge),
    )
    # Newton's method may pass through strains that no fibre sees.
    free = replace(model, joints=joints, fibres=None)
    nominal = np.repeat(np.linalg.norm(model.nominal, axis=1)[:, None], model.length.shape[1], axis=1)
    x, triads = bowed_axis(model.bars, nominal)
    start = at_rest(model, x, triads)
    kind = np.where(mechanism, DISPLACEMENT, FORCE)
    value = np.where(mechanism, displacement(model, _as_long_as_built(model, start)), 0.0)
    unloaded = unloaded_bars(model, model.reference_temperature)
    zero = np.zeros(model.gauges.station.shape)
    return equilibrium(free, unloaded, start, Targets(kind, value), np.zeros(len(value)), zero)


def _as_long_as_built(model: Model, start: State) -> State:
    """The state as mounted with the platform at the end of the last bar's own length."""
    bodies = start.X.copy()
    bodies[:, PLATFORM] *= (model.length[:, -1] / np.linalg.norm(model.nominal, axis=1))[:, None]
    return replace(start, X=bodies)


def relaxed(model: Model, state: State) -> tuple[Model, State]:
    """The linkage with return springs, friction and laws of its hinges at rest in this state, placed laws as new."""
    turns = np.zeros_like(state.slider)
    if "hinge" in model.joints.slots:
        turns = state.q[..., model.joints.slots.index("hinge")]
    return replace(model, joints=replace(model.joints, relaxed=turns)), replace(
        state, slider=turns, memory=np.zeros_like(state.memory)
    )


@dataclass(frozen=True, eq=False)
class _Here:
    """Where each test stands: its state, gauge coordinates, temperature and share of the dead loads."""

    state: State
    gauge: Floats
    temperature: Floats
    dead: Floats
    negative: Ints


def run(model: Model, histories: Histories, mechanism: Bools) -> Records:
    """Follow every history from its settled, unloaded state, in which the hinges carry nothing; mechanism (B, 6) as for
    `settled`."""
    first = settled(model, mechanism)
    count, steps = histories.temperature.shape
    zero = first.gauge
    records = _empty(count, steps, zero.shape[-1], first.state.memory.shape[-1])
    failed = first.code != CONVERGED
    reasons = np.array([f"unloaded state: {REASONS[int(c)]}" if c else "" for c in first.code], object)
    still = np.zeros(count)
    model, state = relaxed(model, first.state)
    here = _Here(state, first.gauge, model.reference_temperature.copy(), still, first.negative)
    for step in range(steps):
        going = np.flatnonzero(~failed & (step < histories.steps))
        records.reason[failed, step] = reasons[failed]
        if len(going):
            part, codes, effort = _step(take((model, here, histories, zero), going), step)
            here = put(here, going, part)
            _record(records, going, step, take(model, going), part, zero[going], codes, effort)
            failed[going] = codes != CONVERGED
            reasons[going] = AFTER_FAILURE
    return records


def _step(
    parts: tuple[Model, _Here, Histories, Floats], step: int
) -> tuple[_Here, Ints, tuple[Ints, Floats]]:
    """One step of some tests, in parts of its length where needed: where they stand then, codes and effort."""
    model, here, histories, zero = parts
    kind = histories.kind
    goal = histories.value[:, step]
    warm = histories.temperature[:, step]
    from_value = measured(model, here.state, here.gauge - zero, kind)
    from_warm, from_dead = here.temperature, here.dead
    count, begun = len(goal), here.state.memory
    done, size = np.zeros(count), np.ones(count)
    codes = np.full(count, CONVERGED)
    iterations, residual = np.zeros(count, int), np.zeros(count)
    laws = model.joints.placed
    plays = np.any(model.joints.play.reshape(count, -1) > 0.0, axis=1) | any(
        it.placed.law.abrupt for it in laws
    )
    shortest = np.where(plays, THROUGH_PLAY, FINEST)
    while True:
        going = np.flatnonzero((done < 1.0) & (codes == CONVERGED))
        if not len(going):
            return here, codes, (iterations, residual)
        to = np.minimum(done + size, 1.0)
        share = to[:, None]
        value = np.where(share == 1.0, goal, from_value + share * (goal - from_value))
        temperature = from_warm + to * (warm - from_warm)
        dead = from_dead + to * (1.0 - from_dead)
        some = take((model, here, Targets(kind, value), temperature, dead, zero), going)
        outcome = equilibrium(
            some[0], unloaded_bars(some[0], some[3]), some[1].state, some[2], some[4], some[5]
        )
        iterations[going] += outcome.iterations
        residual[going] = outcome.residual
        finest = size[going] <= shortest[going]
        lost_stability = (outcome.negative > 0) & (some[1].negative == 0) & ~finest
        good = (outcome.code == CONVERGED) & ~lost_stability
        accepted = np.flatnonzero(good)
        new = _Here(
            _within_step(laws, outcome.state, to[going], begun[going]),
            outcome.gauge,
            some[3],
            some[4],
            outcome.negative,
        )
        here = put(here, going[accepted], take(new, accepted))
        done[going[accepted]] = to[going[accepted]]
        size[going[accepted]] *= 2.0
        poor = np.flatnonzero(~good)
        codes[going[poor[finest[poor]]]] = outcome.code[poor[finest[poor]]]
        size[going[poor]] /= 2.0


def _within_step(laws: tuple[Anchored, ...], state: State, to: Floats, begun: Floats) -> State:
    """The state at the share `to` (B,) of a load step: memories that wait for its end are those it began with."""
    if not laws:
        return state
    waiting = held_back(laws, state.memory, begun)
    return replace(state, memory=np.where(to[:, None] < 1.0, waiting, state.memory))


def _empty(count: int, steps: int, gauges: int, memory: int) -> Records:
    nan = np.full((count, steps), np.nan)
    return Records(
        np.full((count, steps, 6), np.nan),
        np.full((count, steps, 6), np.nan),
        np.full((count, steps, gauges), np.nan),
        np.zeros((count, steps), bool),
        np.full((count, steps), "", object),
        np.zeros((count, steps), int),
        nan,
        np.zeros((count, steps), int),
        np.full((count, steps, memory), np.nan),
    )


def _record(
    records: Records,
    going: Ints,
    step: int,
    model: Model,
    here: _Here,
    zero: Floats,
    codes: Ints,
    effort: tuple[Ints, Floats],
) -> None:
    """Write one step of some tests into the records."""
    good = codes == CONVERGED
    at = going[good]
    records.displacement[at, step] = displacement(model, here.state)[good]
    records.wrench[at, step] = reading(model, here.state)[good]
    records.gauges[at, step] = (here.gauge - zero)[good]
    records.negative[at, step] = here.negative[good]
    records.memory[at, step] = here.state.memory[good]
    records.converged[going, step] = good
    records.reason[going, step] = [REASONS[int(code)] for code in codes]
    records.iterations[going, step], records.residual[going, step] = effort
