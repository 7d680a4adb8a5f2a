"""Pose derivatives of random chains against central differences; Eq. 1 against homogeneous matrices."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.linalg import expm

from tests.vjm.strategies import LENGTH, WIDTH, chains, fixed_seed, vectors
from vjm import paper
from vjm.chain import Chain, Fixed, Joint, Role
from vjm.frames import log
from vjm.mechanisms.parallelogram import Parallelogram

seeds = st.integers(0, 10_000)
STEP = 1e-5


def random_state(chain: Chain, seed: int) -> tuple[np.ndarray, np.ndarray]:
    generator = np.random.default_rng(seed)
    return generator.uniform(-1, 1, chain.size), generator.uniform(-1, 1, 6)


@fixed_seed(80)
@given(chains(), seeds)
def test_jacobian(chain: Chain, seed: int) -> None:
    x, _ = random_state(chain, seed)
    # The rotation vector jumps at a half turn: stay away from it.
    assume(np.linalg.norm(chain.pose(x)[3:]) < 2.9)
    steps = STEP * np.eye(chain.size)
    numerical = (chain.pose(x + steps) - chain.pose(x - steps)).T / (2 * STEP)
    np.testing.assert_allclose(chain.jacobian(x), numerical, atol=1e-7)


@fixed_seed(80)
@given(chains(), seeds)
def test_hessian(chain: Chain, seed: int) -> None:
    x, multiplier = random_state(chain, seed)
    assume(np.linalg.norm(chain.pose(x)[3:]) < 2.9)
    steps = STEP * np.eye(chain.size)
    gradient = [multiplier @ chain.jacobian(x + sign * steps) for sign in (1, -1)]
    hessian = chain.kinematics(x, multiplier).hessian
    np.testing.assert_allclose(hessian, (gradient[0] - gradient[1]) / (2 * STEP), atol=2e-6)
    np.testing.assert_array_equal(hessian, hessian.T)


def check_pull(chain: Chain, seed: int) -> None:
    generator = np.random.default_rng(seed)
    x, multiplier = generator.uniform(-0.3, 0.3, (2, chain.size)), generator.uniform(-1, 1, (2, 6))
    kinematics = chain.kinematics(x, multiplier)
    whole = np.einsum("bji,bj->bi", kinematics.jacobian, multiplier)
    np.testing.assert_allclose(kinematics.pull, whole, atol=1e-12 * max(1.0, np.abs(whole).max()))


@fixed_seed(40)
@given(chains(), seeds)
def test_a_multiplier_pulls_by_the_transposed_jacobian(chain: Chain, seed: int) -> None:
    check_pull(chain, seed)


def test_a_multiplier_pulls_on_tied_joints_by_their_shares() -> None:
    check_pull(Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS).refined(3).chains[0].chain, 5)


@fixed_seed(20)
@given(chains(), seeds)
def test_leading_axes_are_batch_axes(chain: Chain, seed: int) -> None:
    generator = np.random.default_rng(seed)
    x, multiplier = generator.uniform(-1, 1, (2, 3, chain.size)), generator.uniform(-1, 1, (2, 3, 6))
    kinematics, one = chain.kinematics(x, multiplier), chain.kinematics(x[1, 2], multiplier[1, 2])
    for name in ("pose", "jacobian", "pull", "hessian"):
        whole, alone = getattr(kinematics, name), getattr(one, name)
        assert whole.shape == (2, 3, *alone.shape)
        np.testing.assert_allclose(whole[1, 2], alone, atol=1e-12)


def homogeneous(kind: str, axis: int, value: float) -> np.ndarray:
    """T_x .. R_z of the paper as the exponential of an elementary screw."""
    screw = np.zeros((4, 4))
    if kind == "T":
        screw[axis, 3] = 1.0
    else:
        i, j = (axis + 1) % 3, (axis + 2) % 3
        screw[j, i], screw[i, j] = 1.0, -1.0
    return expm(screw * value)


@fixed_seed(20)
@given(st.floats(-1, 1), vectors(0.3, 8), st.sampled_from([0, 1]))
def test_parallelogram_chain_is_equation_1(q: float, state: np.ndarray, bar: int) -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q)
    eta = (-1.0) ** (bar + 1)
    q1, theta, q2 = q + state[0], state[1:7], -q + state[7]
    factors = [("T", 2, eta * WIDTH / 2), ("R", 1, q1), ("T", 0, LENGTH)]
    factors += [("T", k, theta[k]) for k in range(3)] + [("R", k, theta[3 + k]) for k in range(3)]
    factors += [("R", 1, q2), ("T", 2, -eta * WIDTH / 2), ("R", 1, q)]
    frame = np.linalg.multi_dot([homogeneous(*factor) for factor in factors])
    pose = linkage.chains[bar].chain.pose(np.array([q1, *theta, q2]))
    np.testing.assert_allclose(pose[:3], frame[:3, 3], atol=1e-10)
    nominal = homogeneous("R", 1, q)[:3, :3]
    np.testing.assert_allclose(pose[3:], log(frame[:3, :3] @ nominal.T), atol=1e-12)


def test_roles_select_coordinates() -> None:
    joints = [Joint("rotation", (0, 1, 0), role) for role in (Role.PASSIVE, Role.VIRTUAL, Role.ACTUATED)]
    chain = Chain((joints[0], Fixed(), joints[1], joints[2]))
    assert chain.indices(Role.PASSIVE, Role.VIRTUAL).tolist() == [0, 1]
    assert chain.indices(Role.ACTUATED).tolist() == [2]


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match="length 1"):
        Joint("rotation", (1.0, 1.0, 0.0), Role.PASSIVE)
    with pytest.raises(ValueError, match="1 coordinates"):
        Chain((Joint("rotation", (1.0, 0.0, 0.0), Role.PASSIVE),)).pose(np.zeros(2))
