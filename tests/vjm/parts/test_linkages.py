"""Linkages with legs that are rigid in some direction, and one that moves along a line."""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.parts.delta import about_z, round_bar, three_legs
from vjm.bars import Y, Z
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.frames import rotation_y
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.parts import Actuator, Frame, Leg, Part, ball, hinge
from vjm.stability import negative_eigenvalues
from vjm.stiffness import loaded_stiffness

BASE, PLATFORM, LIMB, DRIVE = 300.0, 100.0, 400.0, 2e3
LEAN = np.arccos((BASE - PLATFORM) / LIMB)


def three_prs(top: float = 0.0) -> Manipulator:
    """Slides along z, hinges across, rigid limbs, balls: elastic in its drives alone."""
    ahead = Frame(np.array([LIMB, 0.0, 0.0]))
    up = rotation_y(LEAN - np.pi)
    limb = (Frame(rotation=up), hinge(Y), ahead, Frame(rotation=up.T), ball())
    return three_legs("3-PRS", (Actuator("translation", Z, DRIVE), *limb), BASE, PLATFORM, LIMB, top)


def test_three_prs_elastic_in_its_drives_alone() -> None:
    """Each leg is rigid in some direction and the whole is not: along z three drives, about x 3/2 k r² of the balls'
    circle at rest, every other direction held by rigid legs."""
    whole = three_prs()
    height = LIMB * np.sin(LEAN)
    at = postures(whole, [0.0, 0.0, height])
    assert at.reached and all(chain.rigid for chain in machine(whole).chains)
    load = np.array([[0.0, 0.0, 30.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 50.0, 0.0, 0.0]])
    state = equilibrium(
        machine(whole), load, (), drives={k: np.tile(v, 2) for k, v in posture_inputs(at).items()}
    )
    assert np.all(state.converged) and np.all(state.unstable == 0)
    assert state.pose[0, 2] - height == pytest.approx(30.0 / (3 * DRIVE), rel=1e-6)
    # To first order in the turn, a ball moves along z as its slide does: limbs keep their lean.
    assert state.pose[1, 3] == pytest.approx(50.0 / (1.5 * DRIVE * PLATFORM**2), rel=1e-3)


def sarrus(turn: float) -> tuple[Manipulator, float]:
    """Two chains of three parallel hinges in planes at right angles; the height of the platform at a lean of links."""
    link, out = 100.0, 150.0
    parts: tuple[Part, ...] = (
        Frame(rotation=rotation_y(-turn)),
        hinge(Y),
        round_bar(link, 8.0),
        Frame(rotation=rotation_y(2 * turn - np.pi)),
        hinge(Y),
        round_bar(link, 8.0),
        hinge(Y),
        Frame(rotation=rotation_y(np.pi - turn)),
    )
    legs = []
    for k in range(2):
        frame = about_z(k * np.pi / 2)
        end = Frame(np.array([-out, 0.0, 0.0]), frame.T)
        legs.append(Leg("ab"[k], (Frame(frame @ [out, 0.0, 0.0], frame), *parts, end)))
    return Manipulator("Sarrus", tuple(legs), out), 2 * link * np.sin(turn)


@pytest.mark.parametrize("degrees", [35.0, 50.0, 70.0])
def test_sarrus_moves_along_a_line(degrees: float) -> None:
    """One direction is free, exactly z, at every height; the five others are held."""
    whole, height = sarrus(np.deg2rad(degrees))
    at = postures(whole, [0.0, 0.0, height])
    assert at.reached
    k = loaded_stiffness(_rest(whole, at.pose))
    scale = np.repeat([1.0, 1.0 / 150.0], 3)
    values, vectors = np.linalg.eigh(k * np.outer(scale, scale))
    assert abs(values[0]) < 1e-9 * values[-1] and values[1] > 1e-4 * values[-1]
    np.testing.assert_allclose(np.abs(vectors[:, 0]), [0, 0, 1, 0, 0, 0], atol=1e-7)
    moved = postures(whole, [0.0, 0.0, height + 5.0])
    assert moved.reached and not postures(whole, [1.0, 0.0, height]).reached


def _rest(whole: Manipulator, pose: np.ndarray) -> Equilibrium:
    """What holds it at its posture."""
    return equilibrium(machine(whole), pose, drives=posture_inputs(postures(whole, pose)))


def test_unstable_directions_of_rigid_legs() -> None:
    """Pushed down high above its balls the platform tips over: the count is that by eigenvalues of the whole."""
    whole = three_prs(top=200.0)
    generator = np.random.default_rng(3)
    at = postures(
        whole,
        np.array([0.0, 0.0, 200.0 + LIMB * np.sin(LEAN)]) + generator.uniform(-20, 20, (60, 1)) * [0, 0, 1],
    )
    load = np.zeros((60, 6))
    load[:, 2] = generator.uniform(-2.5e5, 0.0, 60)
    state = equilibrium(machine(whole), load, (), drives=posture_inputs(at), follow=True)
    good = state.converged
    found = state.member(good)
    assert good.sum() > 30 and np.sum(found.unstable > 0) > 10
    assert np.array_equal(found.unstable, negative_eigenvalues(found, np.zeros(6, dtype=bool)))
