"""What is learned from residuals: polynomials come back exactly, a process reverts to the mean, noise stays noise."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from pipeline.assessment.extrapolation.approaches import polynomial
from pipeline.discrepancy.gaussian import gaussian
from pipeline.discrepancy.regressors import Samples

Array = NDArray[np.float64]


def inputs(count: int, width: int) -> Array:
    found = np.random.default_rng(3).normal(size=(count, width))
    return np.asarray((found - found.mean(axis=0)) / found.std(axis=0))


def cubic(x: Array) -> Array:
    return np.asarray(40.0 - 30.0 * x[:, 0] + 20.0 * x[:, 0] * x[:, 1] + 8.0 * x[:, 1] ** 3)


def test_a_polynomial_is_reproduced_even_far_outside() -> None:
    """Damping at its least moves a coefficient by 1e-6 of itself over the readings, a few hundred here."""
    at = inputs(80, 2)
    learned = polynomial(Samples(at, cubic(at)))
    far = 3.0 * at
    np.testing.assert_allclose(learned(far), cubic(far), rtol=1e-5, atol=1e-3)


@pytest.mark.parametrize("learner", [polynomial, gaussian])
def test_noise_is_hardly_learned(learner) -> None:  # type: ignore[no-untyped-def]
    """A hundred readings of noise: what is made of them is far smaller, a constant alone being known to 0.1."""
    noise = np.random.default_rng(8).normal(size=100)
    learned = learner(Samples(inputs(100, 2), noise))
    assert np.sqrt(np.mean(learned(inputs(50, 2)) ** 2)) < 0.4


def test_a_process_interpolates_and_reverts_to_the_mean() -> None:
    """A sine of fifty sigmas; between the samples it is known to a sigma, twenty spreads away not at all."""
    at = inputs(60, 1)
    values = 7.0 + 50.0 * np.sin(2.0 * at[:, 0])
    noise = np.random.default_rng(5).normal(size=60)
    learned = gaussian(Samples(at, values + noise))
    between = np.linspace(-1.0, 1.0, 41)[:, None]
    off = learned(between) - (7.0 + 50.0 * np.sin(2.0 * between[:, 0]))
    assert np.sqrt(np.mean(off**2)) < 1.0
    far = learned(np.array([[20.0], [-20.0]]))
    np.testing.assert_allclose(far, np.mean(values + noise), atol=1e-3)


def test_a_process_does_not_learn_what_is_smaller_than_noise() -> None:
    """However smooth: half a sigma in six readings may be noise, which is known to be one."""
    at = np.linspace(-1.5, 1.5, 6)[:, None]
    assert np.abs(gaussian(Samples(at, 0.5 * np.sin(at[:, 0])))(at)).max() < 0.25


def test_a_process_is_the_same_every_time() -> None:
    at = inputs(40, 2)
    own = Samples(at, 10.0 * np.cos(at[:, 0]))
    np.testing.assert_array_equal(gaussian(own)(at), gaussian(own)(at))


@pytest.mark.parametrize("learner", [polynomial, gaussian])
def test_what_never_varies_is_a_constant(learner) -> None:  # type: ignore[no-untyped-def]
    """No input moves, or no value does: the mean, everywhere."""
    same = learner(Samples(np.zeros((5, 0)), np.array([1.0, 2.0, 3.0, 4.0, 5.0])))
    np.testing.assert_allclose(same(np.zeros((2, 0))), 3.0)
    flat = learner(Samples(inputs(9, 1), np.full(9, 2.5)))
    np.testing.assert_allclose(flat(inputs(3, 1)), 2.5)
