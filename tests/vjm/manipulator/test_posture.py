"""Inverse kinematics of an Orthoglide against its closed form, and poses that cannot be reached."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.manipulator.example import LENGTH, POINTS, orthoglide, pair
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures, rigid_leg
from vjm.parts import Actuator


def test_closed_form() -> None:
    """A bar of length L spans from its slide to the point, so s = p - (L² - a² - b²)^½ + L with a, b across the leg."""
    whole = orthoglide(pair())
    at = postures(whole, POINTS)
    assert np.all(at.reached)
    for k, x in enumerate(at.coordinates):
        along, a, b = (POINTS[:, (k + i) % 3] for i in range(3))
        slide = along + LENGTH - np.sqrt(LENGTH**2 - a**2 - b**2)
        q = -np.arcsin(b / LENGTH)
        turn = np.arcsin(a / (LENGTH * np.cos(q)))
        np.testing.assert_allclose(x[:, 0], slide, atol=1e-8)
        np.testing.assert_allclose(x[:, 1:], np.stack([turn, q, -turn], -1), atol=1e-10)


def test_every_leg_ends_at_the_pose() -> None:
    whole = orthoglide(pair())
    at = postures(whole, POINTS.reshape(5, 1, 3))
    for leg, x in zip(whole.legs, at.coordinates, strict=True):
        np.testing.assert_allclose(rigid_leg(leg).chain.close(x)[0], at.pose, atol=1e-8)


def test_what_is_out_of_reach_says_so() -> None:
    at = postures(orthoglide(pair()), [[0.0, 0.0, 0.0], [0.0, 320.0, 0.0]])
    assert at.reached.tolist() == [True, False]
    assert at.reason.tolist() == ["", "leg x does not reach this pose"]
    tilted = postures(orthoglide(pair()), [0.0, 0.0, 0.0, 0.1, 0.0, 0.0])
    assert not tilted.reached


def test_an_actuator_has_limits() -> None:
    whole = orthoglide(pair())
    short = []
    for leg in whole.legs:
        parts = [replace(p, limits=(-10.0, 10.0)) if isinstance(p, Actuator) else p for p in leg.parts]
        short.append(replace(leg, parts=tuple(parts)))
    at = postures(
        Manipulator("short", tuple(short), LENGTH), [[0.0, 0.0, 9.0], [0.0, 0.0, 20.0], [0.0, 0.0, -20.0]]
    )
    assert at.reason.tolist() == ["", *["the actuator of leg z is beyond its limits"] * 2]


@pytest.mark.parametrize("poses", [[1.0, 2.0], [np.nan, 0.0, 0.0], 3.0])
def test_bad_poses(poses: object) -> None:
    with pytest.raises(ValueError, match="poses must be finite"):
        postures(orthoglide(pair()), poses)  # type: ignore[arg-type]
