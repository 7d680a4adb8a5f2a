"""Compiled kinematics against those written with matrices."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.vjm.kinematics import reference
from tests.vjm.strategies import LENGTH, WIDTH, chains, fixed_seed
from vjm import kernels, lagrangian, paper
from vjm.chain import Chain, Fixed, Joint, Mark, Role
from vjm.frames import exp, log
from vjm.loads import DeadLoads
from vjm.mechanism import ElasticChain, Path
from vjm.mechanisms.parallelogram import Parallelogram

seeds = st.integers(0, 10_000)
STATES = 3
ROUNDING = 1e-12


def check(chain: Chain, seed: int, far: float, sign: float, second: bool) -> None:
    """A closure behind six others of a leg, whose last coordinate does not move."""
    generator = np.random.default_rng(seed)
    x = generator.uniform(-far, far, (STATES, chain.size))
    multipliers = generator.uniform(-1.0, 1.0, (STATES, 12))
    columns = np.arange(chain.size) + 1
    columns[-1] = kernels.NO_COLUMN
    m = chain.size + 1
    gap, balance = generator.normal(size=(STATES, 12)), generator.normal(size=(STATES, m))
    matrix = np.zeros((STATES, m + 12, m + 12) if second else (0, 0, 0))
    before = [part.copy() for part in (gap, balance)]
    kernels.close(chain.program, columns, x, multipliers, 6, sign, m, gap, balance, matrix)
    here, moving, own = [reference(chain, each) for each in x], slice(1, m - 1), slice(0, chain.size - 1)
    pose, jacobian = (np.array([getattr(each, name) for each in here]) for name in ("pose", "jacobian"))
    size = max(1.0, np.abs(jacobian).max(), np.abs(pose).max())
    after = [part.copy() for part in before]
    after[0][:, 6:] += sign * pose
    after[1][:, moving] += sign * np.einsum("bjn,bj->bn", jacobian, multipliers[:, 6:])[:, own]
    for found, expected in zip((gap, balance), after, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=ROUNDING * size)
    if not second:
        return
    whole = np.zeros_like(matrix)
    whole[:, m + 6 :, moving] = sign * jacobian[..., own]
    whole[:, moving, m + 6 :] = np.swapaxes(whole[:, m + 6 :, moving], -1, -2)
    hessian = np.array([each.hessian(dual) for each, dual in zip(here, multipliers[:, 6:], strict=True)])
    whole[:, moving, moving] = sign * hessian[:, own, own]
    np.testing.assert_allclose(matrix, whole, rtol=0, atol=10.0 * ROUNDING * size)
    np.testing.assert_array_equal(matrix, np.swapaxes(matrix, -1, -2))


@fixed_seed(60)
@given(chains(), seeds, st.sampled_from([0.1, 1.0, 3.0]), st.sampled_from([-1.0, 1.0]), st.booleans())
def test_a_closure_of_any_chain(chain: Chain, seed: int, far: float, sign: float, second: bool) -> None:
    check(chain, seed, far, sign, second)


@pytest.mark.parametrize("second", [False, True])
def test_a_closure_of_bars_whose_joints_are_tied(second: bool) -> None:
    check(Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS).refined(3).chains[1].chain, 7, 0.3, -1.0, second)


@pytest.mark.parametrize("batch", [(), (0,), (3,), (2, 3)])
def test_a_leg_in_which_nothing_moves(batch: tuple[int, ...]) -> None:
    """A drive on a rigid link closes on the platform, with no coordinate of its own."""
    drive = Joint("rotation", (0.0, 0.0, 1.0), Role.ACTUATED)
    chain = Chain((Fixed(np.array([1.0, 2.0, 3.0])), drive, Fixed(np.array([10.0, 0.0, 0.0]))))
    leg = ElasticChain(chain, np.zeros((0, 0)), np.zeros(1))
    pose, none = np.ones((*batch, 6)), np.zeros((*batch, 0))
    rows = lagrangian.chain_rows(leg, none, leg.rest, pose, pose, none, second=True)
    assert rows.balance.shape == (*batch, 0) and rows.matrix.shape == (*batch, 6, 6)
    np.testing.assert_allclose(rows.gap, pose - chain.pose(np.zeros(1)))


def test_what_does_not_fit_is_refused() -> None:
    """Compiled functions look after nothing: whoever calls them does."""
    chain = Chain((Joint("rotation", (0.0, 0.0, 1.0), Role.VIRTUAL), Fixed(np.array([10.0, 0.0, 0.0]))))
    leg, start = ElasticChain(chain, np.eye(1), np.zeros(1)), Mark(0, np.zeros(3))
    with pytest.raises(ValueError, match="multipliers"):
        lagrangian.closing_force(leg, np.zeros((4, 1)), np.zeros(6))
    with pytest.raises(ValueError, match="numbers"):
        Path(chain, np.arange(2))
    for marks, forces, match in (
        ((start,), np.zeros((2, 3)), "forces"),
        ((Mark(2, np.zeros(3)), start), np.zeros((2, 3)), "in order"),
        ((Mark(3, np.zeros(3)),), np.zeros((1, 3)), "in order"),
    ):
        with pytest.raises(ValueError, match=match):
            DeadLoads(chain, np.arange(1), marks, forces)


@fixed_seed(60)
@given(chains(), seeds, st.sampled_from([0.1, 1.0, 3.0]))
def test_poses_of_any_chain(chain: Chain, seed: int, far: float) -> None:
    x = np.random.default_rng(seed).uniform(-far, far, (2, STATES, chain.size))
    found = chain.pose(x)
    expected = np.array([[reference(chain, each).pose for each in several] for several in x])
    assert found.shape == (2, STATES, 6)
    np.testing.assert_allclose(exp(found[..., 3:]), exp(expected[..., 3:]), rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(found[..., :3], expected[..., :3], rtol=0, atol=ROUNDING * LENGTH)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.5, 1.5, np.pi - 1e-9, np.pi])
def test_rotation_vectors_at_every_angle(angle: float) -> None:
    """Up to a half turn, about every axis and a slanting one."""
    for axis in (*np.eye(3), np.array([0.6, 0.0, 0.8]), np.array([-2.0, 1.0, 2.0]) / 3.0):
        rotation, phi = exp(angle * axis), np.empty(3)
        frame = np.vstack([rotation.T, np.zeros(3)])
        kernels._rotation_vector(frame, np.eye(3), phi)
        np.testing.assert_allclose(phi, log(rotation), rtol=0, atol=ROUNDING)
