"""Negative eigenvalues are counted by pivots: as many as there are, without a search for them."""

from __future__ import annotations

import numpy as np
import pytest

from vjm.newton import negative_eigenvalues


@pytest.mark.parametrize("size", [1, 2, 6, 21, 40])
@pytest.mark.parametrize("diagonal", [1.0, 0.0])
def test_as_many_as_the_spectrum_has(size: int, diagonal: float) -> None:
    """Without a diagonal no single pivot is regular."""
    some = np.random.default_rng(size).standard_normal((100, size, size))
    symmetric = some + np.swapaxes(some, -1, -2)
    symmetric[:, range(size), range(size)] *= diagonal
    counted = np.sum(np.linalg.eigvalsh(symmetric) < 0.0, axis=-1)
    np.testing.assert_array_equal(negative_eigenvalues(symmetric), counted)


@pytest.mark.parametrize("closures", [6, 12])
def test_each_constraint_on_a_stable_body_is_one(closures: int) -> None:
    rng = np.random.default_rng(closures)
    root = rng.standard_normal((50, 20, 20))
    border = rng.standard_normal((50, closures, 20))
    none = np.zeros((50, closures, closures))
    whole = np.block([[root @ np.swapaxes(root, -1, -2), np.swapaxes(border, -1, -2)], [border, none]])
    assert set(negative_eigenvalues(whole)) == {closures}


def test_none_of_no_member_and_none_of_zeros() -> None:
    assert negative_eigenvalues(np.zeros((0, 3, 3))).shape == (0,)
    assert list(negative_eigenvalues(np.zeros((2, 3, 3)))) == [0, 0]
