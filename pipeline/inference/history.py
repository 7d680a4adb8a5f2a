"""Tests step after step, where laws remember: all tests together, the memory and its derivatives handed on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.program import Group
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium, equilibrium, stack
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
    alive, blank = np.arange(tests), initial_memory(mechanism)
    state: Equilibrium | None = None
    slope = np.zeros((tests, 1, len(asked)))
    states, by = [], []
    for step in range(steps):
        before = None if state is None else state.member(alive)
        now = _Step(
            mechanism,
            group.targets[alive, step],
            group.channels[alive],
            {name: value[alive, step] for name, value in inputs.items()},
            np.broadcast_to(blank, (alive.size, blank.size)) if before is None else before.next_memory,
        )
        part = now.solved(before, None if start is None else start.member((alive, step)))
        found = by_parameters(part, asked, memory_slope=slope[alive] if step else 0.0, order=order)
        state = part if state is None else _ended(state).with_members(alive, part)
        by.append(np.zeros((tests, *found.readings.shape[1:])))
        by[-1][alive] = found.readings
        slope = np.zeros((tests, *found.memory.shape[1:]))
        slope[alive] = found.memory
        states.append(state)
        alive = alive[part.converged]
        if not alive.size:
            rest = steps - step - 1
            states += [_ended(state)] * rest
            by += [np.zeros_like(by[-1])] * rest
            break
    return _by_test(stack(states)), np.stack(by, axis=1)


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


def _by_test(state: Equilibrium) -> Equilibrium:
    """A state (steps, tests) as one (tests, steps)."""
    parts = {f.name: getattr(state, f.name) for f in fields(state) if f.name != "mechanism"}
    return replace(state, **{name: np.moveaxis(part, 0, 1) for name, part in parts.items()})
