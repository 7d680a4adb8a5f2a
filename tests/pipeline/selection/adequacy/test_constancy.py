"""Numbers that are the same in all tests, and friction that is there at one angle alone."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.selection.adequacy.constancy import largest_departure
from pipeline.selection.adequacy.judgement import judge
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

IDS = ("axial_held_q+0", "swing_q+0", "swing_q+30", "axial_held_q+15")


@cache
def friction(seed: int) -> Campaign:
    return bench("joint_friction.torque_Nmm", 150.0, IDS, seed)


def at_one_angle(seed: int) -> Campaign:
    """With friction at 30 degrees, without at 0."""
    pairs = zip(friction(seed).tests, bench(ids=IDS, seed=seed).tests, strict=True)
    return replace(friction(seed), tests=tuple(one if one.q > 0.3 else other for one, other in pairs))


def fitted(campaign: Campaign) -> Fit:
    names = ["bar_geometric_nonlinearity", "joint_friction"]
    model = Model().with_effects([catalogue()[name] for name in names])
    return best_fit(model, load_cases(campaign), names[1:])


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.long)])
def test_friction_at_one_angle_is_not_the_friction_of_a_hinge(seed: int) -> None:
    """One number for both angles fits neither; the check says which and where."""
    found = fitted(at_one_angle(seed))
    it = largest_departure(found)
    assert it is not None and it.name == "joint_friction.torque_Nmm"
    # What is more at one angle is less at the other, by what was hidden.
    assert it.change == pytest.approx(150.0 if "30" in it.where else -150.0, rel=0.4)
    (check,) = [each for each in judge(found).checks if each.name == "constancy"]
    assert not check.passed and check.words.startswith("joint_friction.torque_Nmm would be")


@pytest.mark.parametrize("seed", [1, *(pytest.param(it, marks=pytest.mark.long) for it in (2, 3))])
def test_friction_that_is_everywhere_is_constant(seed: int) -> None:
    """Nor do tests held out speak against it, though these swings hardly see the presliding: with seeds 1 and 3 it is
    fitted sixty times too small, ten standard errors off by the covariance there."""
    assert judge(fitted(friction(seed))).noise


def test_without_numbers_there_is_nothing_to_compare() -> None:
    model = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])
    assert largest_departure(best_fit(model, load_cases(bench(ids=IDS)))) is None
