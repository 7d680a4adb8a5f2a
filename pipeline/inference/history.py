"""Tests whose laws remember: all steps at once as far as that goes, then step after step, the memory handed on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.rig import Solvable
from pipeline.inference.load_cases import Group
from pipeline.inference.settings import HISTORY
from vjm.equilibrium import Equilibrium, equilibrium, nearby
from vjm.mechanism import initial_memory
from vjm.reasons import Reason

Array = NDArray[np.float64]


def history(
    mechanism: Solvable, group: Group, inputs: Mapping[str, Array], start: Equilibrium | None
) -> Equilibrium:
    """States (T, S), each with the memory that the one before it leaves.

    inputs: (T, S) each. start: states (T, S) to begin from. A test ends where a step has no equilibrium: what follows
    depends on a memory that nobody knows.
    """
    tests, steps = group.targets.shape[:2]
    state, known = _all_at_once(mechanism, group, inputs, start)
    alive = np.ones(tests, dtype=bool)
    for step in range(int(known.min()), steps):
        going = np.flatnonzero(alive & (known <= step))
        if not going.size:
            continue
        before = state.member((going, step - 1)) if step else None
        if before is not None:
            state = _kept(mechanism, group, inputs, state, (going, step), before.next_memory)
        left = ~state.converged[going, step] if step else np.ones(going.size, dtype=bool)
        if left.any():
            begin = None if before is None else before.member(left)
            part = _next(mechanism, group, inputs, going[left], step, begin)
            state = state.with_members((going[left], step), part)
        lost = going[~state.converged[going, step]]
        if lost.size:
            rest = (lost[:, None], np.arange(step + 1, steps))
            there = state.member((lost, step)).reshaped(lost.size, 1)
            state = state.with_members(rest, _ended(there))
            alive[lost] = False
    return state


def _kept(
    mechanism: Solvable,
    group: Group,
    inputs: Mapping[str, Array],
    state: Equilibrium,
    some: tuple[NDArray[np.int64], int],
    memory: Array,
) -> Equilibrium:
    """The states with those of one step (N,) as they were, where they had this memory (N, M) already, or solved anew
    from there with it; what needs more has not converged."""
    here = state.member(some)
    size = np.maximum(np.max(np.abs(state.memory), axis=(0, 1)), np.max(np.abs(memory), axis=0))
    new = (
        np.any(np.abs(here.memory - memory) > HISTORY.same * size, axis=-1)
        | ~here.converged
        | (here.unstable > 0)
    )
    if not new.any():
        return state
    tests, step = some[0][new], some[1]
    again = _solved(
        mechanism, group, inputs, here.member(new), memory[new], (tests, np.full(tests.size, step))
    )
    return state.with_members((tests, step), again)


def _all_at_once(
    mechanism: Solvable, group: Group, inputs: Mapping[str, Array], start: Equilibrium | None
) -> tuple[Equilibrium, NDArray[np.int64]]:
    """States (T, S), and how many of the first steps of each test (T,) are the ones looked for.

    All steps are solved with the memory that the start had, or none, then those again to which the step before
    leaves another: few, where laws remember where the load turned back, or nothing at all yet. Without a start
    those that are far from rest are approached in increments, all of them together.
    """
    shape = group.targets.shape[:2]
    blank = initial_memory(mechanism)
    memory = np.broadcast_to(blank, (*shape, blank.size)).copy()
    if start is not None and start.memory.shape == memory.shape:
        memory[:, 1:] = start.memory[:, 1:]
    state = _solved(mechanism, group, inputs, start, memory)
    new = np.ones(shape, dtype=bool)
    for _ in range(HISTORY.rounds):
        memory, new = _handed_on(state, memory, new)
        if not new.any():
            break
        some = np.nonzero(new)
        part = _solved(mechanism, group, inputs, state.member(some), memory[some], some)
        state = state.with_members(some, part)
    good = state.converged & (state.unstable <= 0) & ~new
    return state, np.sum(np.logical_and.accumulate(good, axis=1), axis=1)


def _handed_on(state: Equilibrium, memory: Array, new: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
    """Memory (T, S, M) before each step and a mask (T, S) of the steps to which it is new, where the states of the
    masked steps are new. Of what has not converged nothing is handed on."""
    memory, size = memory.copy(), np.max(np.abs(memory), axis=(0, 1))
    out = np.zeros_like(new)
    while (new := new & state.converged)[:, :-1].any():
        test, step = np.nonzero(new[:, :-1])
        left = replace(state.member((test, step)), memory=memory[test, step]).next_memory
        size = np.maximum(size, np.max(np.abs(left), axis=0))
        other = np.any(np.abs(left - memory[test, step + 1]) > HISTORY.same * size, axis=-1)
        test, step = test[other], step[other] + 1
        memory[test, step] = left[other]
        new = np.zeros_like(new)
        new[test, step] = out[test, step] = True
    return memory, out


def _solved(
    mechanism: Solvable,
    group: Group,
    inputs: Mapping[str, Array],
    start: Equilibrium | None,
    memory: Array,
    some: tuple[NDArray[np.int64], ...] | slice = slice(None),
) -> Equilibrium:
    """Some of the steps by themselves, from the start of each and with its memory."""
    targets, channels = group.targets, np.broadcast_to(group.channels[:, None], group.targets.shape)
    drives = {name: value[some] for name, value in inputs.items()}
    if start is None:
        return equilibrium(mechanism, targets[some], channels[some], limit=HISTORY.patience, drives=drives)
    return nearby(mechanism, targets[some], channels[some], start, drives, memory)


def _next(
    mechanism: Solvable,
    group: Group,
    inputs: Mapping[str, Array],
    tests: NDArray[np.int64],
    step: int,
    before: Equilibrium | None,
) -> Equilibrium:
    """One step of several tests, from the one before as the loading goes."""
    return equilibrium(
        mechanism,
        group.targets[tests, step],
        group.channels[tests],
        before,
        limit=HISTORY.patience,
        drives={name: value[tests, step] for name, value in inputs.items()},
    )


def _ended(state: Equilibrium) -> Equilibrium:
    return replace(
        state,
        converged=np.zeros_like(state.converged),
        reason=np.full(state.reason.shape, Reason.ENDED, dtype=object),
        unstable=np.full_like(state.unstable, -1),
    )
