"""What was written about a rig, eliminated: its derivatives, and the least squares that it stands for."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.optimize import least_squares

from pipeline.campaign import Campaign
from pipeline.campaign.tolerance import usual
from pipeline.inference.fit import Fit, fit, unfitted, with_own_line
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import departed, departures, lined, nominals
from pipeline.inference.objective import Objective
from pipeline.inference.prediction import predict
from tests.pipeline.bench import bench
from vjm.effects import catalogue

BENT = "bar_geometric_nonlinearity"


@cache
def campaign(effect: str = "", value: float = 0.0) -> Campaign:
    """The small bench, its numbers known as well as usual."""
    it = bench(effect, value, gauges=False)
    return replace(it, tolerance=usual(it.rig.written))


@cache
def fitted(effect: str = "", value: float = 0.0, *, exact: bool = False, more: tuple[str, ...] = ()) -> Fit:
    it = campaign(effect, value)
    cases = load_cases(replace(it, tolerance={}) if exact else it)
    return fit(Model().with_effects([catalogue()[name] for name in (BENT, *more)]), cases)


def values(found: Fit) -> dict[str, float]:
    numbers = nominals(found.residual.load_cases.campaign)
    return dict(zip([each.name for each in numbers], found.residual.estimate.tolist(), strict=True))


@pytest.mark.parametrize("effects", [pytest.param((BENT,), marks=pytest.mark.long), (BENT, "mounting_tilt")])
def test_derivatives_are_those_of_central_differences(effects: tuple[str, ...]) -> None:
    cases = load_cases(campaign())
    numbers = nominals(cases.campaign)
    model = Model().with_effects([catalogue()[name] for name in effects])
    here = predict(model, cases)
    line = lined(model, cases, here).by_nominal
    sigma = np.where(cases.predicted, cases.sigma, np.inf)
    for k, each in enumerate(numbers):
        step = 0.2 * np.eye(len(numbers))[k]
        high, low = (
            predict(departed(model, numbers, way * step), cases, start=here, shift=here.shift).values
            for way in (1.0, -1.0)
        )
        expected = (high - low) / 0.4 / sigma
        off = np.abs(line[..., k] / sigma - expected).max()
        assert off < 1e-2 * max(np.abs(expected).max(), 0.1), each.name


def test_where_all_is_exact_there_is_nothing_to_eliminate() -> None:
    found = fitted(exact=True)
    assert found.residual.marginal is None and not found.model.nominals
    assert found.residual.left is found.residual.values


def explicit(found: Fit, cases: LoadCases) -> float:
    """Chi-square with what was written as free numbers, each with a reading more: no line is drawn anywhere."""
    numbers = nominals(cases.campaign)
    (_, own), *_ = cases.by_role

    def residuals(at: np.ndarray) -> np.ndarray:
        model = departed(found.model, numbers, at)
        there = Objective(model, own.plain).at(model.values)
        return np.concatenate([there.residuals, at])

    begin = departures(found.model, numbers)
    return 2.0 * float(
        least_squares(residuals, begin, method="lm", diff_step=1e-3, max_nfev=40 * begin.size).cost
    )


@pytest.mark.long
def test_the_line_of_a_fit_gives_what_free_numbers_give() -> None:
    off = "modulus_error.scale", 1.04
    found = fitted(*off)
    assert found.chi_square == pytest.approx(explicit(found, load_cases(campaign(*off))), abs=0.15)


@pytest.mark.long
def test_the_line_of_a_like_model_leads_where_the_own_one_does() -> None:
    """Chi-square and what was written within a part of what noise moves them by; along its own line to rounding."""
    off = "modulus_error.scale", 1.04
    cases, start = load_cases(campaign(*off)), fitted(*off)
    model = start.model.with_effects([catalogue()[name] for name in ("mounting_tilt", "load_offset")])
    chord, own = fit(model, cases, start.prediction), fitted(*off, more=("mounting_tilt", "load_offset"))
    assert not chord.own_line and own.own_line
    assert chord.chi_square == pytest.approx(own.chi_square, abs=0.3)
    lined_anew = with_own_line(chord, cases)
    assert lined_anew.own_line
    assert lined_anew.chi_square == pytest.approx(own.chi_square, abs=0.02)
    np.testing.assert_allclose(lined_anew.std, own.std, rtol=0.02)


def test_a_line_that_leads_nowhere_is_drawn_anew() -> None:
    """That of bars without geometric stiffness, far off: the fit with it begins there and ends near where it should."""
    off = "modulus_error.scale", 1.04
    cases = load_cases(campaign(*off))
    straight = unfitted(Model(), cases)
    found = fit(Model().with_effects([catalogue()[BENT]]), cases, straight.prediction)
    assert straight.chi_square > 1e4 and found.chi_square == pytest.approx(fitted(*off).chi_square, abs=3.0)
    assert with_own_line(found, cases).chi_square == pytest.approx(fitted(*off).chi_square, abs=0.1)


def test_a_bar_that_is_off_within_its_tolerance_is_no_misfit() -> None:
    """The truth is the frame elements'."""
    off, exact = fitted("modulus_error.scale", 1.04), fitted("modulus_error.scale", 1.04, exact=True)
    clean = fitted()
    assert exact.chi_square > clean.chi_square + 200.0
    # Two tolerances of three stiffnesses that show: what it costs that they are all off, and no more.
    assert clean.chi_square < off.chi_square < clean.chi_square + 20.0
    # How much of it is the section and how much its ends these tests do not tell.
    rig = off.residual.load_cases.campaign.rig
    written, best = (it.mechanism(rig, ()).view.links[0].stiffness for it in (Model(), off.model))
    assert best[1, 1] / written[1, 1] == pytest.approx(1.04, abs=0.004)
    assert all(abs(u) < 3.0 for u in values(off).values())


def test_an_effect_in_the_span_of_what_was_written_is_limited_by_its_tolerance() -> None:
    """Whatever the data: a factor of all stiffnesses is known to no more than the nominal ones are."""
    wide, exact = (fitted("", 0.0, exact=it, more=("modulus_error",)) for it in (False, True))
    assert float(exact.std[0]) < 0.002
    assert 0.008 < float(wide.std[0]) < 0.02


def test_an_effect_that_looks_like_nothing_written_keeps_its_error() -> None:
    wide, exact = (fitted("", 0.0, exact=it, more=("load_offset",)) for it in (False, True))
    # Where along y the cell stands no stiffness says.
    assert float(wide.std[1]) == pytest.approx(float(exact.std[1]), rel=0.01)


def test_the_covariance_of_what_was_written_never_exceeds_what_was_known() -> None:
    found = fitted("modulus_error.scale", 1.04, more=("mounting_tilt",))
    variances = np.diag(found.nominal_covariance)
    assert np.all(variances > 0.0) and np.all(variances < 1.0 + 1e-9)


def test_a_model_as_it_is_has_what_was_written_where_it_fits_best() -> None:
    cases = load_cases(campaign("modulus_error.scale", 1.04))
    as_it_is = unfitted(Model().with_effects([catalogue()[BENT]]), cases)
    assert as_it_is.chi_square == pytest.approx(fitted("modulus_error.scale", 1.04).chi_square, rel=1e-6)


def test_an_angle_that_was_set_up_wrong_is_found() -> None:
    """A bench at 30.2 degrees that is written as 30."""
    it = campaign()
    tests = tuple(replace(t, q_deg=t.q_deg - np.degrees(1e-3)) for t in it.tests)
    cases = load_cases(replace(it, tests=tests))
    found = fit(Model().with_effects([catalogue()[BENT]]), cases)
    assert values(found)["q_mrad.posture"] == pytest.approx(2.0, abs=0.5)
    assert found.chi_square < fitted().chi_square + 10.0
