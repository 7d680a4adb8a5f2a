"""Noise in proportion to readings, and gains that are known to a tolerance: of fits and of what they answer for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import nominals
from pipeline.inference.suitable import named_effects
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

SOFT = 0.95
FORCES = np.arange(6, 12)


def read_with(share: float, gains: np.ndarray, seed: int) -> Campaign:
    """The bench with a softer bar, its load cell with noise in proportion and gains (6,) beside its own noise."""
    it, generator = bench("modulus_error.scale", SOFT), np.random.default_rng(seed)
    tests = []
    for test in it.tests:
        wrench = (
            test.data.wrench * (1.0 + share * generator.normal(size=test.data.wrench.shape)) * (1.0 + gains)
        )
        tests.append(replace(test, data=replace(test.data, wrench=wrench)))
    return replace(it, tests=tuple(tests))


def of_wrench(value: float) -> np.ndarray:
    out = np.zeros(13)
    out[FORCES] = value
    return out


def fitted(it: Campaign) -> Fit:
    effects = named_effects(["bar_geometric_nonlinearity", "modulus_error"], catalogue())
    return fit(Model().with_effects(effects), load_cases(it))


def std(found: Fit) -> float:
    return float(np.sqrt(np.linalg.inv(found.jacobian.T @ found.jacobian)[0, 0]))


@pytest.mark.parametrize("seed", [1, 2])
def test_noise_in_proportion_is_noise_where_it_is_said(seed: int) -> None:
    it = read_with(0.004, np.zeros(6), seed)
    silent, said = fitted(it), fitted(replace(it, noise=replace(it.noise, of_reading=of_wrench(0.004))))
    assert silent.chi_square > 2.0 * silent.degrees
    assert said.chi_square == pytest.approx(said.degrees, rel=0.25)
    assert abs(said.model.values[0] - SOFT) < 3.0 * std(said)
    assert std(said) > 1.3 * std(silent)


def test_where_nothing_is_said_nothing_changes() -> None:
    it = read_with(0.0, np.zeros(6), 1)
    zero = replace(it, noise=replace(it.noise, of_reading=of_wrench(0.0), gain=of_wrench(0.0)))
    one, other = fitted(it), fitted(zero)
    assert one.chi_square == other.chi_square and one.model.values[0] == other.model.values[0]
    assert nominals(zero) == ()


def test_gains_within_their_tolerance_are_no_effect() -> None:
    """The bar's modulus is known as well as the gains are, and its interval says so."""
    gains = 0.005 * np.random.default_rng(4).normal(size=6)
    it = read_with(0.0, gains, 1)
    silent, said = fitted(it), fitted(replace(it, noise=replace(it.noise, gain=of_wrench(0.005))))
    assert silent.chi_square > 1.25 * silent.degrees
    assert said.chi_square == pytest.approx(said.degrees, rel=0.25)
    assert abs(said.model.values[0] - SOFT) < 3.0 * std(said)
    assert 0.3 * 0.005 < std(said) < 0.005


def test_a_gain_that_is_seen_is_found() -> None:
    """Beside a bar that is known: each gain moves to what it is, in standard deviations of what was written."""
    gains = np.array([0.01, -0.008, 0.0, 0.0, 0.0, 0.0])
    it = read_with(0.0, gains, 1)
    it = replace(it, noise=replace(it.noise, gain=of_wrench(0.005)))
    names = [each.name for each in nominals(it)]
    assert names == [f"gain of {column}" for column in ("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm")]
    effects = named_effects(["bar_geometric_nonlinearity", "modulus_error"], catalogue())
    known = Model(fixed=frozenset({"modulus_error.scale"})).with_effects(effects)
    known = replace(
        known, terms=tuple(replace(t, values={"scale": SOFT} if t.values else {}) for t in known.terms)
    )
    found = fit(known, load_cases(it))
    moved = dict(zip(names, found.prediction.nominal, strict=True))
    assert moved["gain of fx_N"] == pytest.approx(2.0, abs=0.3)
    assert moved["gain of fy_N"] == pytest.approx(-1.6, abs=0.3)
