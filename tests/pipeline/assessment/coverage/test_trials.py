"""Effects of a finite-element bench are found where they are: without noise exactly, with noise as the bars say."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2

from pipeline.assessment.coverage.cases import BASE, PAIRS, is_size, typical
from pipeline.assessment.coverage.trial import Trial, exact, trial
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from vjm.effects import catalogue

FEW = ("modulus_error", "bar_initial_bow", "axis_flexibility", "load_offset", "joint_friction")
QUICK = (PAIRS[2],)


def found(names: tuple[str, ...], seed: int = 5) -> Trial:
    return trial("there", names, seed, 8, "")


def check(it: Trial, sigmas: float) -> None:
    """Noise is left, and every parameter lies within so many of its standard errors."""
    assert it.lost == 0 and chi2.sf(it.chi_square, it.degrees) > 1e-3
    assert all(d is not None and abs(d) < sigmas for d in it.deviations.values()), it.deviations


def exactly(names: tuple[str, ...]) -> None:
    """Two programs agree to far less than the sensors' noise: no parameter is off by half a standard error."""
    hidden = typical(names)
    cases = load_cases(exact(tuple(hidden.items()), 8))
    model = Model().with_effects([catalogue()[name] for name in dict.fromkeys([BASE, *names])])
    best = fit(model.at(np.array([np.clip(hidden[each.name], *each.bounds) for each in model.free])), cases)
    off = (best.model.values - [hidden[each.name] for each in model.free]) / best.std
    assert not best.prediction.lost.any()
    # Noise alone would leave one for each of nine hundred residuals.
    assert best.chi_square < 10.0 and np.all(np.abs(off) < 0.5), off


@pytest.mark.parametrize("name", FEW)
def test_readings_without_noise_give_the_truth(name: str) -> None:
    exactly((name,))


@pytest.mark.long
@pytest.mark.parametrize("name", sorted(set(catalogue()) - set(FEW)))
def test_readings_without_noise_give_the_truth_of_every_effect(name: str) -> None:
    exactly((name,))


@pytest.mark.parametrize("pair", QUICK)
def test_two_effects_at_once(pair: tuple[str, str]) -> None:
    """Three or four parameters and one noise: within four standard errors but for one in four thousand."""
    check(found(pair), 4.0)


@pytest.mark.long
@pytest.mark.parametrize("pair", sorted(set(PAIRS) - set(QUICK)))
def test_two_effects_at_once_of_every_pair(pair: tuple[str, str]) -> None:
    check(found(pair), 4.0)


def test_ten_pairs_and_more_of_known_effects() -> None:
    assert len(set(map(frozenset, PAIRS))) == len(PAIRS) >= 10
    assert {name for pair in PAIRS for name in pair} <= set(catalogue())


@pytest.mark.parametrize("name", ["modulus_error", "joint_torsional_stiffness"])
def test_an_absent_effect_is_held_to_be_possibly_absent(name: str) -> None:
    """One seed: an interval of 95 % holds null in nineteen of twenty."""
    it = trial("absent", (name,), 5, 8, "")
    assert it.inside and all(it.inside.values()) and chi2.sf(it.chi_square, it.degrees) > 1e-3


def test_a_presliding_angle_is_no_size() -> None:
    assert is_size("joint_friction", "torque_Nmm") and not is_size("joint_friction", "presliding_rad")
    assert typical(["joint_friction"]) == {
        "joint_friction.torque_Nmm": 309.0,
        "joint_friction.presliding_rad": 0.002,
    }


@pytest.mark.long
def test_a_curved_number_has_another_standard_error_on_either_side() -> None:
    """The turn before a hinge slips shows by its inverse: a small estimate has too small a symmetric standard error.

    This noise puts it 5.5 of them below the truth, and within three of those that the interval has on that side.
    """
    it = found(("joint_friction",), seed=65)
    name = "joint_friction.presliding_rad"
    straight, sided = it.symmetric[name], it.deviations[name]
    assert straight is not None and straight < -5.0
    assert sided is not None and -3.0 < sided < -2.0
