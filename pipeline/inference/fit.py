"""Weighted least squares of the free numbers of a model, with the exact derivatives of the equilibria."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.levenberg_marquardt import levenberg_marquardt
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.nuisance_line import along_a_line, with_line
from pipeline.inference.nuisances import beside, lined, nominals
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.predicted import Prediction
from pipeline.inference.residual import Residual, residual
from pipeline.inference.rounding import SQUARED, TINY
from pipeline.inference.settings import PROFILE
from pipeline.inference.solvers import ALL, WORK, Effort, End, Solver, Watch, allowance, far
from pipeline.inference.subsets import at_rows, joined
from vjm.work import within

Array = NDArray[np.float64]
LOG = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Fit:
    """A model at its best fit to the tests that may be fitted.

    prediction, residual: there. evaluations: of the whole campaign. ended: whether its work ran out before. own_line:
    whether what was written about the rig is eliminated along the line of this model.
    """

    model: Model
    prediction: Prediction
    residual: Residual
    evaluations: int
    ended: bool = False
    own_line: bool = False

    @cached_property
    def whitened(self) -> Array:
        """(N,) residuals of the fitted tests, free of unknown zeros and of what was written about the rig."""
        return self.residual.whitened

    @cached_property
    def jacobian(self) -> Array:
        """(N, P) whitened derivative of the predictions, free of the same."""
        return self.residual.free(self.residual.slopes)

    @property
    def chi_square(self) -> float:
        """Sum of squares of the whitened residuals, with that of the departures from what was written, and what rows
        beside their stops are charged."""
        return float(self.whitened @ self.whitened) + self.residual.charged

    @cached_property
    def zeros(self) -> int:
        """Unknown zeros. Rows that a model loses have no column of theirs, but it is still there to be spent."""
        return max(self.residual.zeros.shape[1], self.residual.load_cases.unknown_zeros)

    @cached_property
    def numbers(self) -> int:
        """Free numbers that the readings determine, alone or together: those that nothing reads take no residual."""
        free = len(self.model.free)
        # Beside a function at a site the slopes are those of the function.
        return int(np.sum(_seen(self._information[1]))) if self.jacobian.shape[1] == free else free

    @cached_property
    def degrees(self) -> int:
        """Residuals less fitted numbers and unknown zeros."""
        return int(self.whitened.size - self.zeros - self.numbers)

    @cached_property
    def lost(self) -> int:
        """Rows of the fitted tests without a prediction."""
        return int(np.sum(self.prediction.lost & self.residual.load_cases.fitted))

    @property
    def order(self) -> tuple[int, float]:
        """Of two fits to the same data the one that is less by this is the better: a row without a prediction is worse
        than one that is badly predicted, whatever it counts in chi-square."""
        return self.lost, self.chi_square

    @property
    def rms(self) -> float:
        """Whitened root mean square over the degrees of freedom; 1 is noise."""
        return float(np.sqrt(self.chi_square / max(self.degrees, 1)))

    @cached_property
    def _information(self) -> tuple[Array, Array, Array]:
        """(P,) typical sizes of the free numbers; (P,), (P, P) eigenvalues and vectors of the information in them."""
        scale = np.array([abs(each.parameter.typical) for each in self.model.free])
        scaled = self.jacobian * scale
        return scale, *np.linalg.eigh(scaled.T @ scaled)

    @cached_property
    def covariance(self) -> Array:
        """(P, P) of the free numbers; infinite variance where the data say nothing."""
        scale, values, vectors = self._information
        seen = _seen(values)
        inverse = (vectors[:, seen] / values[seen]) @ vectors[:, seen].T
        hidden = np.sum(vectors[:, ~seen] ** 2, axis=1) > PROFILE.shared**2
        inverse[hidden, hidden] = np.inf
        return np.asarray(inverse * scale[:, None] * scale)

    @cached_property
    def finite_covariance(self) -> Array:
        """(P, P) with zeros for numbers about which the data say nothing."""
        seen = np.isfinite(np.diag(self.covariance))
        return np.where(seen[:, None] & seen, self.covariance, 0.0)

    @cached_property
    def nominal_slopes(self) -> Array:
        """(K, P) by which what was written about the rig, as it fits best, follows the free numbers."""
        it = self.residual
        if it.marginal is None:
            return np.zeros((0, len(self.model.free)))
        return np.asarray(-it.marginal.pull @ it.without_zeros(it.slopes))

    @cached_property
    def nominal_covariance(self) -> Array:
        """(K, K) of what was written, in standard deviations of it, the free numbers fitted."""
        if self.residual.marginal is None:
            return np.zeros((0, 0))
        follows = self.nominal_slopes
        return self.residual.marginal.covariance + follows @ self.finite_covariance @ follows.T

    @property
    def std(self) -> Array:
        """(P,) standard errors."""
        return np.sqrt(np.diag(self.covariance))


def _seen(values: Array) -> NDArray[np.bool_]:
    """Of which eigenvalues of the information the readings tell more than rounding."""
    return np.asarray(values > SQUARED * max(values.max(initial=0.0), TINY))


def fit(
    model: Model,
    load_cases: LoadCases,
    start: Prediction | None = None,
    watch: Watch | None = None,
    plausible: float = np.inf,
    effort: Effort = ALL,
    solver: Solver = levenberg_marquardt,
) -> Fit:
    """The best fit that is found from the model's own values.

    plausible: typical sizes from null that stand for one sigma of a weak pull towards null: numbers that the data
    say nothing about stay there. Chi-square is that of the data alone. effort, solver:
    `pipeline.inference.solvers`. What was written about the rig is eliminated along the line of the start; without one
    along the fit's own.
    """
    known = (start is not None and start.nominal.size > 0) or not nominals(load_cases.campaign)
    begin = start if known else lined(model, load_cases, start)
    found = _fit(model, load_cases, begin, watch, plausible, effort, solver)
    if known or far(found.chi_square, found.whitened.size):
        # No verdict hangs on the error bars of a model that is far off.
        return found
    own = with_own_line(found, load_cases, plausible, solver)
    return replace(own, evaluations=own.evaluations + 2)


def _fit(
    model: Model,
    load_cases: LoadCases,
    start: Prediction | None,
    watch: Watch | None,
    plausible: float,
    effort: Effort,
    solver: Solver,
) -> Fit:
    (rows, own), *others = load_cases.by_role
    begin = start if start is None or not others else at_rows(start, load_cases, own, rows)

    def solve(begin: Evaluation) -> End:
        if begin.objective.model.free:
            return solver(begin, watch, plausible, effort)
        there = begin.settle()
        return End(there, there.rounds - begin.rounds, ended=False)

    LOG.info("fit of %s from %s", ", ".join(model.names) or "the plain model", model.values)
    with within(effort.share * WORK * allowance(own)):
        end = along_a_line(model, own, begin, solve, effort)
    left = float(np.sum(end.there.residuals**2))
    LOG.info("ended after %d evaluations%s", end.evaluations, ", as its work ran out" if end.ended else "")
    LOG.info("sum of squares %.9g, rows lost %d, numbers %s", left, end.there.lost, end.there.values)
    values, there, model = end.there.values, end.there.with_slopes, end.there.objective.model
    if not others:
        return Fit(model.at(values), there.prediction, there.residual, end.evaluations, end.ended)
    pieces = [(rows, own, there.prediction)]
    for rest, apart in others:
        near = None if start is None else at_rows(start, load_cases, apart, rest)
        # Tests that are held out say nothing of what was written: it is where the others leave it.
        found = Objective(model, apart).at(values, near).with_slopes.prediction
        pieces.append((rest, apart, with_line(model.at(values), found, near, apart)))
    whole = joined(load_cases, pieces)
    return Fit(model.at(values), whole, residual(load_cases, whole), end.evaluations, end.ended)


def as_it_is(model: Model, load_cases: LoadCases, start: Prediction) -> Fit:
    """What a model with its own values leaves of the tests that may be fitted, and how that follows its free numbers:
    nothing is fitted but the inputs. What was written about the rig is where it is in the start, a prediction of a like
    model."""
    rows, own = load_cases.by_role[0]
    near = at_rows(start, load_cases, own, rows)
    model, own = beside(model, own, near)
    there = Objective(model, own).at(model.values, near).with_slopes
    return Fit(model, there.prediction, there.residual, there.rounds)


def numbers_of(model: Model, load_cases: LoadCases, there: Prediction) -> int:
    """Numbers of a model that the readings determine, with its own values, which predict what is there."""
    return as_it_is(model, load_cases, there).numbers if model.free and load_cases.fitted.any() else 0


def unmoved(found: Fit, cases: LoadCases) -> Fit | None:
    """The same fit beside other readings of tests that were held out; None where those of fitted ones are others, or
    what a test is done on, at and with."""
    before, rows = found.residual.load_cases, cases.fitted
    if not cases.done_alike(before) or not np.array_equal(rows, before.fitted):
        return None
    for name in ("measured", "spread", "input_sigma"):
        one, other = getattr(cases, name), getattr(before, name)
        if not np.array_equal(one[rows], other[rows], equal_nan=True):
            return None
    return replace(found, residual=residual(cases, found.prediction), evaluations=0)


def with_own_line(
    found: Fit, load_cases: LoadCases, plausible: float = np.inf, solver: Solver = levenberg_marquardt
) -> Fit:
    """A fit along its own line, from where it is; the same where all is exact."""
    if not found.prediction.nominal.size or found.own_line:
        return found
    line = lined(found.model, load_cases, found.prediction)
    start = replace(found.prediction, by_nominal=line.by_nominal)
    new = _fit(found.model, load_cases, start, None, plausible, ALL, solver)
    count, ended = found.evaluations + new.evaluations + 2, found.ended or new.ended
    return replace(new, evaluations=count, ended=ended, own_line=True)


def at_null(model: Model, smaller: Fit) -> Fit:
    """The fit of a larger model whose further effects are absent, and stay so: that of the smaller one."""
    old = {f.name: v for f, v in zip(smaller.model.free, smaller.model.values, strict=True)}
    values = np.array([old.get(f.name, f.parameter.null) for f in model.free])
    further = {f.name for f in model.free if f.name not in old}
    fixed = model.fixed | further
    absent = replace(model.at(values), fixed=fixed, nominals=smaller.model.nominals)
    return Fit(absent, smaller.prediction, smaller.residual, 0)


def unfitted(model: Model, cases: LoadCases, start: Prediction | None = None) -> Fit:
    """A model as it is: nothing is fitted but the inputs, which were measured as well, and what was written about the
    rig. start: a prediction of a like model."""
    fixed = replace(model, fixed=frozenset(each.name for each in model.free) | model.fixed)
    if nominals(cases.campaign):
        return fit(fixed, cases, start)
    there = Objective(fixed, cases).at(fixed.values, start)
    return Fit(fixed, there.prediction, there.residual, there.rounds)
