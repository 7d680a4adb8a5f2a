"""Derivatives along histories: found for all steps at once, they are those of steps that hand on their memory."""

from __future__ import annotations

from functools import reduce

import numpy as np
import pytest

from tests.vjm.effects.bench import NOISE, PARALLELOGRAM, run, with_values
from vjm.effects import catalogue
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium, stack
from vjm.frames import Array
from vjm.history import by_history
from vjm.sensitivity import TARGETS, Direction, by_parameters

HIDDEN = {
    "friction": {"joint_friction": {"torque_Nmm": 50.0}},
    "yield": {"material_yield": {}},
    "both": {"joint_friction": {"torque_Nmm": 50.0}, "material_yield": {}},
}


def rig_with(names: dict[str, dict[str, float]], rig: Rig = PARALLELOGRAM) -> Rig:
    return reduce(lambda it, name: with_values(name, it, names[name]), names, rig)


def directions(names: dict[str, dict[str, float]]) -> list[Direction]:
    """By every number of the effects."""

    def moved(name: str, key: str) -> Direction:
        value = {**catalogue()[name].typicals, **names[name]}[key]
        return Direction(
            lambda p: rig_with({**names, name: {**names[name], key: p}}), value, 1e-3 * abs(value)
        )

    return [moved(name, p.name) for name in names for p in catalogue()[name].parameters]


def histories(states: list[Equilibrium]) -> Equilibrium:
    """(T, S) from S steps of T trials."""
    steps, trials = len(states), states[0].converged.size
    order = np.arange(steps * trials).reshape(steps, trials).T
    return stack(states).reshaped(steps * trials).member(order)


@pytest.mark.parametrize("hidden", HIDDEN)
def test_all_steps_at_once_are_step_after_step(hidden: str) -> None:
    names = HIDDEN[hidden]
    asked = directions(names)
    one_by_one = run(rig_with(names), asked)
    state = histories(one_by_one.states)
    expected = np.moveaxis(one_by_one.slopes, 0, 1)
    whole = by_history(state, [*TARGETS, *asked])
    found = whole.readings
    scale = np.array([abs(d.value) for d in asked]) / NOISE[:, None]
    np.testing.assert_allclose(found[..., 6:] * scale, expected * scale, rtol=1e-6, atol=1e-5)
    np.testing.assert_allclose(found[..., :6], by_parameters(state, TARGETS).readings, rtol=1e-9, atol=1e-9)
    # A pose is read as it is; differences of readings have the rounding of a bar's length, 1.2e-5 of its noise.
    moved = whole.pose[..., 6:] * scale[:6]
    np.testing.assert_allclose(moved, found[..., :6, 6:] * scale[:6], rtol=1e-6, atol=3e-5)
    # What earlier steps left counts: without it the last step's derivatives are others.
    alone = by_parameters(state, asked).readings
    assert np.max(np.abs((alone - found[..., 6:]) * scale)[:, -1]) > 0.1


def test_without_marks_no_step_counts_for_another() -> None:
    """A yield strain that no fibre reaches."""
    names = {"material_yield": {"strain": 0.0199}}
    state = histories(run(rig_with(names), directions(names)).states)
    every: Array = by_history(state, [*TARGETS, *directions(names)]).readings
    np.testing.assert_array_equal(every, by_parameters(state, [*TARGETS, *directions(names)]).readings)


def test_few_forces_are_solved_with_what_is_asked_and_many_by_themselves() -> None:
    """The same derivatives, whether the asked ones are fewer than the coordinates of the laws or not."""
    names = HIDDEN["friction"]
    asked = directions(names)
    state = histories(run(rig_with(names), asked).states)
    few = by_history(state, asked[:1]).readings
    many = by_history(state, [*TARGETS, *asked]).readings[..., 6:7]
    np.testing.assert_allclose(few, many, rtol=1e-9, atol=1e-12 * np.abs(many).max())


def test_of_what_remembers_nothing_each_step_is_by_itself() -> None:
    names = {"modulus_error": {}}
    asked = directions(names)
    state = histories(run(rig_with(names), asked).states)
    np.testing.assert_array_equal(by_history(state, asked).readings, by_parameters(state, asked).readings)
