"""Equilibrium: Eq. 5 met, energy balance, Eq. 6 against Newton's method, mixed control, honest failures."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from tests.vjm.load_paths import load_path
from tests.vjm.picard import picard
from tests.vjm.strategies import LENGTH, WIDTH, angles, bar_stiffness, displacements, fixed_seed
from vjm import closed_forms, paper
from vjm.equilibrium import equilibrium, nearby, unloaded
from vjm.frames import POSE_NAMES, exp, log
from vjm.increments import UNSURE
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.newton import DIVERGED, RUNNING, solve_each

PLACES = ("tip", "middle", "base")


def linkage(q: float = 0.0, place: str = "tip") -> Parallelogram:
    return Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q, spring_at=place)  # type: ignore[arg-type]


@fixed_seed(25)
@given(bar_stiffness(), angles, displacements(0.3, 2e-3))
def test_equation_5_holds(k: np.ndarray, q: float, move: np.ndarray) -> None:
    mechanism = Parallelogram(LENGTH, WIDTH, k, q)
    state = equilibrium(mechanism, mechanism.unloaded_pose + move)
    assert state.converged
    for i, chain in enumerate(mechanism.chains):
        multiplier, x = state.multipliers[i], state.coordinates[i]
        jacobian = chain.chain.jacobian(x)
        torque = jacobian.T @ multiplier
        size = np.abs(jacobian).T @ np.abs(multiplier) + 1.0
        spring = np.zeros(chain.chain.size)
        spring[chain.virtual] = chain.stiffness @ state.theta[i]
        np.testing.assert_allclose(torque / size, spring / size, atol=1e-9)
        np.testing.assert_allclose(chain.chain.pose(x), state.pose, atol=1e-10)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("q", [0.0, np.pi / 6])
def test_work_of_the_load_is_the_elastic_energy(q: float, place: str) -> None:
    mechanism = linkage(q, place)
    # Loads stay below the lowest critical one, beyond which the path would not be smooth.
    move = np.array([0.04, 0.3, 0.05, 2e-3, 3e-4, 2e-3])
    points, weights = np.polynomial.legendre.leggauss(16)
    share = 0.5 * (points + 1.0)
    path = load_path(mechanism, mechanism.unloaded_pose + share[:, None] * move)
    work = 0.5 * weights @ (path.load @ move)
    end = equilibrium(mechanism, mechanism.unloaded_pose + move, start=path.member(-1))
    assert work == pytest.approx(float(end.energy), rel=1e-9)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("q", [0.0, np.pi / 6])
def test_equation_6_and_newton_agree(q: float, place: str) -> None:
    mechanism = linkage(q, place)
    poses = mechanism.unloaded_pose + np.array(
        [[-0.05, 0.1, 0.05, 1e-3, 1e-4, 1e-3], [0.02, 0, 0, 0, 0, 1e-3]]
    )
    newton, paper_way = equilibrium(mechanism, poses), picard(mechanism, poses)
    assert np.all(newton.converged) and np.all(paper_way.converged)
    np.testing.assert_allclose(paper_way.load, newton.load, atol=1e-7 * np.abs(newton.load).max())
    assert np.all(newton.iterations <= paper_way.iterations)


def test_equation_6_converges_linearly_and_newton_quadratically() -> None:
    mechanism = linkage(0.0, "base")
    pose = mechanism.unloaded_pose + np.array([-0.1, 0.05, 0.2, 1e-3, 2e-4, 1e-3])
    assert equilibrium(mechanism, pose).iterations <= 6
    assert picard(mechanism, pose).iterations > 12


def test_a_warm_start_is_used() -> None:
    mechanism = linkage(0.4)
    pose = mechanism.unloaded_pose + np.array([-0.1, 0.3, 0.2, 2e-3, 3e-4, 2e-3])
    first = equilibrium(mechanism, pose)
    again = equilibrium(mechanism, pose, start=first)
    assert again.iterations == 1 < first.iterations
    np.testing.assert_allclose(again.load, first.load, atol=1e-6)


def test_leading_axes_are_batch_axes() -> None:
    mechanism = linkage(0.4, "middle")
    moves = np.random.default_rng(1).uniform(-1, 1, (2, 3, 6)) * np.repeat([0.1, 1e-3], 3)
    state = equilibrium(mechanism, mechanism.unloaded_pose + moves)
    assert state.multipliers.shape == (2, 3, 2, 6) and state.q[0].shape == (2, 3, 2)
    one = equilibrium(mechanism, mechanism.unloaded_pose + moves[1, 2])
    np.testing.assert_allclose(state.load[1, 2], one.load, atol=1e-6)


@pytest.mark.parametrize("q", [0.0, np.pi / 6])
def test_mixed_control_is_the_pose_problem_read_the_other_way(q: float) -> None:
    mechanism = linkage(q)
    load = np.array([0.0, 20.0, 0.0, 300.0, 0.0, -500.0])
    targets = np.where([1, 0, 1, 0, 1, 0], mechanism.unloaded_pose + np.array([-0.05, 0, 0.1, 0, 0, 0]), load)
    state = equilibrium(mechanism, targets, held=("x", "z", "ry"))
    assert state.converged
    np.testing.assert_allclose(state.load[[1, 3, 5]], [20.0, 300.0, -500.0], atol=1e-6)
    np.testing.assert_allclose(state.pose[[0, 2, 4]], targets[[0, 2, 4]], atol=1e-12)
    whole = equilibrium(mechanism, state.pose)
    np.testing.assert_allclose(whole.load, state.load, atol=1e-5)


def test_wrench_moment_is_work_conjugate_to_rotation() -> None:
    """Turning the platform a little further by a spatial rotation costs moment times angle."""
    mechanism = linkage(0.2)
    pose = mechanism.unloaded_pose + np.array([0.0, 0.5, 0.0, 0.02, 0.002, 0.03])
    state = equilibrium(mechanism, pose)
    turn, h = np.array([0.3, 0.1, -0.5]), 1e-5
    energies = []
    for sign in (1, -1):
        phi = log(exp(sign * h * turn) @ exp(pose[3:]))
        energies.append(float(equilibrium(mechanism, np.concatenate([pose[:3], phi]), start=state).energy))
    assert (energies[0] - energies[1]) / (2 * h) == pytest.approx(state.wrench[3:] @ turn, rel=1e-6)
    assert state.load[3:] @ turn != pytest.approx(state.wrench[3:] @ turn, rel=1e-4)


def test_unreachable_poses_are_reported_and_stay_finite() -> None:
    mechanism = linkage()
    poses = mechanism.unloaded_pose + np.array([[1e7, 0, 0, 0, 0, 0], [0.01, 0, 0, 0, 0, 0]])
    state = picard(mechanism, poses, limit=30)
    assert state.converged.tolist() == [False, True]
    assert state.reason[0] in (DIVERGED, RUNNING)
    assert np.all(np.isfinite(state.unknowns))


def test_nearby_is_what_newton_finds_at_once_and_nothing_else() -> None:
    """A pose next to the start, and one where straight bars are unstable, which wants more than Newton's method."""
    mechanism = linkage(0.0, "middle")
    critical = closed_forms.in_plane_critical(mechanism).compression
    assert critical is not None
    shortening = critical / (2.0 * paper.BAR_STIFFNESS[0, 0])
    poses = mechanism.unloaded_pose + np.outer([-0.1 * shortening, 1.5 * shortening], np.eye(6)[0])
    held = ("x", "z", "rx", "ry", "rz")
    targets = np.where([name in held for name in POSE_NAMES], poses, 0.0)
    rest = unloaded(mechanism)
    found = nearby(mechanism, targets, held, rest, {}, rest.memory)
    careful = equilibrium(mechanism, targets, held, rest, follow=True)
    assert found.converged.tolist() == [True, False] and found.reason[1] == UNSURE
    assert careful.unstable.tolist() == [0, 2]
    np.testing.assert_array_equal(found.unknowns[0], careful.unknowns[0])


def test_too_few_iterations_are_reported() -> None:
    mechanism = linkage(0.3)
    state = equilibrium(mechanism, mechanism.unloaded_pose + np.array([0.1, 0.2, 0.1, 0, 0, 1e-3]), limit=1)
    assert not state.converged and str(state.reason).startswith(RUNNING)


def test_a_singular_member_does_not_spoil_the_batch() -> None:
    none = np.full((2, 2), np.nan)
    for bad in (np.zeros((2, 2)), none, np.array([[0.0, np.inf], [0.0, 0.0]])):
        solution, regular = solve_each(np.stack([bad, 2 * np.eye(2), np.zeros((2, 2))]), np.ones((3, 2, 1)))
        assert regular.tolist() == [False, True, False]
        np.testing.assert_array_equal(solution[1, :, 0], [0.5, 0.5])
    solution, regular = solve_each(np.stack([np.zeros((2, 2)), 2 * np.eye(2)]), np.ones((2, 2, 1)))
    np.testing.assert_array_equal(solution[..., 0], [[0, 0], [0.5, 0.5]])


def test_unloaded_state_carries_nothing() -> None:
    state = unloaded(linkage(0.5))
    assert float(state.energy) == 0.0 and not np.any(state.wrench)


def test_bad_targets_are_refused() -> None:
    with pytest.raises(ValueError, match="six numbers"):
        equilibrium(linkage(), np.zeros(5))
    with pytest.raises(ValueError, match="finite"):
        equilibrium(linkage(), np.full(6, np.nan))
    with pytest.raises(ValueError, match="held coordinates"):
        equilibrium(linkage(), np.zeros(6), held=("x", "w"))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": -1.0}, "length must be positive"),
        ({"width": 0.0}, "width must be positive"),
        ({"q": 2.0}, "q must lie"),
        ({"spring_at": "end"}, "spring_at"),
        ({"bar_stiffness": np.eye(5)}, "6x6"),
        ({"bar_stiffness": np.eye(6) + np.eye(6, k=1) * 0.1}, "symmetric"),
        ({"bar_stiffness": np.eye(6) - np.ones((6, 6)) * 0.5}, "positive definite"),
        ({"bar_stiffness": -np.eye(6)}, "positive definite"),
        ({"bar_stiffness": np.full((6, 6), np.inf)}, "finite"),
    ],
)
def test_bad_linkages_are_refused(change: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"length": LENGTH, "width": WIDTH, "bar_stiffness": paper.BAR_STIFFNESS}
    with pytest.raises(ValueError, match=message):
        Parallelogram(**(good | change))  # type: ignore[arg-type]
