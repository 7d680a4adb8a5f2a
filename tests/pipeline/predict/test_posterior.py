"""The normal law about a fit: its split, its draws, and what it says is loose, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import norm

from pipeline.predict.budget import budget, variances
from pipeline.predict.posterior import Posterior
from pipeline.predict.sampling import LEVELS, quantiles
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.predict.bench import fitted
from vjm.effects import catalogue


def law(factor: float = 1.0) -> Posterior:
    return Posterior.of(fitted().fit, factor)


def test_the_parts_of_a_variance_are_those_of_the_law_of_total_variance() -> None:
    """Var y = E[Var(y | u)] + Var(E[y | u]), from the blocks of the covariance instead of the precision."""
    it = law()
    generator = np.random.default_rng(3)
    by_free = generator.normal(size=(4, it.count)) / it.sizes
    by_nominal = generator.normal(size=(4, len(it.numbers)))
    given, added = it.variances(by_free, by_nominal)
    own, p = by_free * it.sizes, it.count
    joint, inner = it.covariance, it.covariance[p:, p:]
    follows = joint[:p, p:] @ np.linalg.inv(inner)
    conditional = joint[:p, :p] - follows @ joint[p:, :p]
    np.testing.assert_allclose(given, np.einsum("ri,ij,rj->r", own, conditional, own), rtol=1e-8)
    moved = by_nominal + own @ follows
    np.testing.assert_allclose(added, np.einsum("ri,ij,rj->r", moved, inner, moved), rtol=1e-8)


def test_standard_errors_are_those_of_the_fit() -> None:
    """The weak prior of 20 typical sizes moves them by nothing."""
    np.testing.assert_allclose(law().std, fitted().fit.std, rtol=1e-4)


def test_more_than_noise_widens_parameters_and_not_what_is_written() -> None:
    """Of numbers that the readings do not see nothing changes, of parameters all."""
    once, twice = law(), law(2.0)
    by_free, nothing = np.ones((1, once.count)), np.zeros((1, len(once.numbers)))
    before, after = once.variances(by_free, nothing)[0], twice.variances(by_free, nothing)[0]
    assert after[0] == pytest.approx(4.0 * before[0], rel=1e-3)
    p = once.count
    assert np.all(np.diag(twice.covariance)[p:] <= 1.0 + 1e-12)


def test_draws_have_the_law_and_keep_to_the_bounds() -> None:
    it = law()
    values, departures = it.draws(4000, np.random.default_rng(0))
    off = np.concatenate([(values - it.model.values) / it.sizes, departures - it.departure], axis=1)
    root = np.linalg.inv(np.linalg.cholesky(it.covariance))
    np.testing.assert_allclose(np.cov(root @ off.T), np.eye(len(root)), atol=0.1)
    wide = Posterior(it.model, it.numbers, it.departure, 1e-6 * it.slopes)
    (low, high) = it.model.free[0].bounds
    drawn = wide.draws(200, np.random.default_rng(0))[0][:, 0]
    assert drawn.min() >= low and drawn.max() <= high


def test_parameters_that_only_show_together_are_named() -> None:
    """Scale of both bars and length of both bars: with the width they are three, of which tests without sideways load
    see two; what is seen alone is not named."""
    assert law().loose == ()
    it = law()
    blind = it.slopes.copy()
    blind[:, 0] = 0.0
    assert Posterior(it.model, it.numbers, it.departure, blind).loose == (("modulus_error.scale",),)


def test_sources_of_a_parameters_variance_sum_to_it() -> None:
    """Of independent errors of every reading, and of what is written: nothing is left over or counted twice."""
    it = law()
    total = sum(variances(fitted(), it).values())
    np.testing.assert_allclose(total, np.diag(it.covariance)[: it.count], rtol=1e-3)
    (only,) = budget(fitted(), it)
    assert only.parameter == "modulus_error.scale" and only.unit == "1"
    shares = [source.share for source in only.sources]
    assert shares == sorted(shares, reverse=True) and 0.5 < sum(shares) <= 1.0 + 1e-9


def test_quantiles_of_samples_are_those_of_their_law() -> None:
    """Of normal samples and normal noise: the sum of both; of two far lumps: their outer ends."""
    generator = np.random.default_rng(5)
    spread = np.full((1, 200), 0.6)
    low, middle, high = quantiles(0.8 * generator.standard_normal((60, 1, 200)), spread, LEVELS)
    assert np.mean(high) == pytest.approx(norm.ppf(0.975), rel=0.05)
    assert np.mean(low) == pytest.approx(norm.ppf(0.025), rel=0.05)
    assert np.mean(middle) == pytest.approx(0.0, abs=0.05)
    lumps = np.repeat([-10.0, 10.0], 30)[:, None, None]
    low, _, high = quantiles(lumps, np.full((1, 1), 1e-3), LEVELS)
    assert -22.0 < low[0, 0] < -10.0 < 10.0 < high[0, 0] < 22.0
    exact = quantiles(np.full((60, 1, 1), 2.0), np.full((1, 1), 0.5), LEVELS)
    assert exact[2][0, 0] == pytest.approx(2.0 + 0.5 * norm.ppf(0.975), abs=1e-6)


def test_what_hardly_shows_beside_the_rest_has_the_width_of_its_prior() -> None:
    """Two numbers that twenty readings see alike, by 1e9 sigma: their sum is known, their difference as by the weak
    prior, and draws have both. Of the product of the slopes Cholesky's method finds no root."""
    it = law()
    p, k = it.count, len(it.numbers)
    model = it.model.with_effects([catalogue()["load_offset"]])
    assert len(model.free) > p
    slopes = np.zeros((20, len(model.free) + k))
    slopes[:, 0] = slopes[:, 1] = 1e9
    close = Posterior(model, it.numbers, it.departure, slopes)
    widths = CRITERIA.plausible / np.sqrt(2.0)
    assert np.sqrt(close.covariance[0, 0]) == pytest.approx(widths, rel=1e-6)
    across = np.array([1.0, 1.0, *np.zeros(len(close.root) - 2)])
    assert np.linalg.norm(across @ close.root) < 1e-6
    values, _ = close.draws(20, np.random.default_rng(0))
    assert np.all(np.isfinite(values))
