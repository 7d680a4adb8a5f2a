"""Is it noise, and how large: exact null distributions, power against what models lack, unbiased sigmas."""

import numpy as np
import pytest
from scipy.stats import f, kstest

from pipeline.inference.noise import chi_square, lag_one, positive_form
from pipeline.inference.sensor_noise import from_repeats, from_roughness


@pytest.mark.parametrize(
    ("n", "m", "c"), [(3, 5, 1.2), (40, 60, 0.8), (500, 500, 1.1), (1, 2, 30.0), (2, 1, 0.01)]
)
def test_the_integral_gives_fishers_distribution(n: int, m: int, c: float) -> None:
    """P(sum of n squares / n > c times sum of m squares / m) is the F distribution's tail."""
    weights = np.concatenate([np.full(n, 1.0 / n), np.full(m, -c / m)])
    assert positive_form(weights) == pytest.approx(f.sf(c, n, m), abs=1e-8)


def test_forms_of_one_sign_are_certain() -> None:
    assert positive_form(np.array([1.0, 0.0])) == 1.0 and positive_form(np.array([-1.0, -2.0])) == 0.0


def straight(lengths: tuple[int, ...]) -> np.ndarray:
    """Derivative of a straight line in the step, common to all series."""
    return np.column_stack(
        [np.ones(sum(lengths)), np.concatenate([np.arange(n, dtype=float) for n in lengths])]
    )


@pytest.mark.parametrize(("fit", "scale"), [pytest.param(False, 1.0, marks=pytest.mark.long), (True, 5.0)])
def test_p_values_of_noise_are_uniform(fit: bool, scale: float) -> None:
    """Short series, where an asymptotic formula fails; with and without a fit, whatever the sigmas."""
    lengths, rng = (4, 6, 9), np.random.default_rng(2)
    design = straight(lengths)
    leave = np.eye(19) - design @ np.linalg.pinv(design) if fit else np.eye(19)
    found = []
    for _ in range(1000):
        r = scale * leave @ rng.normal(size=19)
        found.append(lag_one(np.split(r, [4, 10]), design if fit else None).p_value)
    # Kolmogorov-Smirnov at 1 %: fixed seed, so it is decided once.
    assert kstest(found, "uniform").pvalue > 0.01


def test_a_fit_that_is_forgotten_shifts_the_p_values() -> None:
    """The reason for `fitted`: residuals of a straight line look too unlike their neighbours."""
    design, rng = straight((12,)), np.random.default_rng(3)
    leave = np.eye(12) - design @ np.linalg.pinv(design)
    found = [lag_one([leave @ rng.normal(size=12)]).p_value for _ in range(500)]
    assert np.mean(np.array(found) < 0.5) < 0.35


def test_closed_and_numerical_eigenvalues_agree() -> None:
    rng = np.random.default_rng(4)
    series = [rng.normal(size=n) for n in (5, 8)]
    nothing = np.zeros((13, 1))
    assert (lag_one(series).degrees, lag_one(series, straight((5, 8))).degrees) == (13, 11)
    assert lag_one(series, nothing).p_value == pytest.approx(lag_one(series).p_value, abs=1e-9)


def test_a_smooth_misfit_is_seen_where_wide_sigmas_hide_its_size() -> None:
    """A wave in 16 tests, and sigmas so wide that the sum of squares is that of noise: its order is plain."""
    rng = np.random.default_rng(6)
    wave = 0.8 * np.sin(np.linspace(0.0, 2.0 * np.pi, 25))
    wide = np.sqrt(1.0 + np.mean(wave**2))
    series = [(wave + rng.normal(size=25)) / wide for _ in range(16)]
    noise = [rng.normal(size=25) for _ in range(16)]
    assert chi_square(np.concatenate(series)).p_value > 0.01 < lag_one(noise).p_value
    assert lag_one(series).p_value < 1e-4
    alone = [lag_one([one]).p_value for one in series]
    assert lag_one(series).p_value < min(alone), "tests together tell more than the best of them"


def test_chi_square_is_that_of_the_textbook() -> None:
    rng = np.random.default_rng(7)
    design = straight((10,))
    leave = np.eye(10) - design @ np.linalg.pinv(design)
    found = [chi_square(leave @ rng.normal(size=10), 2).p_value for _ in range(1500)]
    assert kstest(found, "uniform").pvalue > 0.01
    assert (
        chi_square(np.full(4, 2.0)).statistic == 16.0
        and chi_square(2.0 * rng.normal(size=200)).p_value < 1e-6
    )


def test_too_little_is_refused() -> None:
    with pytest.raises(ValueError, match="no degree of freedom"):
        chi_square(np.ones(2), 2)
    with pytest.raises(ValueError, match="2 degrees of freedom are left"):
        lag_one([np.ones(2)])
    with pytest.raises(ValueError, match="the residual is zero"):
        lag_one([np.zeros(5)])


def test_what_was_not_measured_never_passes_for_a_number() -> None:
    hole = np.array([1.0, 2.0, np.nan, 3.0])
    for call in (
        lambda: chi_square(hole),
        lambda: lag_one([hole]),
        lambda: from_repeats(hole, np.zeros(4, dtype=np.int64)),
        lambda: from_roughness([(np.arange(4.0), hole)]),
    ):
        with pytest.raises(ValueError, match="not finite"):
            call()


def test_sigma_of_repeats_is_unbiased_with_an_honest_error_bar() -> None:
    rng, group = np.random.default_rng(8), np.repeat(np.arange(4), 3)
    found = [from_repeats(5.0 * group + 0.02 * rng.normal(size=12), group) for _ in range(2000)]
    values = np.array([one.value for one in found], dtype=float)
    error = values.std() / np.sqrt(2000)
    assert abs(values.mean() - 0.02) < 3.0 * error
    # A spread from 2000 draws is known to 1.6 %; three times that.
    assert np.mean([one.std for one in found if one.std]) == pytest.approx(values.std(), rel=0.05)
    assert found[0].differences == 8
    assert from_repeats(np.ones(3), np.arange(3)).reason == "no step was repeated"


def readings(rng: np.random.Generator, sigma: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """Three tests with unevenly spaced loads there and back, a bent curve each, and noise."""
    paths = []
    for count in (9, 12, 15):
        load = np.concatenate([np.linspace(0.0, 1.0, count) ** 1.3, np.linspace(1.0, 0.0, count)[1:] ** 1.3])
        paths.append((load, 3.0 * load + 0.4 * load**2 + sigma * rng.normal(size=load.size)))
    return paths


@pytest.mark.long
def test_sigma_of_roughness_is_unbiased_with_an_honest_error_bar() -> None:
    rng = np.random.default_rng(10)
    found = [from_roughness(readings(rng, 0.02)) for _ in range(200)]
    values = np.array([one.value for one in found], dtype=float)
    assert abs(values.mean() - 0.02) < 3.0 * values.std() / np.sqrt(200)
    # A spread from 200 draws is known to 5 %; three times that.
    assert np.mean([one.std for one in found if one.std]) == pytest.approx(values.std(), rel=0.15)


@pytest.mark.long
def test_the_bias_of_few_differences_is_removed() -> None:
    """Nine differences: the uncorrected median is 8 % too high on average."""
    rng = np.random.default_rng(11)
    load = np.linspace(0.0, 1.0, 12)
    values = [from_roughness([(load, rng.normal(size=12))]).value or 0.0 for _ in range(400)]
    assert abs(np.mean(values) - 1.0) < 3.0 * np.std(values) / np.sqrt(400)


def test_jumps_where_the_load_turns_hardly_matter() -> None:
    """Friction of 25 sigma at the turn: a root mean square would be off by a factor of four."""
    rng, values = np.random.default_rng(12), []
    for _ in range(60):
        paths = [(load, y + 0.5 * (np.arange(load.size) > load.size // 2)) for load, y in readings(rng, 0.02)]
        values.append(from_roughness(paths).value or 0.0)
    assert np.mean(values) == pytest.approx(0.02, rel=0.35)


def test_held_loads_and_rounded_readings() -> None:
    rng = np.random.default_rng(13)
    held = from_roughness([(np.zeros(400), rng.normal(size=400))])
    assert held.value == pytest.approx(1.0, abs=3.0 * (held.std or 0.0))
    assert from_roughness([(np.arange(4.0), np.zeros(4))]).reason == "1 differences, allowed are 6 or more"
    assert "rounded" in from_roughness([(np.arange(30.0), np.zeros(30))]).reason


@pytest.mark.parametrize("size", [1e-200, 1e-310, 1e200])
def test_the_size_of_the_residual_does_not_count(size: float) -> None:
    """Nor does it where its squares are no floats any more."""
    series = np.split(np.random.default_rng(3).normal(size=12), [5])
    found, expected = lag_one([size * each for each in series]), lag_one(series)
    assert found.p_value == pytest.approx(expected.p_value, rel=1e-3)
