"""The evidence of a function at a site: against normal densities, and on residuals without any function."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from pipeline.discover.bases import KNOTS, basis_of, hats, knots, priors, sliders
from pipeline.discover.evidence import Columns, Rest
from pipeline.selection.criteria import CRITERIA

TESTS, STEPS = 6, 20
FIRST = np.arange(0, TESTS * STEPS + 1, STEPS)


def rest_of(residuals: np.ndarray, tolerance: np.ndarray | None = None) -> Rest:
    rows = np.arange(residuals.size) % (TESTS * STEPS)
    order = np.argsort(rows, kind="stable")
    rows = rows[order]
    some = np.zeros((residuals.size, 0)) if tolerance is None else tolerance
    return Rest(residuals, rows, rows // STEPS, FIRST, some, np.zeros((residuals.size, 0)))


def columns(
    c: np.ndarray, influence: np.ndarray, rows: np.ndarray, first: np.ndarray, largest: float
) -> np.ndarray:
    return np.asarray(influence[:, None] * basis_of(c, first, largest)[rows])


def history(seed: int) -> np.ndarray:
    generator = np.random.default_rng(seed)
    turns = generator.uniform(-1.0, 1.0, (TESTS, 3))
    ways = [np.interp(np.linspace(0, 3, STEPS), range(4), [0.0, *own]) for own in turns]
    return np.concatenate(ways)


def test_it_is_the_ratio_of_two_normal_densities() -> None:
    generator = np.random.default_rng(1)
    c, count = history(1), TESTS * STEPS
    influence, tolerance = generator.normal(size=count), generator.normal(size=(count, 2))
    e = 2.0 * generator.normal(size=count)
    rest = rest_of(e, tolerance)
    site = Columns(columns(c, influence, rest.rows, FIRST, 1.0), 1.0)
    found = rest.evidence(site)
    noise = np.eye(count) + tolerance @ tolerance.T
    root = found.size * found.prior.root
    whole = noise + site.values @ root @ root.T @ site.values.T
    ratio = multivariate_normal.logpdf(e, cov=whole) - multivariate_normal.logpdf(e, cov=noise)
    assert found.value == pytest.approx(ratio, rel=1e-6, abs=1e-6)


def test_no_law_is_proposed_in_white_residuals() -> None:
    highest = 0.0
    for seed in range(300):
        generator = np.random.default_rng([7, seed])
        rest = rest_of(generator.normal(size=TESTS * STEPS))
        influence = generator.normal(size=TESTS * STEPS)
        site = Columns(columns(history(seed), influence, rest.rows, FIRST, 1.0), 1.0)
        highest = max(highest, rest.evidence(site).value)
    assert 0.5 < highest < CRITERIA.law_proposed


def test_noise_that_is_correlated_from_row_to_row_is_no_law() -> None:
    """Taken for white it is one; in units of what it is, it is none."""
    apart = np.abs(np.subtract.outer(np.arange(STEPS), np.arange(STEPS)))
    root = np.kron(np.eye(TESTS), np.linalg.cholesky(0.85**apart))
    as_white, as_it_is = [], []
    for seed in range(30):
        generator = np.random.default_rng([11, seed])
        rest = rest_of(root @ generator.normal(size=TESTS * STEPS))
        site = columns(history(seed), np.ones(TESTS * STEPS), rest.rows, FIRST, 1.0)
        as_white.append(rest.evidence(Columns(site, 1.0)).value)
        own = rest.with_noise(lambda it: np.linalg.solve(root, it))
        as_it_is.append(own.evidence(Columns(own.seen(site), 1.0)).value)
    assert sum(value > CRITERIA.law_proposed for value in as_white) >= 5
    assert max(as_it_is) < CRITERIA.law_proposed


def test_unknown_zeros_stay_out_in_units_of_correlated_noise() -> None:
    generator = np.random.default_rng(2)
    zeros = np.linalg.qr(generator.normal(size=(TESTS * STEPS, 2)))[0]
    rest = replace(rest_of(generator.normal(size=TESTS * STEPS)), zeros=zeros)
    root = np.tril(generator.normal(size=(TESTS * STEPS, TESTS * STEPS))) + 15.0 * np.eye(TESTS * STEPS)
    own = rest.with_noise(lambda it: np.linalg.solve(root, it))
    assert np.abs(own.seen(zeros)).max() < 1e-12
    shifted = replace(rest, residuals=rest.residuals + zeros @ [3.0, -5.0]).with_noise(own.correlated)  # type: ignore[arg-type]
    assert shifted.residuals == pytest.approx(own.residuals, abs=1e-10)


@pytest.mark.parametrize("kind", ["curve", "loop"])
def test_a_function_is_found_with_its_shape(kind: str) -> None:
    generator = np.random.default_rng(3)
    c = history(3)
    influence = 5.0 * generator.normal(size=c.size)
    truth = c**3 if kind == "curve" else sliders(c, FIRST, 1.0)[:, 2]
    rest = rest_of(influence * truth + generator.normal(size=c.size))
    found = rest.evidence(Columns(columns(c, influence, rest.rows, FIRST, 1.0), 1.0))
    assert found.value > 30.0
    assert (found.prior.memory > 0.0) is (kind == "loop")
    told = basis_of(c, FIRST, 1.0) @ found.weights
    assert np.sqrt(np.mean((told - truth) ** 2)) < 0.1
    gains = rest.gains(found.site.values, found.size * found.prior.root, rest.parts(1))
    assert gains.size == TESTS and gains.sum() - gains.max() > CRITERIA.law_proposed


def test_gains_of_left_out_tests_are_by_the_covariance_of_what_the_others_foresee() -> None:
    generator = np.random.default_rng(4)
    c, count = history(4), TESTS * STEPS
    tolerance = generator.normal(size=(count, 2))
    rest = rest_of(generator.normal(size=count) + 3.0 * c, tolerance)
    own = columns(c, generator.normal(size=count), rest.rows, FIRST, 1.0)
    root = np.diag(generator.uniform(0.1, 2.0, own.shape[1]))
    noise = np.eye(count) + tolerance @ tolerance.T
    whole = noise + own @ root @ root.T @ own.T

    def unforeseen(covariance: np.ndarray, mine: np.ndarray) -> np.ndarray:
        weights = np.linalg.solve(covariance[np.ix_(~mine, ~mine)], rest.residuals[~mine])
        return np.asarray(rest.residuals[mine] - covariance[np.ix_(mine, ~mine)] @ weights)

    expected = []
    for mine in (rest.tests == test for test in range(TESTS)):
        slope = np.linalg.solve(whole[np.ix_(~mine, ~mine)], whole[np.ix_(~mine, mine)])
        known = whole[np.ix_(mine, mine)] - whole[np.ix_(mine, ~mine)] @ slope
        alone, with_them = (unforeseen(it, mine) for it in (noise, whole))
        size = np.linalg.inv(known)
        expected.append(float(alone @ size @ alone - with_them @ size @ with_them))
    assert rest.gains(own, root, rest.tests) == pytest.approx(np.array(expected), abs=1e-8)


def test_tests_that_have_nothing_in_common_do_not_speak_for_a_function() -> None:
    """Each in a range of its own, off by a constant of its own: a function of the range explains all of them."""
    test = np.arange(TESTS * STEPS) // STEPS
    proposed = []
    for seed in range(20):
        generator = np.random.default_rng([13, seed])
        c = (test + generator.uniform(0.0, 1.0, test.size)) / TESTS
        rest = rest_of(4.0 * generator.normal(size=TESTS)[test] + generator.normal(size=test.size))
        found = rest.evidence(Columns(columns(c, np.ones(test.size), rest.rows, FIRST, 1.0), 1.0))
        gains = rest.gains(found.site.values, found.size * found.prior.root, rest.parts(1))
        proposed.append(found.value > 30.0 and gains.sum() - gains.max() >= CRITERIA.law_left_out)
    assert sum(proposed) <= 4


def test_a_test_that_goes_further_than_the_others_does_not_speak_against_a_function() -> None:
    """By the mean alone that the others foresee, the one that goes ten times as far outweighs all they gain."""
    generator = np.random.default_rng(15)
    c = history(15)
    c[: FIRST[1]] *= 10.0
    influence = 10.0 * generator.normal(size=c.size)
    rest = rest_of(influence * np.clip(c, -1.0, 1.0) ** 3 + generator.normal(size=c.size))
    found = rest.evidence(Columns(columns(c, influence, rest.rows, FIRST, 10.0), 10.0))
    gains = rest.gains(found.site.values, found.size * found.prior.root, rest.parts(1))
    assert gains.sum() - gains.max() >= CRITERIA.law_left_out


def test_what_was_written_does_not_count_as_a_law() -> None:
    generator = np.random.default_rng(5)
    c = history(5)
    influence = generator.normal(size=c.size)
    # A number that was written, two standard deviations off, acts just as a linear law would.
    tolerance = 20.0 * (influence * c)[:, None]
    e = 2.0 * tolerance[:, 0] + generator.normal(size=c.size)
    of = columns(c, influence, np.arange(c.size), FIRST, 1.0)
    with_it, without = rest_of(e, tolerance), rest_of(e)
    assert with_it.evidence(Columns(of, 1.0)).value < 8.0
    assert without.evidence(Columns(of, 1.0)).value > 100.0


def test_scales_of_coordinate_and_influence_do_not_matter() -> None:
    generator = np.random.default_rng(9)
    c = history(9)
    influence = generator.normal(size=c.size)
    rest = rest_of(3.0 * influence * np.tanh(3.0 * c) + generator.normal(size=c.size))
    values = [
        rest.evidence(Columns(columns(a * c, b * influence, rest.rows, FIRST, a), a)).value
        for a, b in ((1.0, 1.0), (1e3, 1e-6), (1e-4, 1e5))
    ]
    assert values == pytest.approx([values[0]] * 3, rel=1e-6)


def test_hats_add_up_to_one_and_meet_their_knots() -> None:
    at = knots(2.0)
    assert at.size == KNOTS and at[0] == -2.0 and at[-1] == 2.0
    assert hats(at, at) == pytest.approx(np.eye(KNOTS))
    x = np.linspace(-3.0, 3.0, 50)
    assert hats(x, at).sum(axis=1) == pytest.approx(np.ones(50))
    assert hats(x, at) @ at == pytest.approx(np.clip(x, -2.0, 2.0))


def test_a_slider_starts_relaxed_in_each_test_and_stays_at_its_reach() -> None:
    x = np.array([0.1, 0.6, 0.5, -0.5, 0.3, 0.3])
    held = sliders(x, np.array([0, 4, 6]), 1.0)
    # Reach 0.2: 0.1, 0.2, 0.1, -0.2 and, relaxed again, 0.2, 0.2.
    assert held[:, 3] * 0.2 == pytest.approx([0.1, 0.2, 0.1, -0.2, 0.2, 0.2])


def test_every_prior_is_a_covariance() -> None:
    for prior in priors():
        assert np.all(np.linalg.eigvalsh(prior.root @ prior.root.T) > -1e-9)


def test_few_tests_are_parted_into_blocks() -> None:
    rest = rest_of(np.zeros(TESTS * STEPS))
    explained = np.where(rest.tests == 2, 1.0, 0.0)
    assert rest.seen_in(explained) == pytest.approx(1.0)
    assert rest.seen_in(np.ones(explained.size)) == pytest.approx(TESTS)
    parts = rest.parts(4)
    assert np.unique(parts).size == 4 * TESTS
    assert np.all(np.bincount(parts) == STEPS // 4)
