"""A Delta of arms and pairs of rods: at rest against frame finite elements, loaded in many postures."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.manipulator.frame import frame_stiffness
from tests.vjm.parts.delta import POINT, ROD, delta, round_bar
from vjm.equilibrium import equilibrium
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.parts import Leg, ball, universal
from vjm.stability import negative_eigenvalues


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (50.0, -40.0, 60.0), (-60.0, 30.0, -40.0)])
def test_rest_against_frame_elements(shift: tuple[float, float, float]) -> None:
    """Inverse kinematics closes the loops of the rods, and both programs add up the same members and joints."""
    whole = delta()
    at = postures(whole, POINT + np.array(shift))
    assert at.reached
    k = stiffness_at_rest(whole, at).total
    frame = frame_stiffness(whole, at.pose, at.coordinates)
    size = np.sqrt(np.diag(frame))
    assert np.max(np.abs(k - frame) / np.outer(size, size)) < 1e-9


def test_every_load_case_is_solved() -> None:
    """2 000 postures and loads; universal joint and ball leave a rod no idle turn."""
    whole, count = delta(), 2000
    generator = np.random.default_rng(5)
    at = postures(whole, POINT + generator.uniform(-60.0, 60.0, (count, 3)))
    loads = generator.normal(size=(count, 6)) * [100.0, 100.0, 100.0, 2e3, 2e3, 2e3]
    state = equilibrium(machine(whole), loads, (), drives=posture_inputs(at))
    assert np.all(at.reached) and np.all(state.converged)
    few = state.member(slice(0, 40))
    assert np.array_equal(few.unstable, negative_eigenvalues(few, np.zeros(6, dtype=bool)))


def test_rods_in_segments_are_the_same_at_rest() -> None:
    at = postures(delta(), POINT)
    k = [
        equilibrium(machine(delta(n)), at.pose + 1e-7 * np.eye(6), drives=posture_inputs(at)).load
        for n in (0, 3)
    ]
    assert np.max(np.abs(k[1] - k[0])) < 1e-5 * np.max(np.abs(k[0]))


def test_a_rod_between_two_balls_spins() -> None:
    rod = round_bar(ROD, 5.0)
    with pytest.raises(
        ValueError, match="leg a: part 2, a member of 400 mm, spins freely about itself: make one end a univ"
    ):
        Leg("a", (ball(), rod, ball()))
    assert Leg("a", (universal(), rod, ball())).posture
