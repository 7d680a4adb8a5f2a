"""Intervals against sums of squares whose profile is known in closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq, least_squares

from pipeline.inference.intervals import (
    Interval,
    correlations,
    has_an_end,
    holds_null,
    intervals,
    only_together,
    straight,
)
from pipeline.inference.profile_likelihood import RISE, ProfileLikelihood, Range
from pipeline.inference.settings import PROFILE

Array = NDArray[np.float64]
WIDE = Range(-1e3, 1e3, 0.0)
POSITIVE = Range(0.0, 1e3, 0.0, one_sided=True)
Z = np.sqrt(RISE)
CLOSE = PROFILE.close


@dataclass
class Toy:
    """Residuals with their Jacobian; counts its solutions."""

    function: Callable[[Array], Array]
    slopes: Callable[[Array], Array]
    solved: int = 0

    def residuals(self, values: Array) -> Array:
        self.solved += 1
        return self.function(values)

    def both(self, values: Array) -> tuple[Array, Array]:
        self.solved += 1
        return self.function(values), self.slopes(values)


def land(toy: Toy, start: Array, ranges: list[Range]) -> ProfileLikelihood:
    bounds = np.array([(r.low, r.high) for r in ranges]).T
    found = least_squares(toy.function, start, toy.slopes, bounds=bounds, xtol=1e-14, ftol=1e-14, gtol=1e-14)
    values = np.asarray(found.x)
    for k, r in enumerate(ranges):
        # least_squares keeps off a bound by rounding only.
        values[k] = r.low if values[k] - r.low < 1e-9 else values[k]
    return ProfileLikelihood(toy, values, ranges, toy.function(values), toy.slopes(values))


def linear(matrix: Array, measured: Array) -> Toy:
    return Toy(lambda v: matrix @ v - measured, lambda v: matrix)


def test_linear_gaussian_intervals_are_exact_and_cover_the_truth_as_often_as_they_say() -> None:
    """3 x 400 intervals at 95 %: the share that covers lies within three standard errors, 0.95 ± 0.019."""
    rng = np.random.default_rng(11)
    matrix, truth = rng.normal(size=(30, 3)) * [1.0, 100.0, 1e-3], np.array([2.0, -0.01, 500.0])
    std = np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix)))
    held = []
    for _ in range(400):
        toy = linear(matrix, matrix @ truth + rng.normal(size=30))
        best = np.linalg.lstsq(matrix, matrix @ truth - toy.function(truth), rcond=None)[0]
        there = ProfileLikelihood(toy, best, [Range(-1e6, 1e6, 0.0)] * 3, toy.function(best), matrix)
        found = intervals(there)
        assert [it.kind for it in found] == ["wald"] * 3 and toy.solved == 6
        np.testing.assert_allclose([it.std for it in found], std, rtol=1e-9)
        np.testing.assert_allclose([it.high for it in found], best + Z * std, rtol=1e-9)
        held.append([low <= t <= high for (low, high), t in zip(map(ends, found), truth, strict=True)])
    assert abs(np.mean(held) - 0.95) < 3.0 * np.sqrt(0.95 * 0.05 / 1200)


def test_straight_intervals_are_those_of_a_parabola_and_solve_nothing() -> None:
    """Within the range of a number; where the data say nothing, none."""
    matrix = np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]])
    toy = linear(matrix, np.array([0.5, 20.0, 0.0]))
    it = land(toy, np.array([1.0, 1.0, 1.0]), [POSITIVE, WIDE, WIDE])
    solved = toy.solved
    near, far, hidden = straight(it)
    assert toy.solved == solved and it.evaluations == 0
    assert (near.low, near.high) == (0.0, pytest.approx(0.5 + Z)) and near.std == pytest.approx(1.0)
    assert ends(far) == pytest.approx((10.0 - 0.5 * Z, 10.0 + 0.5 * Z))
    assert near.kind == far.kind == "wald" and intervals(it)[1] == far
    assert hidden.kind == "undetermined" and hidden.low is hidden.high is None


def ends(it: Interval) -> tuple[float, float]:
    assert it.low is not None and it.high is not None
    return it.low, it.high


@pytest.mark.parametrize(
    ("measured", "low", "high"),
    [
        # Below the bound: the estimate is 0 and (h + 0.5)² - 0.5² = 3.841.
        (-0.5, 0.0, np.sqrt(RISE + 0.25) - 0.5),
        (-30.0, 0.0, np.sqrt(RISE + 900.0) - 30.0),
        # Above it, but zero within the interval.
        (1.0, 0.0, 1.0 + Z),
        (10.0, 10.0 - Z, 10.0 + Z),
    ],
)
def test_a_one_sided_interval_begins_at_null(measured: float, low: float, high: float) -> None:
    it = intervals(land(linear(np.eye(1), np.array([measured])), np.ones(1), [POSITIVE]))[0]
    assert it.value == pytest.approx(max(measured, 0.0), abs=1e-8)
    assert it.low == pytest.approx(low, abs=CLOSE * Z) and it.high == pytest.approx(high, rel=CLOSE)
    assert it.low == 0.0 or measured > Z


@pytest.mark.parametrize(("measured", "low"), [(5.0, 0.0), (5.6, 5.6 - Z)])
def test_null_is_left_only_for_more_than_is_in_doubt(measured: float, low: float) -> None:
    """At null the sum of squares is measured² higher: 25 is below 3.841 + 25, 31.4 above."""
    doubtful = Range(0.0, 1e3, 0.0, one_sided=True, doubt=25.0)
    it = intervals(land(linear(np.eye(1), np.array([measured])), np.ones(1), [doubtful]))[0]
    assert it.low == pytest.approx(low, abs=CLOSE * Z) and it.high == pytest.approx(measured + Z, rel=CLOSE)
    sure = intervals(land(linear(np.eye(1), np.array([measured])), np.ones(1), [POSITIVE]))[0]
    assert sure.low == pytest.approx(measured - Z, rel=CLOSE)


@pytest.mark.parametrize(("shift", "far"), [(-1e3, True), (-5.0, False)])
def test_a_rise_far_beyond_what_is_asked_about_takes_one_look(shift: float, far: bool) -> None:
    """y = a + e^b - 1: b follows a by steps, which are taken where the rise is near the 28.8 that are asked about."""
    toy = Toy(
        lambda v: np.array([v[0] + np.exp(v[1]) - 1.0, v[1]]),
        lambda v: np.array([[1.0, np.exp(v[1])], [0.0, 1.0]]),
    )
    start = np.zeros(2)
    there = ProfileLikelihood(toy, start, [WIDE, WIDE], toy.function(start), toy.slopes(start))
    rise, _ = there.rise(0, shift, np.array([1.0, 0.0]), RISE + 25.0)
    assert (rise > RISE + 25.0) == far and (there.evaluations == 1) == far


def test_what_no_slope_foresees_is_no_rise_yet() -> None:
    """(0.3 a)² + (b - a)² / 4 + b⁴, and 900 of a lost row where b > 1, which b leaves in its second step."""
    toy = Toy(
        lambda v: np.array([0.3 * v[0], 0.5 * (v[1] - v[0]), v[1] ** 2, 30.0 * (v[1] > 1.0)]),
        lambda v: np.array([[0.3, 0.0], [-0.5, 0.5], [0.0, 2.0 * v[1]], [0.0, 0.0]]),
    )
    there = ProfileLikelihood(toy, np.zeros(2), [WIDE, WIDE], np.zeros(4), toy.slopes(np.zeros(2)))
    rise, way = there.rise(0, 2.0, np.array([1.0, 1.0]))
    b = brentq(lambda b: 0.5 * (b - 2.0) + 4.0 * b**3, 0.0, 1.0)
    assert 2.0 * way[1] == pytest.approx(b, rel=0.05)
    assert rise == pytest.approx(0.36 + 0.25 * (b - 2.0) ** 2 + b**4, rel=0.05)


def test_ends_are_looked_for_where_the_looks_at_a_parabola_say() -> None:
    """(x + 0.03 x³)² has risen by 4.8 at 1.96; a parabola with that rises by 3.841 where the end nearly is."""
    toy = Toy(lambda v: v + 0.03 * v**3, lambda v: np.array([[1.0 + 0.09 * v[0] ** 2]]))
    there = ProfileLikelihood(toy, np.zeros(1), [WIDE], np.zeros(1), np.eye(1))
    (it,) = intervals(there)
    end = brentq(lambda x: x + 0.03 * x**3 - Z, 0.0, Z)
    assert it.kind == "profile" and ends(it) == pytest.approx((-end, end), rel=CLOSE)
    assert there.evaluations == toy.solved == 4


def test_a_number_at_its_bound_no_longer_widens_the_others() -> None:
    """b >= 0 wants to be negative: a is then known as if b were not there."""
    matrix = np.array([[1.0, 0.9], [0.0, 0.5]])
    a, b = intervals(land(linear(matrix, np.array([3.0, -2.0])), np.ones(2), [WIDE, POSITIVE]))
    assert b.value == b.low == 0.0
    assert a.std == pytest.approx(1.0) and a.value == pytest.approx(3.0)
    # A refit at any a leaves b at its bound, so the profile of a is that of one number.
    assert a.kind == "wald" and a.high == pytest.approx(3.0 + Z)


def curved(difference: float, s: float, t: float) -> Toy:
    """((exp(a) + b - d) / s, b / t): b drops out of the profile of a, (exp(a) - d)² / (s² + t²)."""
    return Toy(
        lambda v: np.array([(np.exp(v[0]) + v[1] - difference) / s, v[1] / t]),
        lambda v: np.array([[np.exp(v[0]) / s, 1.0 / s], [0.0, 1.0 / t]]),
    )


def test_an_asymmetric_interval_is_the_profiles() -> None:
    """Ends log(d ± 1.96 (s² + t²)^½); Wald would give ± 0.49 about log 2."""
    a, b = intervals(land(curved(2.0, 0.4, 0.3), np.array([0.5, 0.0]), [WIDE, WIDE]))
    low, high = np.log(2.0 - Z * 0.5), np.log(2.0 + Z * 0.5)
    assert a.kind == "profile"
    # Ends are found to CLOSE of the square root of the rise, whose slope here is at least 2/3 of the parabola's.
    assert a.low == pytest.approx(low, abs=1.5 * CLOSE * (np.log(2.0) - low))
    assert a.high == pytest.approx(high, abs=1.5 * CLOSE * (high - np.log(2.0)))
    assert a.std == pytest.approx(0.25)
    assert a.error(-1) * Z == pytest.approx(np.log(2.0) - ends(a)[0]) and a.error(1) < 0.8 * a.error(-1)
    assert b.kind == "wald" and b.high == pytest.approx(0.3 * Z)
    assert b.error(-1) == b.error(1) == pytest.approx(b.std)


def test_an_end_that_the_data_do_not_set_is_none() -> None:
    """exp(a) = 0.1 ± 0.5: no a is too small."""
    a = intervals(land(curved(0.1, 0.4, 0.3), np.array([-2.0, 0.0]), [Range(-50.0, 50.0, 0.0), WIDE]))[0]
    assert a.kind == "profile" and a.low is None
    assert a.high == pytest.approx(np.log(0.1 + Z * 0.5), abs=0.1)
    assert a.high is not None and a.error(1) == pytest.approx((a.high - a.value) / Z) and a.error(-1) == a.std


def test_what_the_data_do_not_see_is_undetermined() -> None:
    matrix = np.array([[1.0, 0.0, 2.0, 2.0], [1.0, 0.0, -1.0, -1.0], [0.5, 0.0, 0.0, 0.0]])
    there = land(linear(matrix, np.ones(3)), np.ones(4), [WIDE, WIDE, POSITIVE, WIDE])
    found = intervals(there)
    assert [it.kind for it in found] == ["wald", "undetermined", "undetermined", "undetermined"]
    assert np.isinf([it.std for it in found[1:]]).all()
    assert found[1].low is None and found[1].high is None
    assert found[2].low == 0.0 and found[2].high is None
    assert only_together(there) == [(2, 3)]
    assert correlations(there) == []


@pytest.mark.parametrize(
    ("std", "range_", "kind"),
    [
        (0.1, Range(-1.0, 1.0, 0.0), "wald"),
        # 1.96 standard errors reach one bound, both, and past the whole range.
        (0.5, Range(-0.5, 3.0, 0.0), "profile"),
        (0.8, Range(-1.0, 1.0, 0.0), "undetermined"),
        (3.0, Range(-1.0, 1.0, 0.0), "undetermined"),
        (0.5, Range(0.0, 1.2, 0.0, one_sided=True), "undetermined"),
        (0.5, Range(0.0, 2.0, 0.0, one_sided=True), "profile"),
    ],
)
def test_a_number_has_an_end_where_its_interval_has_one(std: float, range_: Range, kind: str) -> None:
    there = land(linear(np.array([[1.0 / std]]), np.array([0.3 / std])), np.array([0.2]), [range_])
    assert has_an_end(there, 0) is (kind != "undetermined")
    assert intervals(there)[0].kind == kind
    assert (straight(there)[0].kind == "undetermined") is (kind == "undetermined")


def test_an_interval_on_one_branch_has_no_end_though_its_parabola_has() -> None:
    """A residual that levels off: tanh(4 a) = 0 ± 1 rises to 1 at any a, where the parabola sees ± 0.25."""
    toy = Toy(lambda v: np.tanh(4.0 * v), lambda v: np.atleast_2d(4.0 / np.cosh(4.0 * v) ** 2))
    there = land(toy, np.array([0.0]), [Range(-1.4, 1.4, 0.0)])
    assert intervals(there)[0].kind == "undetermined" and not has_an_end(there, 0)


def test_correlations_are_those_of_the_inverse() -> None:
    """Two columns at an angle have errors that correlate by minus its cosine."""
    c = 0.97
    matrix = np.array([[1.0, c, 0.0], [0.0, np.sqrt(1.0 - c * c), 0.0], [0.0, 0.0, 1.0]])
    there = land(linear(matrix * [1.0, 50.0, 2.0], np.ones(3)), np.zeros(3), [WIDE] * 3)
    ((i, j, r),) = correlations(there)
    assert (i, j) == (0, 1) and r == pytest.approx(-c, abs=1e-9)
    assert correlations(there, least=0.98) == []


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("angle", [1e-3, 1e-5, 1e-6, 1e-7, 3e-8, 1e-8, 1e-9])
def test_numbers_that_nearly_go_together_correlate_by_one_at_most(angle: float) -> None:
    """Or are not seen apart at all: the inverse of their matrix is rounding then, of either sign."""
    matrix = np.array([[1.0, np.cos(angle), 0.1], [0.0, np.sin(angle), 0.2], [0.0, 0.0, 1.0]])
    there = land(linear(matrix, np.ones(3)), np.zeros(3), [WIDE] * 3)
    found = correlations(there)
    assert all(-1.0 - 1e-9 <= r <= 1.0 + 1e-9 for _, _, r in found)
    assert angle < 1e-4 or [(i, j) for i, j, _ in found] == [(0, 1)]


def test_whether_an_interval_holds_null_needs_no_ends() -> None:
    """Curved sums of squares of three numbers, the last of one sign only; both answers occur for each."""
    rng, said = np.random.default_rng(3), []
    for _ in range(60):
        matrix, curved = rng.normal(size=(2, 12, 3))
        measured = matrix @ np.array([0.5, -0.5, 0.4]) + rng.normal(size=12)

        def function(v: Array, a: Array = matrix, b: Array = curved, y: Array = measured) -> Array:
            return np.asarray(a @ v + 0.05 * b @ v**2 - y)

        def slopes(v: Array, a: Array = matrix, b: Array = curved) -> Array:
            return np.asarray(a + 0.1 * b * v)

        there = land(Toy(function, slopes), np.array([0.1, 0.1, 0.1]), [WIDE, WIDE, POSITIVE])
        for k, it in enumerate(intervals(there)):
            low, high = ends(it)
            near = min(abs(low), abs(high)) if k < 2 else low
            if 0.0 < near < 2 * CLOSE * (high - low):
                continue
            said.append((k, holds_null(there, k)))
            assert said[-1][1] == (low <= 0.0 <= high), (it, said[-1])
    assert set(said) == {(k, holds) for k in range(3) for holds in (False, True)} and len(said) > 120
