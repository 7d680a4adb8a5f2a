"""Negative eigenvalues are counted by pivots: as many as there are, without a search for them."""

from __future__ import annotations

import numpy as np
import pytest

from vjm.equilibrium import equilibrium
from vjm.frames import POSE_NAMES
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.newton import negatives, solve_symmetric
from vjm.paper import BAR_STIFFNESS


@pytest.mark.parametrize("size", [1, 2, 6, 21, 40])
@pytest.mark.parametrize("diagonal", [1.0, 0.0])
def test_as_many_as_the_spectrum_has(size: int, diagonal: float) -> None:
    """Without a diagonal no single pivot is regular."""
    some = np.random.default_rng(size).standard_normal((100, size, size))
    symmetric = some + np.swapaxes(some, -1, -2)
    symmetric[:, range(size), range(size)] *= diagonal
    counted = np.sum(np.linalg.eigvalsh(symmetric) < 0.0, axis=-1)
    np.testing.assert_array_equal(negatives(symmetric), counted)


@pytest.mark.parametrize("closures", [6, 12])
def test_each_constraint_on_a_stable_body_is_one(closures: int) -> None:
    rng = np.random.default_rng(closures)
    root = rng.standard_normal((50, 20, 20))
    border = rng.standard_normal((50, closures, 20))
    none = np.zeros((50, closures, closures))
    whole = np.block([[root @ np.swapaxes(root, -1, -2), np.swapaxes(border, -1, -2)], [border, none]])
    assert set(negatives(whole)) == {closures}


def test_what_is_rounding_beside_the_rest_is_none() -> None:
    """A swing that meets no stiffness: of positive semidefinite matrices, whatever their rounding."""
    root = np.random.default_rng(7).standard_normal((200, 6, 5))
    assert set(negatives(root @ np.swapaxes(root, -1, -2))) == {0}


@pytest.mark.parametrize("q", [0.1, 0.3, 0.7])
def test_a_linkage_that_swings_freely_is_not_unstable(q: float) -> None:
    """At rest and without a load: nothing is held, or x and z are free."""
    linkage = Parallelogram(250.0, 80.0, BAR_STIFFNESS, q)
    for held in ((), ("y", "rx", "ry", "rz")):
        given = np.where([name in held for name in POSE_NAMES], linkage.unloaded_pose, 0.0)
        assert equilibrium(linkage, given[None, :], held).unstable.max() == 0


@pytest.mark.parametrize("counted", [[], [1], [3, 0], [0, 1, 2, 3, 4]])
def test_solved_and_counted_by_the_same_factors(counted: list[int]) -> None:
    """Whether some members are counted, all or none; the last two matrices are singular."""
    generator = np.random.default_rng(4)
    matrices = generator.normal(size=(5, 6, 6))
    matrices = matrices + np.swapaxes(matrices, -1, -2)
    matrices[3, 2, :] = matrices[3, :, 2] = matrices[4] = 0.0
    right = generator.normal(size=(5, 6, 2))
    found, regular, below = solve_symmetric(matrices, right, np.array(counted, dtype=int))
    np.testing.assert_array_equal(regular, [True, True, True, False, False])
    np.testing.assert_allclose(matrices[:3] @ found[:3], right[:3], atol=1e-12)
    np.testing.assert_array_equal(found[3:], 0.0)
    values = np.linalg.eigvalsh(matrices[counted])
    np.testing.assert_array_equal(below, np.sum(values < -1e-12, axis=-1))


def test_none_of_no_member_and_none_of_zeros() -> None:
    assert negatives(np.zeros((0, 3, 3))).shape == (0,)
    assert list(negatives(np.zeros((2, 3, 3)))) == [0, 0]
