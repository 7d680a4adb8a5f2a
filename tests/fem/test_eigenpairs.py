"""Largest eigenvalues with every member of a multiple one, more members than the search starts with too."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.linalg import eigh

from fem import eigenpairs
from fem.eigenpairs import largest_eigenpairs
from fem.solvers import direct
from meshes.solid import Floats


def pencil(values: Floats) -> tuple[Floats, Floats]:
    """Symmetric A and positive definite K, full, with these eigenvalues (n,)."""
    rng = np.random.default_rng(3)
    size = len(values)
    root = np.eye(size) + 0.3 * rng.standard_normal((size, size)) / np.sqrt(size)
    turn = np.linalg.qr(rng.standard_normal((size, size)))[0]
    a = root.T @ (turn * values) @ turn.T @ root
    return 0.5 * (a + a.T), root.T @ root


@pytest.mark.parametrize(
    ("top", "count", "members"),
    [
        ([9.0, 8.0, 7.0, 6.0], 3, 3),
        ([9.0, 8.0, 8.0, 6.0], 2, 3),
        ([9.0, 9.0, 9.0, 9.0, 3.0], 1, 4),
        ([9.0, *[5.0] * 7, 3.0], 2, 8),
        ([9.0, *[5.0] * 12, 3.0], 4, 13),
    ],
)
def test_every_member_is_found(top: list[float], count: int, members: int) -> None:
    """`members` of them: those asked for and the twins of the last one; as a dense solver has them."""
    values = np.concatenate((top, np.linspace(1.0, -20.0, 180)))
    a, k = pencil(values)
    found, vectors = largest_eigenpairs(a, direct(sp.csr_matrix(k)), count)
    assert len(found) == members
    np.testing.assert_allclose(found, eigh(a, k, eigvals_only=True)[::-1][:members], rtol=1e-10)
    np.testing.assert_allclose(vectors.T @ k @ vectors, np.eye(members), atol=1e-10)
    np.testing.assert_allclose(a @ vectors, k @ vectors * found, atol=1e-4)


@pytest.mark.parametrize("size", [1, 3, 5, 11])
def test_small_matrices_are_solved_whole(size: int) -> None:
    a, k = pencil(np.linspace(3.0, -2.0, size))
    found, _ = largest_eigenpairs(a, direct(sp.csr_matrix(k)), min(3, size))
    np.testing.assert_allclose(found, np.linspace(3.0, -2.0, size)[: min(3, size)], rtol=1e-10, atol=1e-10)


def test_what_does_not_settle_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(eigenpairs, "MOST_STEPS", 2)
    a, k = pencil(np.linspace(1.0, 0.9, 200))
    with pytest.raises(RuntimeError, match="did not settle in 2 steps"):
        largest_eigenpairs(a, direct(sp.csr_matrix(k)), 3)
