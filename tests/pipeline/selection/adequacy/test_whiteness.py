"""Noise is white whatever was fitted to it; a shape that turns its sign from row to row is not."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import block_diag
from scipy.stats import kstest

from pipeline.inference.orthonormal_basis import basis
from pipeline.selection.adequacy.whiteness import departures

LENGTHS = (4, 12, 9, 15)


def series(residual: np.ndarray) -> list[np.ndarray]:
    return np.split(residual, np.cumsum(LENGTHS)[:-1])


def lines() -> np.ndarray:
    """What a slope and a level of each path span."""
    return basis(block_diag(*[np.vander(np.linspace(0.0, 1.0, n), 2) for n in LENGTHS]))


@pytest.mark.parametrize("fitted", [False, True])
@pytest.mark.parametrize("degrees", [np.inf, 3.0])
def test_of_noise_both_departures_are_standard_normal(fitted: bool, degrees: float) -> None:
    """Of Student's noise too: the ratio is free of the size of what it is made of."""
    rng, count = np.random.default_rng(5), sum(LENGTHS)
    taken = lines() if fitted else np.zeros((count, 0))
    draws = rng.normal(size=(4000, count)) if np.isinf(degrees) else rng.standard_t(degrees, (4000, count))
    left = draws - (draws @ taken) @ taken.T
    found = np.array([departures(series(one), taken) for one in left])
    assert found.shape == (4000, 2)
    assert np.abs(found.mean(axis=0)).max() < 0.06
    assert np.abs(found.std(axis=0) - 1.0).max() < 0.08
    assert max(kstest(one, "norm").statistic for one in found.T) < 0.045
    assert np.mean(np.abs(found) > 3.5) < 2e-3


def test_without_the_slopes_that_were_fitted_noise_would_look_as_if_it_turned() -> None:
    rng, count = np.random.default_rng(6), sum(LENGTHS)
    draws, taken = rng.normal(size=(2000, count)), lines()
    left = draws - (draws @ taken) @ taken.T
    found = np.array([departures(series(one), np.zeros((count, 0))) for one in left])
    assert np.all(found.mean(axis=0) < -0.8)


@pytest.mark.parametrize(("step", "lag"), [(0.0, 0), (2.9, 0), (np.pi / 2.0, 1)])
def test_a_shape_is_seen_at_one_lag_or_the_other(step: float, lag: int) -> None:
    """Alike, by turns, and by turns of every second row, of three sigmas at its largest."""
    rng, count = np.random.default_rng(7), sum(LENGTHS)
    shape = 3.0 * np.cos(step * np.arange(count) + 0.4)
    found = departures(series(shape + rng.normal(size=count)), np.zeros((count, 0)))
    assert abs(found[lag]) > 3.5


def test_nothing_is_said_of_what_is_too_short_or_empty() -> None:
    assert departures([], np.zeros((0, 0))) == []
    assert departures([np.ones(2)], np.zeros((2, 0))) == []
    assert departures([np.zeros(5)], np.zeros((5, 0))) == []
    assert departures([np.ones(1)] * 9, np.zeros((9, 0))) == []
