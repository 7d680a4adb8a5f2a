"""Rotations and 6x6 moves against scipy's matrix exponential, differences and rigid-body identities."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from tests.vjm.strategies import bar_stiffness, fixed_seed, vectors
from vjm import frames

# Lengths on both sides of the switch between series and closed form, and at zero.
sizes = st.sampled_from([0.0, 1e-12, 1e-6, 0.01, 0.999, 1.001, 2.0, 3.1])


@st.composite
def rotation_vectors(draw: st.DrawFn) -> np.ndarray:
    direction = draw(vectors(1.0).filter(lambda v: np.linalg.norm(v) > 0.1))
    return draw(sizes) * direction / np.linalg.norm(direction)


@fixed_seed(60)
@given(rotation_vectors())
def test_exp_is_the_matrix_exponential_and_log_its_inverse(phi: np.ndarray) -> None:
    rotation = frames.exp(phi)
    np.testing.assert_allclose(rotation, expm(frames.skew(phi)), atol=2e-14)
    np.testing.assert_allclose(frames.log(rotation), phi, atol=1e-14, rtol=1e-12)


def test_log_at_a_half_turn() -> None:
    for axis in np.eye(3):
        np.testing.assert_allclose(np.abs(frames.log(frames.exp(np.pi * axis))), np.pi * axis, atol=1e-12)


@fixed_seed(60)
@given(rotation_vectors(), vectors(1.0))
def test_rotation_jacobian_gives_the_spatial_angular_velocity(phi: np.ndarray, rate: np.ndarray) -> None:
    h = 1e-6
    slope = (frames.exp(phi + h * rate) - frames.exp(phi - h * rate)) / (2 * h)
    spin = slope @ frames.exp(phi).T
    np.testing.assert_allclose(spin, frames.skew(frames.rotation_jacobian(phi) @ rate), atol=2e-9)


@fixed_seed(60)
@given(rotation_vectors())
def test_inverse_rotation_jacobian(phi: np.ndarray) -> None:
    product = frames.inverse_rotation_jacobian(phi) @ frames.rotation_jacobian(phi)
    np.testing.assert_allclose(product, np.eye(3), atol=1e-12)


@fixed_seed(60)
@given(rotation_vectors(), vectors(1.0))
def test_moment_gradient_against_central_differences(phi: np.ndarray, mu: np.ndarray) -> None:
    h = 1e-5
    numerical = (frames.moment(phi + h * np.eye(3), mu) - frames.moment(phi - h * np.eye(3), mu)).T / (2 * h)
    np.testing.assert_allclose(frames.moment_gradient(phi, mu), numerical, atol=1e-9)


@fixed_seed(30)
@given(bar_stiffness(), vectors(100.0), vectors(1.0))
def test_moving_a_stiffness_keeps_energy_and_wrench(k: np.ndarray, r: np.ndarray, omega: np.ndarray) -> None:
    velocity = np.array([0.3, -0.2, 0.5])
    moved_twist = np.concatenate([velocity + np.cross(omega, r), omega])
    twist = np.concatenate([velocity, omega])
    wrench, moved = k @ twist, frames.move_stiffness(k, r) @ moved_twist
    size = np.abs(k).max() * 1e4
    np.testing.assert_allclose(moved[:3], wrench[:3], atol=1e-12 * size)
    # The same force acting at P needs the lever arm back from P' = P + r.
    np.testing.assert_allclose(moved[3:] + np.cross(r, moved[:3]), wrench[3:], atol=1e-12 * size)


def test_moving_there_and_back_changes_nothing() -> None:
    k = np.diag([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    r = np.array([0.1, 0.2, -0.3])
    np.testing.assert_allclose(frames.move_stiffness(frames.move_stiffness(k, r), -r), k, atol=1e-14)


def test_rotating_a_stiffness_turns_twist_and_wrench_alike() -> None:
    k = np.arange(36.0).reshape(6, 6)
    k = k + k.T
    r = frames.exp([0.3, -0.5, 0.8])
    turn = np.kron(np.eye(2), r)
    twist = np.array([0.1, 0.2, 0.3, -0.1, 0.4, 0.2])
    np.testing.assert_allclose(frames.rotate_stiffness(k, r) @ (turn @ twist), turn @ (k @ twist), atol=1e-12)


@pytest.mark.parametrize("function", [frames.exp, frames.rotation_jacobian, frames.inverse_rotation_jacobian])
def test_leading_axes_are_batch_axes(function) -> None:  # type: ignore[no-untyped-def]
    phi = np.linspace(-1.5, 1.5, 24).reshape(2, 4, 3)
    np.testing.assert_array_equal(function(phi)[1, 2], function(phi[1, 2]))
    np.testing.assert_allclose(frames.log(frames.exp(phi)), phi, atol=1e-14)


def test_bar_frame_turns_x_towards_minus_z() -> None:
    np.testing.assert_allclose(frames.rotation_y(np.pi / 6) @ [1, 0, 0], [np.cos(np.pi / 6), 0, -0.5])
