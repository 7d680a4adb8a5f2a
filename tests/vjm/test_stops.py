"""How hard stops are pressed: as differences say, and in a manipulator, with its inner loops, as on the bench."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tests.vjm.manipulator.example import LENGTH, WIDTH
from vjm import equilibrium as parallel
from vjm import paper
from vjm.clearance import Clearance
from vjm.effects import catalogue
from vjm.effects.base import for_bars
from vjm.manipulator.effects import with_effect
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.mechanisms.parallelogram import Parallelogram as Bench
from vjm.parts import Leg
from vjm.sensitivity import by_targets
from vjm.stops import pressed, slid

HELD = ("y", "z", "rx", "ry", "rz")


def test_how_hard_stops_are_pressed_and_how_that_changes() -> None:
    """Zero inside; beyond, the force less what the centring spring takes to the stop, with the slope of differences."""
    play, linkage = Clearance(0.01), Bench(310.0, 80.0, paper.BAR_STIFFNESS, q=np.radians(15))
    loads = np.array([-4000.0, -3.0, 0.0, 0.4, 900.0])
    targets = linkage.unloaded_pose * [0, 1, 1, 1, 1, 1] + loads[:, None] * [1, 0, 0, 0, 0, 0]
    sliding = for_bars(linkage, lambda link: replace(link, slides=(play,)))
    inside = np.abs(loads) < 0.4
    assert 0 < inside.sum() < loads.size

    def forces(change: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        state = parallel.equilibrium(sliding, targets + change, HELD)
        return pressed(state, by_targets(state).unknowns)

    here, slope = forces(np.zeros(6))
    np.testing.assert_array_equal((here == 0.0).all(axis=1), inside)
    assert np.all(slope[inside] == 0.0)
    assert np.all(np.sign(here[~inside, 0]) == np.sign(here[0, 0]) * np.sign(loads[0] * loads[~inside]))
    # At 0.4 N differences reach across the edge.
    away = np.abs(loads) > 1.0
    for k, step in enumerate([0.05, 1e-5, 1e-5, 1e-7, 1e-7, 1e-7]):
        change = step * np.eye(6)[k]
        differences = (forces(change)[0] - forces(-change)[0])[away] / (2.0 * step)
        np.testing.assert_allclose(
            slope[away][..., k], differences, rtol=1e-3, atol=1e-3 * abs(slope[..., k]).max()
        )


def test_where_the_slides_are_and_how_that_changes() -> None:
    """Strains inside and outside the play, with the slopes of differences."""
    linkage = Bench(310.0, 80.0, paper.BAR_STIFFNESS, q=np.radians(15))
    sliding = for_bars(linkage, lambda link: replace(link, slides=(Clearance(0.01),)))
    targets = linkage.unloaded_pose * [0, 1, 1, 1, 1, 1] + np.outer([-0.2, 0.1, 900.0], np.eye(6)[0])

    def strains(change: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        state = parallel.equilibrium(sliding, targets + change, HELD)
        return slid(state, by_targets(state).unknowns)

    here, half, slope = strains(np.zeros(6))
    assert here.shape == (3, 2) and half.tolist() == [0.01, 0.01]
    assert (np.abs(here[:2]) < 0.01).all() and (np.abs(here[2]) > 0.01).all()
    for k, step in enumerate([0.01, 1e-5, 1e-5, 1e-7, 1e-7, 1e-7]):
        change = step * np.eye(6)[k]
        differences = (strains(change)[0] - strains(-change)[0]) / (2.0 * step)
        np.testing.assert_allclose(
            slope[..., k], differences, rtol=1e-3, atol=1e-3 * abs(slope[..., k]).max()
        )


def test_stops_of_one_parallelogram_are_pressed_as_on_the_bench() -> None:
    forces = np.array([-900.0, -0.1, 0.2, 400.0])
    play = catalogue()["joint_clearance"]
    plain = Bench(LENGTH, WIDTH, paper.BAR_STIFFNESS, np.radians(20.0))
    theirs = play.apply(plain, play.typicals)
    one = Manipulator("one", (Leg("one", (Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS),)),), LENGTH)
    ours = with_effect(one, play, play.typicals)
    targets = plain.unloaded_pose * [0, 1, 1, 1, 1, 1] + forces[:, None] * [1, 0, 0, 0, 0, 0]
    expected = parallel.equilibrium(theirs, targets, HELD)
    at = postures(one, np.tile(plain.unloaded_pose, (forces.size, 1)))
    found = parallel.equilibrium(machine(ours), targets, HELD, drives=posture_inputs(at))
    assert expected.converged.all() and found.converged.all()
    force, slope = pressed(found, by_targets(found).unknowns)
    other, way = pressed(expected, by_targets(expected).unknowns)
    assert force.shape == (forces.size, 2)
    np.testing.assert_array_equal(force[1:3], 0.0)
    np.testing.assert_allclose(force, other, rtol=1e-6, atol=1e-6)
    # Loads of the manipulator's solver are conjugate to the rotation vector: moments differ, the axial force does not.
    np.testing.assert_allclose(slope[..., 0], way[..., 0], rtol=1e-6, atol=1e-9)
    assert np.all(np.abs(slope[[0, 3], :, 0]) > 0.1) and np.all(slope[1:3] == 0.0)
