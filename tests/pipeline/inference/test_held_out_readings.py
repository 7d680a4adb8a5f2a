"""Readings of tests that are held out take no part in a fit: others leave it where it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign, Test
from pipeline.inference.fit import Fit, fit, unmoved
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy import judgement
from pipeline.selection.adequacy.judgement import HELD_OUT, judge
from tests.pipeline.selection.bench import bench
from tests.pipeline.selection.mistakes import made
from vjm.effects import catalogue

MODEL = Model().with_effects([catalogue()[n] for n in ("bar_geometric_nonlinearity", "modulus_error")])
FITTED, HELD = "axial_held_q+0", "axial_held_q+15"


def knocked(campaign: Campaign, test: str, column: int = 0) -> Campaign:
    """Row 5 of a test with an x, or another displacement, that is 0.05 mm off."""

    def off(each: Test) -> np.ndarray:
        there = np.arange(len(each.data.steps))[:, None] == 5
        return each.data.displacement + 0.05 * there * np.eye(6)[column]

    tests = [
        replace(it, data=replace(it.data, displacement=off(it))) if it.id == test else it
        for it in campaign.tests
    ]
    return replace(campaign, tests=tuple(tests))


@pytest.fixture(scope="module")
def given() -> Campaign:
    return bench("modulus_error.scale", 0.95, (FITTED, HELD))


@pytest.fixture(scope="module")
def found(given: Campaign) -> Fit:
    return fit(MODEL, load_cases(given))


def test_a_fit_stays_where_only_those_held_out_are_others(given: Campaign, found: Fit) -> None:
    cases = load_cases(knocked(given, HELD))
    same, new = unmoved(found, cases), fit(MODEL, cases)
    assert same is not None
    assert same.model.values == pytest.approx(new.model.values, rel=1e-6)
    assert (same.chi_square, same.degrees) == (pytest.approx(new.chi_square, rel=1e-6), new.degrees)
    used = cases.predicted & ~cases.fitted[:, None]
    before, after = (np.sum(it.residual.left[used] ** 2) for it in (found, same))
    assert after > 10.0 * before
    assert after == pytest.approx(np.sum(new.residual.left[used] ** 2), rel=1e-3)


def test_other_readings_roles_and_sigmas_of_fitted_tests_want_another_fit(
    given: Campaign, found: Fit
) -> None:
    both = replace(given, tests=tuple(replace(test, role="fit") for test in given.tests))
    coarser = replace(given, noise=given.noise.times(np.full(12 + len(given.gauges), 1.5)))
    for other in (knocked(given, FITTED), both, coarser):
        assert unmoved(found, load_cases(other)) is None


@pytest.mark.parametrize("mend", [made.section_turned, made.angles_in_radians])
def test_what_is_done_on_another_rig_or_at_another_angle_wants_another_fit(
    found: Fit, mend: made.Wrong
) -> None:
    """The readings stay as they are: of the second only a test that was held out is at another angle."""
    cases = load_cases(mend(bench("modulus_error.scale", 0.95, (FITTED, HELD))))
    np.testing.assert_array_equal(cases.measured, found.residual.load_cases.measured)
    assert unmoved(found, cases) is None


def test_a_held_out_test_that_prescribed_otherwise_wants_another_fit(given: Campaign, found: Fit) -> None:
    """What is prescribed in it decides where its rows are predicted."""
    assert unmoved(found, load_cases(knocked(given, HELD, column=1))) is None


def test_tests_that_were_held_out_are_fitted_anew_once(
    given: Campaign, found: Fit, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However often a fit is judged."""
    count = 0

    def counted(*args: object) -> Fit:
        nonlocal count
        count += 1
        return fit(*args)  # type: ignore[arg-type]

    monkeypatch.setattr(judgement, "fit", counted)
    off = unmoved(found, load_cases(knocked(given, HELD)))
    assert off is not None
    assert judge(off).failed == {HELD_OUT} and judge(off) is judge(off)
    assert count == 1
    assert judge(found).noise
