"""Weighted least squares of the free numbers of a model, with the exact derivatives of the equilibria."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from pipeline.inference.model import Model
from pipeline.inference.prediction import Prediction, predict
from pipeline.inference.program import Program
from pipeline.inference.residual import Residual, Whitening, residual, whitening

Array = NDArray[np.float64]
REWEIGHTINGS = 4
SETTLED = 1e-2
"""Weights are renewed until that moves no number by more than this part of its standard error."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A model at its best fit to the tests that may be fitted.

    prediction, residual: there, with the weights of its own tangent. evaluations: of the whole campaign.
    """

    model: Model
    prediction: Prediction
    residual: Residual
    evaluations: int

    @cached_property
    def whitened(self) -> Array:
        """(N,) residuals of the fitted tests, unknown zeros projected out."""
        return _free_of(self.residual.flat(self.residual.offsets), self.residual.flat(self.residual.values))

    @cached_property
    def jacobian(self) -> Array:
        """(N, P) whitened derivative of the predictions, unknown zeros projected out."""
        return _free_of(self.residual.flat(self.residual.offsets), self.residual.flat(self.residual.slopes))

    @property
    def chi_square(self) -> float:
        """Sum of squares of the whitened residuals."""
        return float(self.whitened @ self.whitened)

    @cached_property
    def degrees(self) -> int:
        """Residuals less fitted numbers and unknown zeros."""
        zeros = self.residual.flat(self.residual.offsets)
        lost = np.linalg.matrix_rank(zeros) if zeros.size else 0
        return int(self.whitened.size - lost - len(self.model.free))

    @property
    def rms(self) -> float:
        """Whitened root mean square over the degrees of freedom; 1 is noise."""
        return float(np.sqrt(self.chi_square / max(self.degrees, 1)))

    @property
    def deviance(self) -> float:
        """-2 log likelihood, but for a constant of the data: chi-square and the size of the noise."""
        return self.chi_square + self.residual.log_determinant

    @cached_property
    def covariance(self) -> Array:
        """(P, P) of the free numbers; infinite variance where the data say nothing."""
        scale = np.array([abs(each.parameter.typical) for each in self.model.free])
        scaled = self.jacobian * scale
        values, vectors = np.linalg.eigh(scaled.T @ scaled)
        seen = values > 1e-12 * max(values.max(initial=0.0), 1e-300)
        inverse = (vectors[:, seen] / values[seen]) @ vectors[:, seen].T
        hidden = np.sum(vectors[:, ~seen] ** 2, axis=1) > 1e-6
        inverse[hidden, hidden] = np.inf
        return np.asarray(inverse * scale[:, None] * scale)

    @property
    def std(self) -> Array:
        """(P,) standard errors."""
        return np.sqrt(np.diag(self.covariance))


@dataclass(eq=False)
class Objective:
    """Whitened residuals and derivatives at values (P,), the weights held; remembers where it was."""

    model: Model
    program: Program
    weights: Whitening
    start: Prediction
    count: int = 0
    _last: tuple[bytes, Residual] | None = field(default=None, repr=False)

    def at(self, values: Array) -> Residual:
        """The residual at values, solved once for residuals and derivatives."""
        key = np.asarray(values).tobytes()
        if self._last is None or self._last[0] != key:
            self.start = predict(self.model.at(values), self.program, start=self.start)
            self.count += 1
            self._last = (key, residual(self.program, self.start, self.weights))
        return self._last[1]

    def residuals(self, values: Array) -> Array:
        """(N,)"""
        it = self.at(values)
        return _free_of(it.flat(it.offsets), it.flat(it.values))

    def jacobian(self, values: Array) -> Array:
        """(N, P)"""
        it = self.at(values)
        return -_free_of(it.flat(it.offsets), it.flat(it.slopes))


def fit(
    model: Model,
    program: Program,
    start: Prediction | None = None,
    watch: Callable[[str], None] | None = None,
) -> Fit:
    """The best fit that is found from the model's own values.

    Weights are those of the present tangent, renewed until they settle (iteratively reweighted least squares);
    within, a trust-region method with bounds (M. A. Branch, T. F. Coleman, Y. Li, SIAM J. Sci. Comput. 21, 1999).
    """
    free = model.free
    bounds = np.array([each.bounds for each in free]).T.reshape(2, -1)
    scale = np.array([abs(each.parameter.typical) for each in free])
    values, count = np.clip(model.values, *bounds), 1
    here = predict(model.at(values), program, slopes=bool(free), start=start)
    weights = whitening(program, here)
    if not free:
        return Fit(model, here, residual(program, here, weights), 1)
    for _ in range(REWEIGHTINGS):
        # What was solved to renew the weights need not be solved again.
        known = (values.tobytes(), residual(program, here, weights))
        aim = Objective(model, program, weights, here, _last=known)
        found = least_squares(
            aim.residuals,
            values,
            jac=aim.jacobian,
            bounds=bounds,
            x_scale=scale,
            xtol=1e-6,
            ftol=1e-6,
            gtol=1e-8,
            max_nfev=40,
        )
        moved, values = np.abs(found.x - values), found.x
        here = _settled(aim, values)
        count += aim.count
        weights = whitening(program, here)
        if watch is not None:
            watch(f"{count} evaluations, chi-square {2 * found.cost:.4g}")
        best = Fit(model.at(values), here, residual(program, here, weights), count)
        if np.all(moved <= SETTLED * best.std):
            break
    return best


def _settled(aim: Objective, values: Array) -> Prediction:
    aim.at(values)
    return aim.start


def _free_of(columns: Array, values: Array) -> Array:
    """Values (N, ...) less their part along the columns (N, O)."""
    if not columns.shape[1]:
        return values
    basis, triangle = np.linalg.qr(columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300))
    basis = basis[:, np.abs(np.diag(triangle)) > 1e-9]
    return np.asarray(values - basis @ (basis.T @ values))
