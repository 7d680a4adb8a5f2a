"""Whether noise that is correlated from row to row explains what a fit leaves: one correlation a sensor.

A sensor whose errors follow e_i = rho e_{i-1} + sqrt(1 - rho²) w_i within a test has correlations rho^|i-j| between
rows i and j. With v_i what an error of one standard deviation does to the whitened residual of row i, and
V_s = (v_1, v_2, ...) of sensor s, those of a test have the covariance

    S = 1 + sum over sensors s of  V_s (R_s - 1) V_s^T,     (R_s)_ij = rho_s^|i-j|.

Sensors are taken one after the other, the one with the largest score d(log L)/d(rho_s) at rho_s = 0, in its standard
deviations, as long as noise without a correlation seldom has one so large; rho_s is that of the largest likelihood. The
numbers of the fit are then fitted anew, to first order, by generalised least squares, and what is left is looked at
like any residual. G. E. P. Box, G. M. Jenkins, G. C. Reinsel, Time Series Analysis, 4th ed., Wiley 2008, section 3.2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve, solve_triangular
from scipy.optimize import minimize
from scipy.stats import chi2, norm

from pipeline.inference.fit import Fit
from pipeline.inference.noise import lag_one
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.rounding import ROUNDING, TINY
from pipeline.inference.settings import CORRELATION
from pipeline.selection.adequacy.patterns import shapes, steady
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Correlated:
    """A sensor by the number of its channel. correlation: of neighbouring rows of a test; error: standard error."""

    channel: int
    correlation: float
    error: float


@dataclass(frozen=True, eq=False)
class _Test:
    """A test's part of the residuals: where it is among all; errors (S, n, r) of each sensor in each of its r rows."""

    where: slice
    errors: Array

    @cached_property
    def apart(self) -> Array:
        """(r, r) rows from one to the other."""
        count = self.errors.shape[2]
        return np.abs(np.subtract.outer(np.arange(count), np.arange(count))).astype(float)

    def root(self, correlations: Array) -> Array:
        """(n, n) lower Cholesky factor of the covariance."""
        out = np.eye(self.errors.shape[1])
        for k in np.flatnonzero(correlations).tolist():
            alike = correlations[k] ** self.apart
            np.fill_diagonal(alike, 0.0)
            out += self.errors[k] @ alike @ self.errors[k].T
        return np.asarray(np.linalg.cholesky(out), dtype=float)

    def loss(self, left: Array, correlations: Array, free: NDArray[np.int64]) -> tuple[float, Array]:
        """Minus twice the log likelihood of residuals (n,), but for a constant, and its derivative by some
        correlations."""
        root = self.root(correlations)
        inverse = cho_solve((root, True), np.eye(left.size))
        pulled = inverse @ left
        slopes = []
        for k in free.tolist():
            errors, apart = self.errors[k], self.apart
            by = apart * correlations[k] ** np.maximum(apart - 1.0, 0.0)
            pull = errors.T @ pulled
            slopes.append(float(np.sum(by * (errors.T @ inverse @ errors))) - float(pull @ by @ pull))
        return float(left @ pulled) + 2.0 * float(np.log(np.diag(root)).sum()), np.array(slopes)

    def scored(self, whitened: Array, root: Array) -> tuple[Array, Array]:
        """Score (S,) of each sensor's correlation beside those that are there, and its variance."""
        errors = np.linalg.solve(root, self.errors)
        pulls = np.einsum("snr,n->sr", errors, whitened)
        inner = np.einsum("snr,snr->sr", errors, errors)
        along = np.einsum("snr,snr->sr", errors[..., 1:], errors[..., :-1])
        score = np.sum(pulls[:, 1:] * pulls[:, :-1] - along, axis=1)
        return score, np.sum(inner[:, 1:] * inner[:, :-1] + along**2, axis=1)


@dataclass(frozen=True, eq=False)
class _Residual:
    """What a fit leaves (N,), what it can still move (N, K), and its tests. sensors: channels of the errors' rows."""

    left: Array
    moved: Array
    tests: tuple[_Test, ...]
    sensors: NDArray[np.int64]

    def loss(self, correlations: Array, free: NDArray[np.int64]) -> tuple[float, Array]:
        """Minus twice the log likelihood, but for a constant, and its derivative by some correlations."""
        each = [test.loss(self.left[test.where], correlations, free) for test in self.tests]
        return sum(value for value, _ in each), np.sum([slopes for _, slopes in each], axis=0)

    def whitened(self, columns: Array, correlations: Array) -> Array:
        """Columns (N, ...) in units of the correlated noise."""
        out = columns.copy()
        for test in self.tests:
            out[test.where] = solve_triangular(test.root(correlations), columns[test.where], lower=True)
        return out

    def scores(self, correlations: Array) -> Array:
        """(S,) of each sensor's correlation beside those that are there, in standard deviations."""
        score, variance = np.zeros(len(self.sensors)), np.zeros(len(self.sensors))
        z = self.whitened(self.left, correlations)
        for test in self.tests:
            more, wider = test.scored(z[test.where], test.root(correlations))
            score, variance = score + more, variance + wider
        return np.asarray(score / np.sqrt(np.maximum(variance, TINY)))


def correlated(found: Fit, criteria: Criteria) -> tuple[Correlated, ...]:
    """Sensors whose noise is correlated from row to row, where that explains all that a fit leaves; else none."""
    # A correlation makes no residual larger.
    if found.lost or found.degrees < criteria.few_readings or found.rms > criteria.scatter_factor:
        return ()
    it = _residual(found)
    correlations = _fitted(it, criteria)
    if not correlations.any() or not _explains(found, it, correlations, criteria):
        return ()
    return tuple(_each(it, correlations))


def decorrelating(found: Fit, sensors: Sequence[Correlated]) -> Callable[[Array], Array]:
    """What takes columns (N, ...) of the residuals of a fit to units of noise that is correlated so."""
    it = _residual(found)
    correlations = np.zeros(len(it.sensors))
    for each in sensors:
        correlations[np.searchsorted(it.sensors, each.channel)] = each.correlation
    return lambda columns: it.whitened(columns, correlations)


def _residual(found: Fit) -> _Residual:
    residual, of = found.residual, ReadingErrors.of(found)
    rows = residual.rows
    sensors = np.unique(of.channels[of.there])
    tests = []
    for k in np.unique(residual.load_cases.test[rows[:, 0]]).tolist():
        mine = np.flatnonzero(residual.load_cases.test[rows[:, 0]] == k)
        where = slice(int(mine[0]), int(mine[-1]) + 1)
        first, last = int(residual.load_cases.first[k]), int(residual.load_cases.first[k + 1])
        errors = np.zeros((len(sensors), mine.size, last - first))
        for n, (row, channel) in enumerate(rows[where]):
            own = of.there[row] * of.columns[row, channel]
            for m in np.flatnonzero(own).tolist():
                errors[np.searchsorted(sensors, of.channels[row, m]), n, row - first] += own[m]
        tests.append(_Test(where, errors))
    moved = [residual.flat(each) for each in (residual.slopes, residual.offsets, residual.nominal)]
    return _Residual(residual.without_zeros(residual.left), np.hstack(moved), tuple(tests), sensors)


def _fitted(it: _Residual, criteria: Criteria) -> Array:
    """(S,) correlations of the largest likelihood, zero of sensors whose noise shows none."""
    out = np.zeros(len(it.sensors))
    enough = float(norm.isf(criteria.check_level / max(len(it.sensors), 1)))
    while True:
        scores = np.where(out > 0.0, -np.inf, it.scores(out))
        best = int(np.argmax(scores)) if scores.size else 0
        if not scores.size or scores[best] < enough:
            return out
        free = np.flatnonzero((out > 0.0) | (np.arange(out.size) == best))
        out = _most_likely(it, out, free)
        if out[best] <= 0.0:
            return out


def _most_likely(it: _Residual, start: Array, free: NDArray[np.int64]) -> Array:
    def loss(values: Array) -> tuple[float, Array]:
        return it.loss(_with(start, free, values), free)

    first = np.where(start[free] > 0.0, start[free], CORRELATION.first)
    found = minimize(
        loss, first, jac=True, bounds=[(0.0, CORRELATION.largest)] * free.size, method="L-BFGS-B"
    )
    return _with(start, free, np.asarray(found.x))


def _with(correlations: Array, at: NDArray[np.int64], values: Array) -> Array:
    out = correlations.copy()
    out[at] = values
    return out


def _each(it: _Residual, correlations: Array) -> Iterator[Correlated]:
    for k in np.flatnonzero(correlations > 0.0).tolist():
        at, middle = np.array([k]), min(float(correlations[k]), CORRELATION.largest - CORRELATION.step)
        low, high = (
            it.loss(_with(correlations, at, at * 0.0 + middle + d), at)[1][0]
            for d in (-CORRELATION.step, CORRELATION.step)
        )
        # Twice the log likelihood has twice the information.
        information = max(0.25 * (high - low) / CORRELATION.step, ROUNDING)
        yield Correlated(int(it.sensors[k]), float(correlations[k]), float(1.0 / np.sqrt(information)))


def _explains(found: Fit, it: _Residual, correlations: Array, criteria: Criteria) -> bool:
    """Whether what is left in units of the correlated noise is noise, the numbers of the fit fitted anew."""
    level, taken = criteria.check_level, basis(it.whitened(it.moved, correlations))
    z = _beside(it.whitened(it.left, correlations), taken)
    size = float(z @ z)
    degrees = max(it.left.size - taken.shape[1] - int(np.sum(correlations > 0.0)), 1)
    scatter = 1.0
    if chi2.sf(size, degrees) < level:
        scatter = float(np.sqrt(size / degrees))
        if scatter > criteria.scatter_factor:
            return False
    series = series_of(found, z)
    worst = min(float(chi2.sf(float(r @ r) / scatter**2, r.size)) for r in series) * len(series)
    if worst < level or not without_order(series, level):
        return False
    return _no_pattern(found, it, correlations, z, scatter, criteria)


def _no_pattern(
    found: Fit, it: _Residual, correlations: Array, z: Array, scatter: float, criteria: Criteria
) -> bool:
    every = list(shapes(found, criteria))
    if not every:
        return True
    taken = basis(it.whitened(it.moved, correlations))
    columns = _beside(it.whitened(np.stack([each.column for each in every], axis=1), correlations), taken)
    sizes = np.linalg.norm(columns, axis=0)
    largest = max(abs(steady(columns[:, k] / sizes[k], z)) for k in np.flatnonzero(sizes > 0.0))
    return 2.0 * float(norm.sf(largest / scatter)) * len(every) >= criteria.check_level


def _beside(columns: Array, taken: Array) -> Array:
    return np.asarray(columns - taken @ (taken.T @ columns))


def series_of(found: Fit, z: Array) -> list[Array]:
    """Residuals (N,) of each test and channel, in the order of the rows."""
    rows = found.residual.rows
    keys = np.stack([found.residual.load_cases.test[rows[:, 0]], rows[:, 1]], axis=1)
    return [z[np.all(keys == key, axis=1)] for key in np.unique(keys, axis=0)]


def without_order(series: Sequence[Array], level: float) -> bool:
    """Whether neighbouring residuals are no more alike than noise makes them; series: (n,) in the order of the
    steps."""
    try:
        return lag_one(series).p_value >= level
    except ValueError:
        return True
