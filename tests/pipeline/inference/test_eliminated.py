"""Nuisance parameters eliminated from residuals, against the least squares that they stand for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pipeline.inference.eliminated import Marginal


def problem(seed: int, rows: int = 40, count: int = 5, size: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    generator = np.random.default_rng(seed)
    return generator.normal(size=rows), size * generator.normal(size=(rows, count))


@given(st.integers(0, 10_000), st.sampled_from([1e-3, 1.0, 1e4]), st.sampled_from([2, 5, 60]))
def test_what_is_left_is_the_least_of_residuals_and_departures_together(
    seed: int, size: float, count: int
) -> None:
    """As least squares with a reading more of each number, that it is zero."""
    residual, columns = problem(seed, 40, count, size)
    it = Marginal.of(columns)
    whole = np.vstack([columns, np.eye(count)])
    right = np.concatenate([residual, np.zeros(count)])
    best = np.linalg.lstsq(whole, right, rcond=None)[0]
    least = float(np.sum((right - whole @ best) ** 2))
    weakened = it.weakened(residual)
    assert weakened @ weakened == pytest.approx(least, rel=1e-6, abs=1e-12)
    np.testing.assert_allclose(it.pull @ residual, best, rtol=1e-5, atol=1e-7 * np.abs(best).max())


def test_a_covariance_is_that_of_the_least_squares() -> None:
    _, columns = problem(3)
    expected = np.linalg.inv(columns.T @ columns + np.eye(5))
    np.testing.assert_allclose(Marginal.of(columns).covariance, expected, rtol=1e-10)


def test_residuals_that_are_as_they_are_said_to_be_have_unit_covariance() -> None:
    _, columns = problem(4, 30)
    it = Marginal.of(columns)
    whole = np.eye(30) + columns @ columns.T
    root = it.weakened(np.eye(30))
    np.testing.assert_allclose(root @ whole @ root.T, np.eye(30), atol=1e-10)


def test_columns_without_size_change_nothing() -> None:
    residual, columns = problem(5)
    it = Marginal.of(0.0 * columns)
    np.testing.assert_array_equal(it.weakened(residual), residual)
    np.testing.assert_array_equal(it.pull @ residual, np.zeros(5))


def test_no_rows_are_no_news() -> None:
    it = Marginal.of(np.zeros((0, 3)))
    assert it.weakened(np.zeros(0)).size == 0
    np.testing.assert_array_equal(it.covariance, np.eye(3))


def test_no_variance_is_rounded_to_less_than_nothing() -> None:
    """Sensors a thousand million times finer than a tolerance, fewer or more readings than numbers."""
    generator = np.random.default_rng(3)
    for count in (2, 5, 40):
        columns = 1e9 * generator.normal(size=(count, 5)) * 10.0 ** generator.uniform(-9.0, 3.0, 5)
        variances = np.diag(Marginal.of(columns).covariance)
        assert np.all(variances > 0.0) and np.all(variances <= 1.0 + 1e-12)
