"""Sizes against their closed forms: non-central chi-square for detection, what correlation leaves for telling apart."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2

from pipeline.plan.isolability import apart, matrix, needed, visible
from pipeline.plan.seen import Seen
from pipeline.selection.criteria import CRITERIA
from vjm.effects import catalogue

EFFECTS = {name: catalogue()[name] for name in ("modulus_error", "bar_stiffness_asymmetry")}
GENERATOR = np.random.default_rng(3)


def two(rho: float, first: float, second: float) -> Seen:
    """Two signatures of these sizes and this correlation, beside a base that both contain in part."""
    basis = np.linalg.qr(GENERATOR.normal(size=(40, 3)))[0]
    a = first * basis[:, 0] + 5.0 * basis[:, 2]
    b = second * (rho * basis[:, 0] + np.sqrt(1.0 - rho**2) * basis[:, 1]) - 2.0 * basis[:, 2]
    columns = {"modulus_error": (a[:, None],), "bar_stiffness_asymmetry": (b[:, None],)}
    return Seen(columns, {}, 7.0 * basis[:, 2:], np.zeros((40, 0)), np.zeros(40, dtype=int), 1.0)


def test_an_effect_of_the_needed_size_is_let_in_nine_times_of_ten() -> None:
    size, draws = needed(3, 17), 200_000
    noise = GENERATOR.normal(size=(draws, 3)) + [size, 0.0, 0.0]
    share = np.mean(np.sum(noise**2, axis=1) > chi2.isf(CRITERIA.false_alarm / 17, 3))
    assert share == pytest.approx(0.9, abs=0.003)


@pytest.mark.parametrize("rho", [0.0, 0.6, 0.95])
def test_sizes_follow_correlation(rho: float) -> None:
    first, second = visible(two(rho, 50.0, 20.0), EFFECTS)
    least = needed(1, 2)
    assert first.rho == pytest.approx(rho, abs=1e-9)
    assert first.detected == pytest.approx(least / 50.0 * 0.05)
    assert second.detected == pytest.approx(least / 20.0 * 0.1)
    expected = max(least, apart() / np.sqrt(1.0 - rho**2)) / 50.0 * 0.05
    assert first.apart == pytest.approx(expected, rel=1e-6)
    names, alike = matrix(two(rho, 50.0, 20.0))
    assert names == list(EFFECTS)
    np.testing.assert_allclose(alike, [[1.0, rho], [rho, 1.0]], atol=1e-9)


def test_a_rival_is_excluded_in_95_of_100_at_that_size() -> None:
    """Simulated: two columns, the wrong one has to be worse by what the diagnosis asks for."""
    rho, draws = 0.9, 100_000
    size = apart() / np.sqrt(1.0 - rho**2)
    right, wrong = np.array([1.0, 0.0]), np.array([rho, np.sqrt(1.0 - rho**2)])
    data = size * right + GENERATOR.normal(size=(draws, 2))
    worse = (data @ right) ** 2 - (data @ wrong) ** 2
    assert np.mean(worse > CRITERIA.exclusion) == pytest.approx(0.95, abs=0.005)


def test_what_is_all_alike_is_never_told_apart() -> None:
    assert all(v.apart is None for v in visible(two(1.0, 50.0, 20.0), EFFECTS))


def test_more_tests_show_more() -> None:
    one = two(0.6, 50.0, 20.0)
    (alone, _), (both, _) = visible(one, EFFECTS), visible(one.and_(one), EFFECTS)
    assert alone.detected is not None and both.detected == pytest.approx(alone.detected / np.sqrt(2.0))
