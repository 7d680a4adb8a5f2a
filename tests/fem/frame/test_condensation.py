"""Elimination in pairs against one dense solve."""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.condensation import condense, inner_motion, negative_pivots, solve


@pytest.mark.parametrize("elements", [1, 2, 8, 16])
def test_condensed_and_dense(elements: int) -> None:
    rng = np.random.default_rng(elements)
    half = rng.normal(size=(elements, 12, 12))
    stiffness = half + np.swapaxes(half, 1, 2) + 8 * np.eye(12)
    sides = rng.normal(size=(elements, 12, 2))
    size = 6 * (elements + 1)
    whole, right = np.zeros((size, size)), np.zeros((size, 2))
    for e in range(elements):
        here = slice(6 * e, 6 * e + 12)
        whole[here, here] += stiffness[e]
        right[here] += sides[e]
    outer = np.r_[0:6, size - 6 : size]
    inner = np.arange(6, size - 6)
    condensed = condense(stiffness[None], sides[None])
    through = np.linalg.solve(whole[np.ix_(inner, inner)], np.c_[whole[np.ix_(inner, outer)], right[inner]])
    expected = whole[np.ix_(outer, outer)] - whole[np.ix_(outer, inner)] @ through[:, :12]
    np.testing.assert_allclose(condensed.stiffness[0], expected, atol=1e-8)
    np.testing.assert_allclose(
        condensed.sides[0], right[outer] - whole[np.ix_(outer, inner)] @ through[:, 12:], atol=1e-8
    )
    ends = rng.normal(size=12)
    np.testing.assert_allclose(
        inner_motion(condensed, ends[None])[0].ravel(), -through[:, :12] @ ends - through[:, 12], atol=1e-8
    )
    np.testing.assert_allclose(condensed.products[0], right[inner].T @ through[:, 12], atol=1e-8)
    if elements > 1:
        negative = (np.linalg.eigvalsh(whole[np.ix_(inner, inner)]) < 0).sum()
        assert negative_pivots(condensed)[0] == negative


def test_a_singular_system_is_named_and_spoils_no_other() -> None:
    found = solve(np.stack((np.zeros((2, 2)), 2 * np.eye(2))), np.ones((2, 2, 1)))
    assert np.isnan(found[0]).all()
    np.testing.assert_allclose(found[1], 0.5)
