"""Signatures of a misfit: known truths come back with honest error bars, and noise raises no more flags than stated."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.compare.misfit import Array, Series, direction, flagged, misfit

SEEDS = 300


def bench() -> Series:
    """Four tests of 24 steps: loads up and down through both signs, three angles, a warming room; no residual yet."""
    up = np.linspace(-400.0, 800.0, 13)
    load = np.concatenate([np.concatenate([up, up[::-1][1:-1]]) + 3.0 * k for k in range(4)])
    count = load.size // 4
    test = np.repeat(np.arange(4), count)
    q = np.array([-0.5, 0.0, 0.2, 0.5])[test]
    step = np.tile(np.arange(count, dtype=float), 4)
    temperature = 20.0 + 0.4 * np.sin(0.9 * np.arange(load.size)) + 0.3 * test
    # Sensors of two qualities: the weights have to matter.
    sigma = np.where(test == 2, 0.004, 0.001)
    return Series(np.zeros_like(load), load, sigma, q, step, test, temperature, unit="mm")


def regressors(series: Series) -> dict[str, Array]:
    """What each number is the coefficient of, written down a second time."""
    s, turn = series.load, np.abs(series.q) - np.mean(np.abs(series.q))
    band = np.array([max(-1.0, min(1.0, 20.0 * value / np.max(np.abs(s)))) for value in s])
    assert series.temperature is not None
    return {
        "offset": np.ones_like(s),
        "slope": s,
        "curvature": s * s,
        "asymmetry": np.where(s > 0, s, -s),
        "dead_band": band,
        "loop": direction(s, series.test) / (2.0 * (s.max() - s.min())),
        "step": series.step,
        "temperature": series.temperature,
        "q": series.q,
        "slope_q": s * turn,
    }


@pytest.mark.parametrize("name", regressors(bench()))
def test_a_known_truth_comes_back_with_an_honest_error_bar(name: str) -> None:
    """Bias below three standard errors of the mean; the 95 % interval holds the truth in 92 to 98 % of the seeds."""
    empty = bench()
    shape = regressors(empty)[name]
    truth = 0.003 / np.max(np.abs(shape))
    under = 0.002 - 1e-6 * empty.load if name not in ("offset", "slope") else 0.0
    mean = (truth * shape + under) / empty.sigma
    rng = np.random.default_rng(17)
    found = [misfit(replace(empty, residual=mean + rng.normal(size=mean.size)))[name] for _ in range(SEEDS)]
    values, std = np.array([s.value for s in found]), found[0].std
    assert abs(values.mean() - truth) < 3.0 * std / np.sqrt(SEEDS)
    assert 0.92 <= np.mean(np.abs(values - truth) < 1.96 * std) <= 0.98
    assert found[0].significance == pytest.approx(abs(found[0].value) / std)


@pytest.mark.long
def test_noise_raises_no_more_flags_than_stated() -> None:
    """1000 benches of pure noise: any of eleven numbers is flagged in at most 5 % (plus three sigma of that count)."""
    empty, rng = bench(), np.random.default_rng(5)
    numbers = [
        misfit(replace(empty, residual=rng.normal(size=empty.load.size))).signatures for _ in range(1000)
    ]
    assert {len(found) for found in numbers} == {11}
    share = np.mean([bool(flagged(found)) for found in numbers])
    # Bonferroni gives away little with eleven numbers, half of them independent: it must not be idle either.
    assert 0.02 < share < 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / 1000)
    many = [s for found in numbers[:100] for s in found]
    assert len(flagged(many)) <= 2, "1100 numbers are looked at together"


def test_a_misfit_that_grows_with_the_load_is_seen_in_its_scatter() -> None:
    empty, rng = bench(), np.random.default_rng(8)
    noise = rng.normal(size=empty.load.size)
    assert misfit(replace(empty, residual=noise))["scatter"].significance < 3.0
    grown = misfit(replace(empty, residual=noise * (0.3 + 0.004 * np.abs(empty.load))))
    assert grown["scatter"].value > 0.0 and "scatter" in {s.name for s in flagged(grown.signatures)}


def test_scatter_of_noise_is_normal() -> None:
    empty, rng = bench(), np.random.default_rng(9)
    found = [
        misfit(replace(empty, residual=rng.normal(size=empty.load.size)))["scatter"] for _ in range(1000)
    ]
    scores = np.array([s.value / s.std for s in found])
    assert abs(scores.mean()) < 3.0 / np.sqrt(1000) and abs(scores.std() - 1.0) < 3.0 / np.sqrt(2000)


def test_friction_play_and_asymmetry_are_flagged_as_what_they_are() -> None:
    """Residuals of the physics rather than of the regressor: the right number is the most significant one."""
    empty = bench()
    s = empty.load
    friction = 0.006 * direction(s, empty.test) / empty.sigma
    play = 0.006 * np.sign(s) / empty.sigma
    softer = np.where(s > 0, 2e-5 * s, 0.0) / empty.sigma
    for residual, name in ((friction, "loop"), (play, "dead_band"), (softer, "asymmetry")):
        numbers = [
            n
            for n in misfit(replace(empty, residual=residual)).signatures
            if n.name not in ("offset", "slope", "scatter")
        ]
        assert max(numbers, key=lambda n: n.significance).name == name
    area = misfit(replace(empty, residual=friction))["loop"].value
    # A gap of twice 6 µm over the whole range; the turning points have no partner at their load.
    assert area == pytest.approx(2 * 0.006 * (s.max() - s.min()), rel=0.02)


def test_what_cannot_be_told_is_omitted_with_its_reason() -> None:
    load = np.linspace(100.0, 500.0, 9)
    zero = np.zeros_like(load)
    one_way = Series(zero, load, np.ones(9), zero, np.arange(9.0), np.zeros(9, dtype=np.int64))
    found = misfit(one_way)
    assert {s.name for s in found.signatures} == {"offset", "slope", "curvature", "scatter"}
    assert found.omitted["temperature"] == "not measured"
    for name in ("asymmetry", "dead_band", "loop", "step", "q", "slope_q"):
        assert "do not tell it" in found.omitted[name]
    held = misfit(replace(one_way, load=zero))
    assert {s.name for s in held.signatures} == {"offset", "step"} and flagged(()) == ()


def test_directions_start_anew_with_each_test() -> None:
    load, test = np.array([0.0, 1, 2, 1, 5, 4, 4, 7]), np.array([0, 0, 0, 0, 1, 1, 1, 2])
    assert direction(load, test).tolist() == [1, 1, 1, -1, -1, -1, 0, 0]


def test_numbers_do_not_depend_on_the_unit_of_the_load() -> None:
    series = replace(bench(), residual=np.random.default_rng(1).normal(size=96))
    thousand = misfit(replace(series, load=1e3 * series.load))
    for one in misfit(series).signatures:
        assert thousand[one.name].significance == pytest.approx(one.significance, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"load": np.zeros(3)}, "load has shape"),
        ({"residual": np.full(96, np.nan)}, "not finite"),
        ({"sigma": np.zeros(96)}, "sigma must be positive"),
    ],
)
def test_series_that_make_no_sense_are_refused(change: dict[str, Array], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        replace(bench(), **change)
