"""Hinges of whole manipulators are relaxed where the unloaded machine has them, bars of other lengths included."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.manipulator.example import LENGTH, POINTS, WIDTH, orthoglide, pair, under
from vjm import paper
from vjm.effects import catalogue
from vjm.effects.base import Rig
from vjm.equilibrium import equilibrium
from vjm.frames import Array
from vjm.manipulator.assembled import settled
from vjm.manipulator.effects import with_effect
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.mechanism import initial_memory
from vjm.mechanisms import parallelogram as chains
from vjm.parts import Leg
from vjm.sensors import TrueMoment

EFFECTS = catalogue()
VALUES = {
    "bar_length_mismatch": {"mismatch_mm": 0.08},
    "joint_friction": {"torque_Nmm": 250.0, "presliding_rad": 2e-4},
    "joint_torsional_stiffness": {"stiffness_Nmm_per_rad": 2e4},
}
HELD = ("x", "z", "rx", "ry", "rz")
NAMES = ("bar_length_mismatch", "joint_torsional_stiffness")


def changed(whole: Manipulator, *names: str) -> Manipulator:
    for name in names:
        whole = with_effect(whole, EFFECTS[name], VALUES[name])
    return whole


def test_one_parallelogram_is_relaxed_as_on_the_bench() -> None:
    q = np.radians(20.0)
    plain = chains.Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q, sensors=(TrueMoment(),))
    theirs: Rig = plain
    for name, values in VALUES.items():
        theirs = EFFECTS[name].apply(theirs, values)
    part = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS)
    one = Manipulator("one", (Leg("one", (part,)),), LENGTH, sensors=(TrueMoment(),))
    ours = changed(one, *VALUES)
    at = postures(one, plain.unloaded_pose[None])
    memory, start, other = initial_memory(theirs), None, None
    for step in (1.0, 2.0, 0.5):
        target = replace(plain, q=q + 0.005 * step).unloaded_pose + step * np.array(
            [-0.02, 0, 0, 0.002, 1e-4, 0]
        )
        target[1] = 60.0 * step
        expected = equilibrium(theirs, target, HELD, start=other, memory=memory)
        found = under(ours, at, target, HELD, start=start)
        assert found.converged.all() and expected.converged
        scale = np.array([1.0, 1.0, 1.0, 0.01, 0.01, 0.01, 100.0, 100.0, 100.0, 1e4, 1e4, 1e4])
        np.testing.assert_allclose(found.readings[0] / scale, expected.readings / scale, atol=1e-8)
        memory, other, start = expected.next_memory, expected, found


def unloaded(whole: Manipulator, points: Array, drawn: Manipulator) -> Array:
    """(B, 6) platform without load."""
    state = under(whole, postures(drawn, points), np.zeros(6))
    assert state.converged.all()
    return state.pose


@pytest.mark.parametrize("name", ["bar_length_mismatch", "dimension_error"])
def test_hinge_springs_do_not_move_the_unloaded_machine(name: str) -> None:
    """Nor anything else that they would do as drawn: bars of other lengths turn all hinges of the machine."""
    drawn = orthoglide(pair())
    longer = with_effect(drawn, EFFECTS[name], {**EFFECTS[name].nulls, "mismatch_mm": 0.08, "length_mm": 0.3})
    stiff = with_effect(longer, EFFECTS[NAMES[1]], {"stiffness_Nmm_per_rad": 1e6})
    plain, sprung = (unloaded(whole, POINTS[:3], drawn) for whole in (longer, stiff))
    np.testing.assert_allclose(sprung, plain, atol=1e-9)
    inputs = posture_inputs(postures(drawn, POINTS[:3]))
    as_drawn = equilibrium(machine(stiff), np.zeros(6), (), drives=inputs).pose
    assert np.max(np.abs(as_drawn - plain)) > 1e-4


def test_nothing_is_turned_where_bars_are_as_drawn() -> None:
    drawn = orthoglide(pair())
    whole = changed(drawn, "joint_friction", "joint_torsional_stiffness")
    assert settled(machine(whole), postures(drawn, POINTS[:2])) == {}
