"""Whether what a model leaves is noise: in size, along the load paths, sensor by sensor, and in tests held out."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2, norm

from pipeline.inference.driving import column_name
from pipeline.inference.eliminated import Marginal
from pipeline.inference.fit import Fit, fit
from pipeline.inference.kept import kept
from pipeline.inference.load_cases import load_cases
from pipeline.inference.noise import lag_one
from pipeline.inference.rounding import EQUAL
from pipeline.selection.adequacy.constancy import largest_departure
from pipeline.selection.adequacy.patterns import scores
from pipeline.selection.adequacy.whiteness import paths
from pipeline.selection.criteria import CRITERIA, Criteria
from reports.quantities import percent, short, sigma

Array = NDArray[np.float64]
HELD_OUT, SIZE, ORDER, SERIES = "held out", "size", "order", "series"


@dataclass(frozen=True)
class Check:
    """One look at a residual. p_value: chance that noise looks like this in any of the places looked at; level: below
    which noise would be too seldom."""

    name: str
    p_value: float
    words: str
    level: float

    @property
    def passed(self) -> bool:
        """Whether noise may have done it."""
        return self.p_value >= self.level


@dataclass(frozen=True)
class Judgement:
    """All checks. scatter: by which the sigmas seem too small, 1 if they do not."""

    checks: tuple[Check, ...]
    scatter: float

    @property
    def noise(self) -> bool:
        """Whether what is left is noise."""
        return not self.failed

    @property
    def failed(self) -> frozenset[str]:
        """Names of the checks by which it is none."""
        return frozenset(check.name for check in self.checks if not check.passed)


def judge(found: Fit, criteria: Criteria = CRITERIA) -> Judgement:
    """The residual of a fit, of the fitted tests and of those held out."""
    return _judge(found, criteria)


def ordered(found: Fit, criteria: Criteria = CRITERIA) -> bool:
    """Whether what is left of the fitted tests has an order along the load paths."""
    return not _order(found, criteria).passed


def of_the_size_of_noise(found: Fit, criteria: Criteria = CRITERIA) -> bool:
    """Whether what is left of the fitted tests is no larger than noise, or scatters little more than the sigmas say."""
    return _size(found, criteria, _order(found, criteria))[0].passed


@kept
def _judge(found: Fit, criteria: Criteria) -> Judgement:
    level, order = criteria.check_level, _order(found, criteria)
    size, scatter = _size(found, criteria, order)
    out = [
        _lost(found, level),
        size,
        order,
        _series(found, scatter, level),
        _patterns(found, scatter, criteria),
        _constant(found, scatter, level),
    ]
    checks = [check for check in out if check is not None]
    held = _held_out(found, scatter, level)
    if found.model.free and held is not None and not held.passed and all(check.passed for check in checks):
        held = _held_out_anew(found, scatter, held)
    return Judgement(tuple(checks if held is None else [*checks, held]), scatter)


def _lost(found: Fit, level: float) -> Check | None:
    lost = np.flatnonzero(found.prediction.lost)
    if not lost.size:
        return None
    whole = found.residual.load_cases
    tests = dict.fromkeys(whole.campaign.tests[n].id for n in whole.test[lost])
    reason = found.prediction.reasons.get(int(lost[0]), "no equilibrium")
    words = f"the model has no stable state in {lost.size} rows ({', '.join(tests)}): {reason}"
    return Check("states", 0.0, words, level)


def _size(found: Fit, criteria: Criteria, order: Check) -> tuple[Check, float]:
    """The look at the size of what is left, and the scatter: where that is larger than the sigmas say and has no order
    it is noise."""
    level = criteria.check_level
    p = float(chi2.sf(found.chi_square, max(found.degrees, 1)))
    if p < level and order.passed and found.rms <= criteria.scatter_factor:
        scatter = found.rms
        return Check(
            SIZE, 1.0, f"the scatter is {percent(scatter - 1.0)} larger than the sigmas say", level
        ), scatter
    return Check(SIZE, p, f"what is left is {sigma(found.rms)} sigma", level), 1.0


def _order(found: Fit, criteria: Criteria) -> Check:
    level = criteria.check_level
    if found.rms < criteria.negligible:
        words = f"what is left, {sigma(found.rms)} sigma, is too little for its order to count"
        return Check(ORDER, 1.0, words, level)
    try:
        check = lag_one(list(_paths(found).values()))
    except ValueError as error:
        return Check(ORDER, 1.0, f"order along the load paths cannot be judged: {error}", level)
    words = f"neighbours along the load paths correlate by {check.statistic:.2f}"
    return Check(ORDER, check.p_value, words, level)


def _paths(found: Fit) -> dict[tuple[int, int], Array]:
    """Whitened residual of every fitted test and channel, by numbers of both."""
    return {key: found.whitened[rows] for key, rows in paths(found).items()}


def _series(found: Fit, scatter: float, level: float) -> Check:
    """The worst of all tests and channels."""
    every = _paths(found)
    worst, p = max(
        ((key, chi2.sf(np.sum(r**2) / scatter**2, r.size)) for key, r in every.items()), key=lambda it: -it[1]
    )
    whole = found.residual.load_cases
    rms = float(np.sqrt(np.mean(every[worst] ** 2)))
    name = column_name(worst[1], whole.campaign.gauges)
    words = f"{name} in test {whole.campaign.tests[worst[0]].id} is off by {sigma(rms)} sigma"
    return Check(SERIES, float(min(1.0, p * len(every))), words, level)


def _patterns(found: Fit, scatter: float, criteria: Criteria) -> Check:
    """The worst of all sensors' patterns."""
    every = scores(found, criteria)
    if not every:
        return Check("patterns", 1.0, "no pattern of a sensor can be seen", criteria.check_level)
    p = 2.0 * float(norm.sf(abs(every[0].score) / scatter)) * len(every)
    words = f"the rest looks as if {every[0].words} ({sigma(abs(every[0].score))} sigma)"
    return Check("patterns", min(1.0, p), words, criteria.check_level)


def _constant(found: Fit, scatter: float, level: float) -> Check | None:
    """The worst of all numbers at each angle and in each test."""
    it = largest_departure(found)
    if it is None:
        return None
    p = 2.0 * float(norm.sf(abs(it.score) / scatter)) * it.looks
    more = "more" if it.change > 0.0 else "less"
    words = f"{it.name} would be {short(abs(it.change))} {more} {it.where} ({sigma(abs(it.score))} sigma)"
    return Check("constancy", min(1.0, p), words, level)


def _held_out(found: Fit, scatter: float, level: float) -> Check | None:
    """Tests that were never used, with the uncertainty that the fitted numbers leave them."""
    whole = found.residual.load_cases
    used = whole.predicted & ~whole.fitted[:, None]
    if not used.any():
        return None
    residual = found.residual.left[used]
    # Unknown zeros of tests held out are theirs to fit.
    zeros = found.residual.offsets[used]
    wide = _uncertain(found, used)
    if zeros.any():
        axes, sizes, _ = np.linalg.svd(zeros, full_matrices=False)
        basis = axes[:, sizes > EQUAL * sizes.max()]
        residual, wide = residual - basis @ (basis.T @ residual), wide - basis @ (basis.T @ wide)
    # No difference from the sum of squares, which a number that hardly anything determines would round to nothing.
    left = Marginal.of(wide).weakened(residual)
    p = float(chi2.sf(np.sum(left**2) / scatter**2, residual.size))
    rms = float(np.sqrt(np.mean(residual**2)))
    return Check(HELD_OUT, p, f"tests that were held out are off by {sigma(rms)} sigma", level)


def _uncertain(found: Fit, used: NDArray[np.bool_]) -> Array:
    """(N, k) what an error of each number of the fit, and of what was written about the rig, does to readings: columns
    of one standard deviation that are independent of each other."""
    it = found.residual
    root, slopes, nominal = _root(found.finite_covariance), it.slopes[used], it.nominal[used]
    if it.marginal is None:
        return slopes @ root
    # What was written follows the numbers of the fit, and has an error of its own beside.
    both = slopes + nominal @ found.nominal_slopes
    return np.hstack([both @ root, nominal @ _root(it.marginal.covariance)])


def _held_out_anew(found: Fit, scatter: float, linear: Check) -> Check:
    """The same with the numbers where fitted tests and those held out together want them: their covariance is that of
    a line, and a number that the fitted tests hardly see may be far from where they leave it."""
    whole = found.residual.load_cases
    tests = tuple(replace(test, role="fit") for test in whole.campaign.tests)
    both = fit(found.model, load_cases(replace(whole.campaign, tests=tests)), found.prediction)
    count = both.whitened.size - found.whitened.size
    p = float(chi2.sf((both.chi_square - found.chi_square) / scatter**2, max(count, 1)))
    return linear if p < linear.level else replace(linear, p_value=p)


def _root(covariance: Array) -> Array:
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))
