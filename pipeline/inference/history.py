"""Tests step after step, where laws remember: all tests together, the memory and its derivatives handed on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.program import Group
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.mechanism import initial_memory
from vjm.sensitivity import AnyDirection, by_parameters

Array = NDArray[np.float64]
ENDED = "an earlier step of the test has no equilibrium, so what the laws remember is not known"


def history(
    mechanism: Rig,
    group: Group,
    inputs: Mapping[str, Array],
    asked: Sequence[AnyDirection],
    start: Equilibrium | None,
    order: int,
) -> tuple[Equilibrium, Array]:
    """States (T, S) and derivatives (T, S, C, k) of their readings in the directions asked for.

    inputs: (T, S) each. start: states (T, S) to begin from. order: see `by_parameters`. A test ends where a step has
    no equilibrium: what follows depends on a memory that nobody knows.
    """
    tests, steps = group.targets.shape[:2]
    state, blank = _as_if_new(mechanism, group, inputs, start)
    by = np.zeros((*state.readings.shape, len(asked)))
    if asked and blank.any():
        by[blank] = by_parameters(state.member(blank), asked, order=order).readings
    begins = np.sum(blank, axis=1)
    slope = np.zeros((tests, state.memory.shape[-1], len(asked)))
    alive = np.ones(tests, dtype=bool)
    for step in range(int(begins.min()), steps):
        going = np.flatnonzero(alive & (begins <= step))
        if not going.size:
            continue
        if step:
            before = state.member((going, step - 1))
            guess = None if start is None else start.member((going, step))
            part = _step(mechanism, group, inputs, going, step, before).solved(before, guess)
        else:
            part = state.member((going, 0))
        state = state.with_members((going, step), part)
        if asked:
            found = by_parameters(part, asked, memory_slope=slope[going], order=order)
            by[going, step] = found.readings
            slope[going] = found.memory
        lost = going[~part.converged]
        if lost.size:
            rest = (lost[:, None], np.arange(step + 1, steps))
            there = state.member((lost, step)).reshaped(lost.size, 1)
            state = state.with_members(rest, _ended(there))
            alive[lost] = False
    return state, by


def _as_if_new(
    mechanism: Rig, group: Group, inputs: Mapping[str, Array], start: Equilibrium | None
) -> tuple[Equilibrium, NDArray[np.bool_]]:
    """States (T, S) without anything to remember, and a mask of the first steps of each test that leave nothing.

    Those need not wait for each other: bars that may yield do not as long as loads are small. Each time as many steps
    are tried as there are already, of the tests that nothing has marked so far; the others hold what they held.
    """
    tests, steps = group.targets.shape[:2]
    everyone = np.arange(tests)
    guess = None if start is None else start.member((everyone, 0))
    first = _step(mechanism, group, inputs, everyone, 0, None).solved(None, guess)
    state = first.reshaped(tests, 1).member((slice(None), np.zeros(steps, dtype=int)))
    blank = np.zeros((tests, steps), dtype=bool)
    blank[:, 0] = _blank(first)
    likely = np.ones_like(blank)
    if start is not None and start.memory.shape == state.memory.shape:
        likely = _blank(start)
    ahead = 1
    while ahead < steps:
        now = np.arange(ahead, min(2 * ahead + 1, steps))
        going = np.flatnonzero(blank[:, ahead - 1] & likely[:, now].all(axis=1))
        if not going.size:
            break
        rows = (going[:, None], now)
        part = equilibrium(
            mechanism,
            group.targets[rows],
            group.channels[going][:, None],
            state.member((going, ahead - 1)).reshaped(going.size, 1) if start is None else start.member(rows),
            drives={name: value[rows] for name, value in inputs.items()},
            memory=state.memory[rows],
        )
        state = state.with_members(rows, part)
        blank[rows] = np.logical_and.accumulate(_blank(part), axis=1)
        ahead = int(now[-1]) + 1
    return state, blank


def _blank(state: Equilibrium) -> NDArray[np.bool_]:
    """(...) stable states that leave in the memory what was there."""
    return state.converged & (state.unstable <= 0) & np.all(state.next_memory == state.memory, axis=-1)


def _step(
    mechanism: Rig,
    group: Group,
    inputs: Mapping[str, Array],
    tests: NDArray[np.int64],
    step: int,
    before: Equilibrium | None,
) -> _Step:
    blank = initial_memory(mechanism)
    return _Step(
        mechanism,
        group.targets[tests, step],
        group.channels[tests],
        {name: value[tests, step] for name, value in inputs.items()},
        np.broadcast_to(blank, (tests.size, blank.size)) if before is None else before.next_memory,
    )


@dataclass(frozen=True, eq=False)
class _Step:
    """One step of several tests. inputs: (t,) each. memory: (t, M)."""

    mechanism: Rig
    targets: Array
    channels: NDArray[np.int64]
    inputs: Mapping[str, Array]
    memory: Array

    def solved(self, before: Equilibrium | None, guess: Equilibrium | None) -> Equilibrium:
        """From the guess, and where that leads nowhere from the step before."""
        state = self._from(before if guess is None else guess, np.arange(len(self.targets)))
        lost = np.flatnonzero(~state.converged)
        if guess is None or not lost.size:
            return state
        again = self._from(None if before is None else before.member(lost), lost)
        return state.with_members(lost, again)

    def _from(self, start: Equilibrium | None, some: np.ndarray) -> Equilibrium:
        return equilibrium(
            self.mechanism,
            self.targets[some],
            self.channels[some],
            start,
            drives={name: value[some] for name, value in self.inputs.items()},
            memory=self.memory[some],
        )


def _ended(state: Equilibrium) -> Equilibrium:
    return replace(
        state,
        converged=np.zeros_like(state.converged),
        reason=np.full(state.reason.shape, ENDED, dtype=object),
        unstable=np.full_like(state.unstable, -1),
    )
