"""What is noise passes, and what a sensor did wrong is seen and said, with the right words."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.judgement import judge
from tests.pipeline.selection.bench import Fault, bench, creeping_gauge, cross_talk, growing_gain, with_fault
from vjm.effects import catalogue

EFFECTS = catalogue()
MODEL = Model().with_effects([EFFECTS["bar_geometric_nonlinearity"], EFFECTS["modulus_error"]])


def fitted(campaign: Campaign) -> Fit:
    return fit(MODEL, load_cases(campaign))


@cache
def clean(seed: int) -> Fit:
    return fitted(bench(seed=seed))


@pytest.mark.parametrize("seed", range(6))
def test_noise_passes(seed: int) -> None:
    """Six checks of chance at 8e-4 each: noise fails one of them once in two hundred campaigns."""
    assert judge(clean(seed)).noise


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        (growing_gain, "fx has a gain that grows"),
        (creeping_gauge, "mid has a zero that moves during a test"),
        (cross_talk, "fy answers to fx"),
    ],
)
def test_faults_of_sensors_are_seen(fault: Fault, words: str) -> None:
    found = judge(fitted(with_fault(bench(), fault)))
    assert not found.noise
    (pattern,) = [check for check in found.checks if check.name == "patterns"]
    assert not pattern.passed
    assert words in pattern.words


def test_a_missing_effect_is_seen_in_tests_held_out() -> None:
    """A softer bar that the model does not have."""
    campaign = bench("modulus_error.scale", 0.9)
    without = Model().with_effects([EFFECTS["bar_geometric_nonlinearity"]])
    checks = {check.name: check for check in judge(fit(without, load_cases(campaign))).checks}
    assert not checks["held out"].passed
    assert not checks["size"].passed


def test_scatter_beyond_the_sigmas_is_told_from_a_misfit() -> None:
    """Sigmas 14 % too small without any order: noise, and said so."""
    found = clean(0)
    larger = Fit(found.model, found.prediction, found.residual, 1)
    object.__setattr__(larger, "whitened", found.whitened * 1.14 * np.sqrt(found.degrees / found.chi_square))
    judgement = judge(larger)
    (size,) = [check for check in judgement.checks if check.name == "size"]
    assert judgement.scatter == pytest.approx(1.14, rel=1e-6)
    assert size.passed
    assert "14 % larger than the sigmas say" in size.words
