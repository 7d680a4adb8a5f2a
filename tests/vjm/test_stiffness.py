"""Unloaded stiffness against Eq. 11; loaded stiffness against differences of the equilibrium load."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.vjm.pseudo_rigid import PseudoRigidBar, pseudo_rigid_bar
from tests.vjm.strategies import (
    LENGTH,
    ROTATION_RADIUS,
    WIDTH,
    angles,
    bar_stiffness,
    displacements,
    fixed_seed,
)
from vjm import frames, paper, stiffness
from vjm.equilibrium import equilibrium
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram

places = st.sampled_from(["tip", "middle", "base"])


def entrywise(difference: np.ndarray, reference: np.ndarray) -> float:
    """Largest entry of a difference relative to the geometric mean of its two diagonal entries."""
    diagonal = np.diag(reference).copy()
    diagonal[diagonal == 0] = np.min(diagonal[diagonal > 0])
    return float(np.max(np.abs(difference) / np.sqrt(np.outer(diagonal, diagonal))))


@fixed_seed(60)
@given(bar_stiffness(), angles, places, st.floats(20, 200))
def test_elimination_gives_equation_11(k: np.ndarray, q: float, place: str, width: float) -> None:
    linkage = Parallelogram(LENGTH, width, k, q, spring_at=place)
    reference = stiffness.closed_form(k, width, q)
    assert entrywise(stiffness.unloaded_stiffness(linkage, q) - reference, reference) < 1e-9


@fixed_seed(30)
@given(bar_stiffness(), angles, places)
def test_rank_is_five_and_z_of_the_bar_frame_is_free(k: np.ndarray, q: float, place: str) -> None:
    found = stiffness.unloaded_stiffness(Parallelogram(LENGTH, WIDTH, k, q, spring_at=place))
    assert stiffness.rank(found, LENGTH) == 5
    scaled = ROTATION_RADIUS[:, None] * found * ROTATION_RADIUS
    free = np.linalg.svd(scaled)[2][-1]
    expected = np.concatenate([frames.rotation_y(q) @ [0, 0, 1], np.zeros(3)])
    assert abs(abs(free @ expected) - 1.0) < 1e-12


@fixed_seed(30)
@given(bar_stiffness(), angles, places)
def test_pseudo_rigid_bar_gives_the_stiffness_back(k: np.ndarray, q: float, place: str) -> None:
    linkage = Parallelogram(LENGTH, WIDTH, k, q, spring_at=place)
    reference = stiffness.closed_form(k, WIDTH, q)
    equivalent = pseudo_rigid_bar(linkage)
    np.testing.assert_allclose(equivalent.unloaded_pose, linkage.unloaded_pose)
    assert entrywise(stiffness.unloaded_stiffness(equivalent, q) - reference, reference) < 1e-9


@fixed_seed(25)
@given(bar_stiffness(), angles, places, displacements(0.5, 3e-3))
def test_loaded_stiffness_is_the_slope_of_the_load(
    k: np.ndarray, q: float, place: str, move: np.ndarray
) -> None:
    linkage = Parallelogram(LENGTH, WIDTH, k, q, spring_at=place)
    pose = linkage.unloaded_pose + move
    steps = np.diag(np.repeat([1e-4, 3e-7], 3))
    here = equilibrium(linkage, pose, follow=True)
    # Near a critical load, and past it, the slope changes too fast for a difference to follow.
    assume(here.unstable == 0)
    aside = np.stack([pose + steps, pose - steps, pose + 2 * steps, pose - 2 * steps])
    state = equilibrium(linkage, aside, start=here, follow=True)
    assume(np.all(state.unstable <= 0))
    assert np.all(state.converged)
    # Of fourth order: the load's third derivative grows towards a critical load.
    near, far = state.load[0] - state.load[1], state.load[2] - state.load[3]
    numerical = ((8 * near - far) / (12 * np.diag(steps))[:, None]).T
    loaded = stiffness.loaded_stiffness(here)
    scaled = ROTATION_RADIUS[:, None] * np.stack([loaded, numerical, loaded.T]) * ROTATION_RADIUS
    size = np.max(np.abs(scaled[0]))
    assert np.max(np.abs(scaled[1] - scaled[0])) < 1e-6 * size
    assert np.max(np.abs(scaled[2] - scaled[0])) < 1e-11 * size


def test_load_changes_the_stiffness() -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS)
    state = equilibrium(linkage, linkage.unloaded_pose - [0.1, 0, 0, 0, 0, 0])
    loaded = stiffness.loaded_stiffness(state)
    # Two bars of length l under the compression P each resist a sideways motion by -P/l, as a pendulum does.
    assert loaded[2, 2] == pytest.approx(state.load[0] / (LENGTH - 0.1), rel=1e-9)


def test_stiffness_by_chain_sums_to_the_loaded_stiffness() -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.3)
    state = equilibrium(
        linkage, linkage.unloaded_pose + np.array([[0.1, 0, 0.2, 0, 1e-3, 0], [0, 0.1, 0, 1e-3, 0, 0]])
    )
    each = stiffness.stiffness_by_chain(state)
    assert each.shape == (2, 2, 6, 6)
    total = stiffness.loaded_stiffness(state)
    np.testing.assert_allclose(np.sum(each, axis=1), total, rtol=1e-14)
    single = stiffness.loaded_stiffness(state.member(1))
    np.testing.assert_allclose(total[1], single, rtol=1e-9, atol=1e-9 * np.abs(single).max())


@pytest.mark.parametrize("place", ["tip", "middle", "base"])
def test_bar_gives_its_own_stiffness_back(place: str) -> None:
    bar = Bar(LENGTH, paper.BAR_STIFFNESS, spring_at=place)  # type: ignore[arg-type]
    found = stiffness.unloaded_stiffness(bar)
    assert entrywise(found - paper.BAR_STIFFNESS, paper.BAR_STIFFNESS) < 1e-12


def test_pinned_bar_loses_one_rank() -> None:
    assert (
        stiffness.rank(stiffness.unloaded_stiffness(Bar(LENGTH, paper.BAR_STIFFNESS, "pinned")), LENGTH) == 5
    )


def test_pseudo_rigid_bar_refuses_other_shapes() -> None:
    with pytest.raises(ValueError, match="5x5"):
        PseudoRigidBar(LENGTH, np.eye(6))
