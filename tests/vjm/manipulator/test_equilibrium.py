"""Loaded equilibrium with closed loops, against the parallelogram of two parallel chains and against differences."""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.manipulator.example import (
    ABOUT_Y,
    LENGTH,
    POINTS,
    WIDTH,
    orthoglide,
    pair,
    relative,
    under,
    without_load,
)
from vjm import paper
from vjm.equilibrium import equilibrium, nearby
from vjm.frames import rotation_y
from vjm.lagrangian import ChainRows, all_rows, gradient, hessian, layout
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.mechanisms import parallelogram as chains
from vjm.parts import Leg, elastic
from vjm.stability import negative_eigenvalues
from vjm.stiffness import loaded_stiffness

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
    theirs = equilibrium(linkage, target, held)
    ours = under(whole, at, target, held)
    assert ours.converged.all() and theirs.converged
    np.testing.assert_allclose(ours.pose[0], theirs.pose, atol=1e-9)
    np.testing.assert_allclose(ours.wrench[0], theirs.wrench, rtol=1e-7, atol=1e-4)
    assert ours.unstable[0] == theirs.unstable == negative_eigenvalues(ours, held)[0]
    expected = loaded_stiffness(theirs)
    # z of the bar frame moves freely, so its diagonal is no scale: write both in the bar frame without it.
    turn = np.kron(np.eye(2), rotation_y(q))
    kept = [0, 1, 3, 4, 5]
    mine, other = ((turn.T @ k @ turn)[np.ix_(kept, kept)] for k in (loaded_stiffness(ours)[0], expected))
    assert relative(mine, other) < 1e-7


@pytest.mark.parametrize("change", [{}, {"segments": 2}, {"bars": "equivalent"}, {"radial": 1e-5}])
def test_hessian_is_the_derivative_of_the_gradient(change: dict[str, object]) -> None:
    whole = orthoglide(pair(**change))
    state = under(whole, postures(whole, POINTS[1:2]), FORCE)
    of, u = state.mechanism, state.unknowns
    place = layout(of)
    direction = np.random.default_rng(3).normal(size=place.size) * place.scale * 1e-3
    step = 1e-3

    def rows(at: np.ndarray) -> tuple[ChainRows, ...]:
        return all_rows(of, at, state.memory, state.drives)

    moved = [u + s * step * direction for s in (1.0, -1.0)]
    ahead, back = (gradient(place, rows(at), at) for at in moved)
    found = (hessian(place, rows(u)) @ direction)[0] * place.scale / place.energy
    expected = ((ahead - back) / (2 * step))[0] * place.scale / place.energy
    # Central differences of a cubic remainder: (1e-3 x 1e-3)² of the third derivative, well below 1e-6 of the rest.
    np.testing.assert_allclose(found, expected, atol=1e-6 * np.max(np.abs(expected)))


@pytest.mark.parametrize("segments", [0, 2])
def test_loaded_stiffness_is_the_derivative_of_the_load(segments: int) -> None:
    whole = orthoglide(pair(segments=segments))
    at = postures(whole, POINTS[1:3])
    state = under(whole, at, FORCE)
    assert state.converged.all()
    np.testing.assert_allclose(state.load, np.tile(FORCE, (2, 1)), atol=1e-6)
    k = loaded_stiffness(state)
    size = np.array([10.0, 10.0, 10.0, 1e3, 1e3, 1e3])
    for row in np.eye(6) * size:
        ahead, back = (under(whole, at, FORCE + s * row, start=state).pose for s in (1.0, -1.0))
        found = (k @ (ahead - back)[..., None])[..., 0] / 2
        np.testing.assert_allclose(found / size, np.tile(row / size, (2, 1)), atol=1e-5)


def test_a_target_far_away_is_met_in_increments() -> None:
    whole = orthoglide(pair(segments=2))
    at = postures(whole, POINTS[:1])
    far = 0.95 * np.array([4000.0, 3000.0, -3000.0, 2e6, 0.0, 0.0])
    rest = without_load(whole, at)
    assert not nearby(machine(whole), far, (), rest, posture_inputs(at), rest.memory).converged.any()
    state = under(whole, at, far, limit=5, follow=True)
    assert state.converged.all(), state.reason
    np.testing.assert_allclose(state.load[0], far, atol=1e-6 * 2e6)
    # On its way the platform loses stability twice, and no state of balance is left at 0.975 of the full load.
    assert state.unstable[0] == 2 and not under(whole, at, far / 0.95, follow=True).converged.any()


def test_a_loose_manipulator_is_reported() -> None:
    leg = Leg("bar", (ABOUT_Y, elastic(LENGTH, paper.BAR_STIFFNESS)))
    whole = Manipulator("loose", (leg,), LENGTH)
    state = under(whole, postures(whole, [[LENGTH, 0.0, 0.0]]), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    assert not state.converged.any()
    assert state.reason[0]


def test_bad_targets_and_unreached_postures_are_refused() -> None:
    whole = orthoglide(pair())
    with pytest.raises(ValueError, match="six numbers"):
        under(whole, postures(whole, POINTS[:1]), [1.0, 2.0])
    with pytest.raises(ValueError, match="does not reach"):
        without_load(whole, postures(whole, [[0.0, 400.0, 0.0]]))


@pytest.mark.parametrize(("segments", "count"), [(0, 400), (2, 100)])
def test_unstable_directions_are_those_by_eigenvalues(segments: int, count: int) -> None:
    """Those of legs with loops add up to the inertia of the whole, far beyond critical loads too."""
    generator = np.random.default_rng(11)
    whole = orthoglide(pair(segments=segments))
    at = postures(whole, generator.uniform(-80.0, 80.0, (count, 3)))
    loads = generator.normal(size=(count, 6)) * [8e3, 8e3, 8e3, 3e4, 3e4, 3e4]
    state = under(whole, at, loads, follow=True)
    found = state.member(state.converged)
    assert found.converged.size > 0.95 * count and np.sum(found.unstable > 0) > 0.25 * count
    assert np.array_equal(found.unstable, negative_eigenvalues(found, ()))
