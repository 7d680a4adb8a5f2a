"""Stops of plays in a manipulator: pressed as on the bench, whose solver has parallel chains and no inner loops."""

from __future__ import annotations

import numpy as np

from tests.vjm.manipulator.example import LENGTH, WIDTH
from vjm import equilibrium as parallel
from vjm import paper
from vjm import slides as chains
from vjm.effects import catalogue
from vjm.manipulator.effects import with_effect
from vjm.manipulator.equilibrium import equilibrium
from vjm.manipulator.lagrangian import system
from vjm.manipulator.parts import Leg, Manipulator, Parallelogram
from vjm.manipulator.plays import pressed
from vjm.manipulator.posture import postures
from vjm.manipulator.sensitivity import unknowns_by_targets
from vjm.mechanisms.parallelogram import Parallelogram as Bench
from vjm.sensitivity import by_targets

HELD = ("y", "z", "rx", "ry", "rz")
FORCES = np.array([-900.0, -0.1, 0.2, 400.0])


def test_stops_of_one_parallelogram_are_pressed_as_on_the_bench() -> None:
    play = catalogue()["joint_clearance"]
    plain = Bench(LENGTH, WIDTH, paper.BAR_STIFFNESS, np.radians(20.0))
    theirs = play.apply(plain, play.typicals)
    one = Manipulator("one", (Leg("one", (Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS),)),), LENGTH)
    ours = with_effect(one, play, play.typicals)
    targets = plain.unloaded_pose * [0, 1, 1, 1, 1, 1] + FORCES[:, None] * [1, 0, 0, 0, 0, 0]
    expected = parallel.equilibrium(theirs, targets, HELD)
    at = postures(one, np.tile(plain.unloaded_pose, (FORCES.size, 1)))
    found = equilibrium(system(ours, at), targets, HELD)
    assert expected.converged.all() and found.converged.all()
    force, slope = pressed(found, unknowns_by_targets(found, HELD))
    other, way = chains.pressed(expected, by_targets(expected).unknowns)
    assert force.shape == (FORCES.size, 2)
    np.testing.assert_array_equal(force[1:3], 0.0)
    np.testing.assert_allclose(force, other, rtol=1e-6, atol=1e-6)
    # Loads of the manipulator's solver are conjugate to the rotation vector: moments differ, the axial force does not.
    np.testing.assert_allclose(slope[..., 0], way[..., 0], rtol=1e-6, atol=1e-9)
    assert np.all(np.abs(slope[[0, 3], :, 0]) > 0.1) and np.all(slope[1:3] == 0.0)
