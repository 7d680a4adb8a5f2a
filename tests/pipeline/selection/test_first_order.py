"""First-order chi-square of sets of effects, against fits with the full model."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prior import implausibility
from pipeline.selection.confusability import multiple_correlation
from pipeline.selection.cost import entry
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.first_order import FirstOrder, _free_of
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.signatures import Signature
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

EFFECTS = catalogue()
LARGE = "bar_geometric_nonlinearity"
SOME = (LARGE, "modulus_error", "load_misalignment", "axis_flexibility", "joint_friction")


@cache
def fits(effect: str, value: float) -> FitCache:
    candidates = {name: EFFECTS[name] for name in SOME}
    return FitCache(load_cases(bench(effect, value)), Model(), candidates, lambda _: None)


@pytest.mark.parametrize(
    ("effect", "value", "named"),
    [
        ("modulus_error.scale", 0.995, ("modulus_error",)),
        ("modulus_error.scale", 0.995, ("modulus_error", "load_misalignment")),
        ("load_misalignment.rz_rad", 0.002, ("load_misalignment",)),
        pytest.param("joint_friction.torque_Nmm", 80.0, ("joint_friction",), marks=pytest.mark.long),
    ],
)
def test_gain_is_the_fall_of_the_fit(effect: str, value: float, named: tuple[str, ...]) -> None:
    """Small effects are linear: within 5 %, and friction, looked at on lumped bars at one size, within a quarter."""
    it = fits(effect, value)
    root = frozenset([LARGE])
    fall = it.fit(root).chi_square - it.fit(root | set(named)).chi_square
    assert fall > 20.0
    assert it.first_order(root).gain(named).value == pytest.approx(
        fall, rel=0.25 if "joint_friction" in named else 0.05
    )


def test_a_pair_gains_at_least_what_its_best_member_does() -> None:
    about = fits("modulus_error.scale", 0.995).first_order(frozenset([LARGE]))
    single = max(about.gain([name]).value for name in ("modulus_error", "axis_flexibility"))
    assert about.gain(["modulus_error", "axis_flexibility"]).value >= single - 1e-6


def test_within_bounds_an_effect_gains_what_its_numbers_allow() -> None:
    """All of it where they allow it, nothing at null, less where one ends at its bound: no number is given up for
    another that would lie beyond."""
    name = "load_misalignment"
    there = fits(f"{name}.rz_rad", 0.002).first_order(frozenset([LARGE]))
    whole, sizes = there.alone(name)
    wide = np.full(sizes.size, 1e6)
    assert there.within(name, -wide, wide) == pytest.approx(whole, rel=1e-9)
    assert there.within(name, 0.0 * wide, 0.0 * wide) == pytest.approx(0.0, abs=1e-3 * whole)
    least = int(np.argmin(np.abs(sizes)))
    held = np.where(np.arange(sizes.size) == least, 0.5 * np.abs(sizes), wide)
    assert 0.5 * whole < there.within(name, -held, held) <= whole


@pytest.mark.parametrize("share", [1.0, 0.25])
def test_what_takes_implausible_numbers_off_another_is_worth_that(share: float) -> None:
    """Two effects that look the same, one of them at 40 typical sizes, 4 of chi-square: shared by both, 20 each, they
    cost 2. The readings are explained either way, and however few of them are looked at."""
    model = Model().with_effects([EFFECTS["modulus_error"]])
    (free,) = model.free
    size = free.parameter.typical
    model = model.at(np.array([free.parameter.null + 40.0 * size]))
    column = np.full((6, 1), 1e3)
    other = Signature(EFFECTS["joint_torsional_stiffness"], (column,), np.array([-np.inf]))
    fit = cast(Fit, SimpleNamespace(model=model, chi_square=0.0))
    tests = np.zeros(6, dtype=int)
    about = FirstOrder(
        fit,
        {"other": other},
        np.zeros(6),
        column / size,
        np.zeros((6, 0)),
        tests,
        share,
        CRITERIA.plausible,
    )
    alone = implausibility(model.free, model.values, CRITERIA.plausible)
    assert alone == pytest.approx(4.0) and about.gain(["other"]).value == pytest.approx(alone / 2, rel=1e-4)


def test_thresholds() -> None:
    """One of seventeen candidates with one number: 13.2, by Bonferroni; more for more numbers and more looks."""
    names = ("modulus_error", "base_compliance", "load_offset", "joint_clearance")
    others = [name for name in catalogue() if name not in names][:13]
    seventeen = {name: catalogue()[name] for name in (*names, *others)}
    it = cast(FitCache, SimpleNamespace(criteria=CRITERIA, candidates=seventeen))
    assert entry(it, "modulus_error") == pytest.approx(13.2, abs=0.1)
    assert entry(it, "base_compliance") > entry(it, "load_offset")
    assert entry(it, "joint_clearance") > entry(it, "modulus_error")
    assert CRITERIA.false_alarm < 0.02


@pytest.mark.parametrize(("size", "wrong"), [(5.0, 0.132), (10.0, 0.013)])
def test_the_wrong_one_of_two_alike_effects(size: float, wrong: float) -> None:
    """Signatures correlated by 0.9: the other fits better in 13.2 and 1.3 % of cases, and is named far less often."""
    rng = np.random.default_rng(4)
    one, other = np.array([1.0, 0.0]), np.array([0.9, np.sqrt(1 - 0.81)])
    data = size * one + rng.standard_normal((200_000, 2))
    ahead = (data @ other) ** 2 - (data @ one) ** 2
    assert np.mean(ahead > 0.0) == pytest.approx(wrong, rel=0.05)
    assert np.mean(ahead > CRITERIA.exclusion) < 0.4 * wrong
    assert multiple_correlation(one, other[:, None]) == pytest.approx(0.9)


def test_rounding_looks_like_nothing() -> None:
    """A number that no reading sees leaves a column of rounding beside the others: no direction, at any size of it."""
    one, other = np.array([1.0, 0.0, 0.0]), np.array([0.6, 0.8, 0.0])
    unseen = 1e-13 * np.array([1.0, 1e-3, 0.0])
    assert multiple_correlation(one, np.column_stack([other, unseen])) == pytest.approx(0.6)
    assert multiple_correlation(one, np.zeros((3, 2))) == 0.0


def test_what_the_fit_can_move_leaves_nothing_of_a_column() -> None:
    rng = np.random.default_rng(2)
    base = rng.standard_normal((20, 2))
    moved = 1e6 * base @ [1.0, -2.0]
    _, left = _free_of(base, rng.standard_normal(20), np.column_stack([moved, rng.standard_normal(20)]))
    assert np.linalg.norm(left[:, 0]) == 0.0
    assert np.linalg.norm(left[:, 1]) > 1.0
