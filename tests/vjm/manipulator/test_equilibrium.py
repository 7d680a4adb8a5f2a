"""Loaded equilibrium with closed loops, against the parallelogram of two parallel chains and against differences."""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.manipulator.example import ABOUT_Y, LENGTH, POINTS, WIDTH, orthoglide, pair, relative
from vjm import equilibrium as parallel
from vjm import paper, stiffness
from vjm.frames import rotation_y
from vjm.manipulator.equilibrium import equilibrium, loaded_stiffness, unstable_directions
from vjm.manipulator.lagrangian import gradient_and_hessian, system
from vjm.manipulator.parts import ElasticLink, Leg, Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.mechanisms import parallelogram as chains

FORCE = np.array([300.0, -200.0, 100.0, 1e3, 2e3, -1e3])


@pytest.mark.parametrize("segments", [0, 2])
@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_one_parallelogram_is_that_of_two_parallel_chains(segments: int, degrees: float) -> None:
    """The other solver has no inner loops: both bars are chains from the base to the platform there."""
    q = np.radians(degrees)
    linkage = chains.Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q)
    linkage = linkage.refined(segments) if segments else linkage
    part = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, segments=segments)
    whole = Manipulator("one", (Leg("one", (part,)),), LENGTH)
    at = postures(whole, linkage.unloaded_pose[None])
    assert at.reached.all() and at.coordinates[0] == pytest.approx(q)
    target = linkage.unloaded_pose + [-0.02, 0.3, -0.2, 0.002, 1e-4, -0.003]
    target[1] = 50.0
    held = ("x", "z", "rx", "ry", "rz")
    theirs = parallel.equilibrium(linkage, target, held)
    ours = equilibrium(system(whole, at), target, held)
    assert ours.converged.all() and theirs.converged
    np.testing.assert_allclose(ours.pose[0], theirs.pose, atol=1e-9)
    np.testing.assert_allclose(ours.wrench[0], theirs.wrench, rtol=1e-7, atol=1e-4)
    assert unstable_directions(ours, held)[0] == theirs.unstable
    expected = stiffness.loaded_stiffness(theirs)
    # z of the bar frame moves freely, so its diagonal is no scale: write both in the bar frame without it.
    turn = np.kron(np.eye(2), rotation_y(q))
    kept = [0, 1, 3, 4, 5]
    mine, other = ((turn.T @ k @ turn)[np.ix_(kept, kept)] for k in (loaded_stiffness(ours)[0], expected))
    assert relative(mine, other) < 1e-7


@pytest.mark.parametrize("change", [{}, {"segments": 2}, {"bars": "equivalent"}, {"radial": 1e-5}])
def test_hessian_is_the_derivative_of_the_gradient(change: dict[str, object]) -> None:
    whole = orthoglide(pair(**change))
    of = system(whole, postures(whole, POINTS[1:2]))
    u = equilibrium(of, FORCE).unknowns
    direction = np.random.default_rng(3).normal(size=of.size) * of.scale * 1e-3
    step = 1e-3
    ahead, back = (gradient_and_hessian(of, u + s * step * direction)[0] for s in (1.0, -1.0))
    found = (gradient_and_hessian(of, u)[1] @ direction)[0] * of.scale / of.energy
    expected = ((ahead - back) / (2 * step))[0] * of.scale / of.energy
    # Central differences of a cubic remainder: (1e-3 x 1e-3)² of the third derivative, well below 1e-6 of the rest.
    np.testing.assert_allclose(found, expected, atol=1e-6 * np.max(np.abs(expected)))


@pytest.mark.parametrize("segments", [0, 2])
def test_loaded_stiffness_is_the_derivative_of_the_load(segments: int) -> None:
    whole = orthoglide(pair(segments=segments))
    of = system(whole, postures(whole, POINTS[1:3]))
    state = equilibrium(of, FORCE)
    assert state.converged.all()
    np.testing.assert_allclose(state.loads.sum(1), np.tile(FORCE, (2, 1)), atol=1e-6)
    k = loaded_stiffness(state)
    size = np.array([10.0, 10.0, 10.0, 1e3, 1e3, 1e3])
    for row in np.eye(6) * size:
        ahead, back = (equilibrium(of, FORCE + s * row, start=state).pose for s in (1.0, -1.0))
        found = (k @ (ahead - back)[..., None])[..., 0] / 2
        np.testing.assert_allclose(found / size, np.tile(row / size, (2, 1)), atol=1e-5)


def test_a_target_far_away_is_met_in_increments() -> None:
    whole = orthoglide(pair(segments=2))
    of = system(whole, postures(whole, POINTS[:1]))
    far = 0.95 * np.array([4000.0, 3000.0, -3000.0, 2e6, 0.0, 0.0])
    assert not equilibrium(of, far, limit=5, increments=False).converged.any()
    state = equilibrium(of, far, limit=5)
    assert state.converged.all(), state.reason
    np.testing.assert_allclose(state.loads.sum(1)[0], far, atol=1e-6 * 2e6)
    # On its way the platform loses stability twice, and no state of balance is left at 0.975 of the full load.
    assert unstable_directions(state)[0] == 2 and not equilibrium(of, far / 0.95).converged.any()


def test_a_loose_manipulator_is_reported() -> None:
    leg = Leg("bar", (ABOUT_Y, ElasticLink(LENGTH, paper.BAR_STIFFNESS)))
    whole = Manipulator("loose", (leg,), LENGTH)
    state = equilibrium(system(whole, postures(whole, [[LENGTH, 0.0, 0.0]])), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    assert not state.converged.any()
    assert state.reason[0]


def test_bad_targets_and_unreached_postures_are_refused() -> None:
    whole = orthoglide(pair())
    of = system(whole, postures(whole, POINTS[:1]))
    with pytest.raises(ValueError, match="six numbers"):
        equilibrium(of, [1.0, 2.0])
    with pytest.raises(ValueError, match="does not reach"):
        system(whole, postures(whole, [[0.0, 400.0, 0.0]]))
