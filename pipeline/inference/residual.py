"""Residuals in units of their own noise, with inputs that are measured as well.

What is prescribed at a step is read with noise too: y = f(xi) + noise, x = xi + noise, the true inputs xi unknown.
Linearised at inputs xi_0 near them, with A = df/dxi there, the residual

    e = y - f(xi_0) - A (x - xi_0),    covariance S = diag(sigma_y²) + A diag(sigma_x²) A^T,

has chi² = e^T S^-1 e, which is what remains when xi is fitted as well, at xi = x + Sigma_x A^T S^-1 e. Taking
f and its derivatives there, and not at the measured x, keeps the noise of the inputs out of the slopes, where it
would pull every stiffness down. An input's error moves several channels at once, so S is not diagonal; residuals
are whitened with its Cholesky factor. A kink ends the line: inputs that fit best beyond it are brought back to it,
and the row is charged with what that costs; without that, the better of two sides takes up the noise of every row
that is near a kink. What the noise of earlier steps does to a memory is left out.
W. A. Fuller, "Measurement Error Models", Wiley 1987, chapter 3; H. I. Britt, R. H. Luecke, Technometrics 15 (1973).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.eliminated import Marginal
from pipeline.inference.load_cases import LOST, LoadCases
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.predicted import Prediction
from pipeline.inference.settings import INPUTS, STOPS
from pipeline.inference.stops import on_their_sides

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Whitening:
    """Inverse Cholesky factors (R, C, C) of the noise; channels that are not compared have a unit row."""

    factors: Array
    used: np.ndarray

    def apply(self, values: Array) -> Array:
        """Whitened (R, C, ...) of values (R, C, ...), zero where not compared."""
        shape = self.used.shape + (1,) * (values.ndim - 2)
        kept = np.where(self.used.reshape(shape), values, 0.0)
        return np.einsum("rij,rj...->ri...", self.factors, kept)


def whitening(load_cases: LoadCases, prediction: Prediction) -> Whitening:
    """That of a prediction's own tangent."""
    used = load_cases.predicted
    through = _through(load_cases, prediction) * load_cases.input_sigma[:, None, :]
    scale = np.where(used, load_cases.spread, 1.0)
    through = through / scale[..., None]
    return Whitening(_inverse_root(through) / scale[:, None, :], used)


def _inverse_root(through: Array) -> Array:
    """(R, C, C) inverse of the lower Cholesky factor of 1 + T Tᵀ, T (R, C, K).

    Where T is so large that the sum loses its ones to rounding, the factor is the triangle of a QR of [1, Tᵀ], which
    never forms the sum (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., 2013, section 5.2).
    """
    size = through.shape[1]
    factors = np.empty((len(through), size, size))
    huge = np.max(np.abs(through), axis=(1, 2), initial=0.0) > INPUTS.rounded
    plain = through[~huge]
    factors[~huge] = np.linalg.cholesky(plain @ np.swapaxes(plain, -1, -2) + np.eye(size))
    if huge.any():
        ones = np.broadcast_to(np.eye(size), (int(huge.sum()), size, size))
        upper = np.linalg.qr(np.concatenate([np.swapaxes(through[huge], -1, -2), ones], axis=1), mode="r")
        upper = upper * np.sign(np.diagonal(upper, axis1=-2, axis2=-1))[..., None]
        factors[huge] = np.swapaxes(upper, -1, -2)
    return np.asarray(np.linalg.inv(factors))


def _through(load_cases: LoadCases, prediction: Prediction) -> Array:
    """(R, C, 7) derivative by the inputs of the channels that are compared; none of a lost row."""
    kept = load_cases.predicted & ~prediction.lost[:, None]
    return np.where(kept[..., None], prediction.by_inputs, 0.0)


@dataclass(frozen=True, eq=False)
class Residual:
    """e whitened: (R, C), zero where nothing is compared.

    slopes: (R, C, P) of the prediction, whitened. offsets: (R, C, O) whitened columns of unknown zeros. nominal: (R, C,
    K) whitened derivative of the prediction by what was written about the rig, in standard deviations; departure: (K,)
    those at which it is predicted.
    shift: (R, 7) of the inputs that fit best, from the measured ones, as far as noise may move them. across, charge,
    undecided: as in `pipeline.inference.stops.Sides`.
    """

    load_cases: LoadCases
    values: Array
    slopes: Array
    offsets: Array
    nominal: Array
    departure: Array
    shift: Array
    across: Array
    charge: Array
    undecided: np.ndarray

    @cached_property
    def rows(self) -> np.ndarray:
        """(N, 2) row and channel of every residual of the tests that may be fitted."""
        return np.argwhere(self.load_cases.predicted & self.load_cases.fitted[:, None])

    @cached_property
    def charged(self) -> float:
        """Chi-square of the charges of the tests that may be fitted."""
        return float(np.sum(self.charge[self.load_cases.fitted]))

    @property
    def doubt(self) -> float:
        """Chi-square that the choice of sides may have taken up in the tests that may be fitted."""
        return STOPS.side * float(np.sum(self.undecided[self.load_cases.fitted]))

    @property
    def spread(self) -> float:
        """By how much more than that, two standard deviations."""
        return STOPS.spread * float(np.sqrt(np.sum(self.undecided[self.load_cases.fitted])))

    def flat(self, array: Array) -> Array:
        """(N, ...) of the tests that may be fitted."""
        return np.asarray(array[self.rows[:, 0], self.rows[:, 1]])

    def free(self, array: Array) -> Array:
        """(N, ...) of the tests that may be fitted, unknown zeros projected out and what was written eliminated."""
        return self.weakened(self.without_zeros(array))

    def without_zeros(self, array: Array) -> Array:
        """(N, ...) of the tests that may be fitted, unknown zeros projected out."""
        zeros, values = self.zeros, self.flat(array)
        return np.asarray(values - zeros @ (zeros.T @ values)) if zeros.shape[1] else values

    def weakened(self, columns: Array) -> Array:
        """Columns (N, ...), what was written about the rig eliminated from them."""
        return columns if self.marginal is None else self.marginal.weakened(columns)

    @cached_property
    def marginal(self) -> Marginal | None:
        """What was written about the rig beside the residuals of the tests that may be fitted; None where all of it is
        exact."""
        return Marginal.of(self.without_zeros(self.nominal)) if self.departure.size else None

    @cached_property
    def as_written(self) -> Array:
        """(R, C) residuals where what was written is true, along the line of the prediction."""
        return self.values + self.nominal @ self.departure if self.departure.size else self.values

    @cached_property
    def estimate(self) -> Array:
        """(K,) what was written, in standard deviations from it, as it fits best."""
        if self.marginal is None:
            return self.departure
        return np.asarray(self.marginal.pull @ self.without_zeros(self.as_written))

    @cached_property
    def left(self) -> Array:
        """(R, C) residuals where what was written is as it fits best."""
        if self.marginal is None:
            return self.values
        return np.asarray(self.values - self.nominal @ (self.estimate - self.departure))

    @cached_property
    def level(self) -> Array:
        """(R, C) the same less what unknown zeros make of it, which are those of one test each."""
        left = self.left
        if not self.offsets.shape[-1]:
            return left
        left, first = left.copy(), self.load_cases.first
        for rows in (slice(int(a), int(b)) for a, b in pairwise(first)):
            own = self.offsets[rows]
            own = own[..., np.any(own, axis=(0, 1))].reshape(left[rows].size, -1)
            if own.shape[1]:
                zeros, values = basis(own), left[rows].ravel()
                left[rows] = (values - zeros @ (zeros.T @ values)).reshape(left[rows].shape)
        return left

    @cached_property
    def zeros(self) -> Array:
        """(N, r) orthonormal basis of what unknown zeros can make of the residuals of the tests that may be fitted.

        Zeros may be of channels without a reading, or be seen only together: a QR without pivots would keep other
        directions than theirs.
        """
        return basis(self.flat(self.offsets))

    @cached_property
    def whitened(self) -> Array:
        """(N,) residuals of the tests that may be fitted, of unit covariance: zeros projected out, what was written
        eliminated. Their sum of squares is that of the residuals and of the departures from what was written."""
        return self.free(self.as_written)

    @cached_property
    def aimed(self) -> Array:
        """(N + 1,) what a fit makes least: the residuals and, at the end, what rows beside their stops are charged."""
        return np.append(self.whitened, np.sqrt(self.charged))

    @cached_property
    def aimed_by(self) -> Array:
        """(N + 1, P) its derivative; charges follow the sides of rows, which no slope foresees."""
        slopes = self.free(self.slopes)
        return np.vstack([-slopes, np.zeros((1, slopes.shape[1]))])


def residual(load_cases: LoadCases, prediction: Prediction) -> Residual:
    """The residual of a prediction with the weights of its own tangent."""
    weights, through = whitening(load_cases, prediction), _through(load_cases, prediction)
    carried = np.einsum("rci,ri->rc", through, prediction.shift)
    difference = np.where(load_cases.predicted, load_cases.measured - prediction.values + carried, 0.0)
    values = weights.apply(difference)
    slopes, offsets = weights.apply(prediction.by_free), weights.apply(_unknown_zeros(load_cases, prediction))
    gain = np.einsum("rij,rjk->rik", weights.factors, through)
    values[prediction.lost] = np.where(load_cases.predicted[prediction.lost], LOST, 0.0)
    slopes[prediction.lost] = 0.0
    offsets[prediction.lost] = 0.0
    nominal = np.zeros((*values.shape, 0))
    if prediction.nominal.size:
        nominal = weights.apply(prediction.by_nominal)
        nominal[prediction.lost] = 0.0
    none, nothing = np.zeros_like(prediction.shift), np.zeros(len(values))
    it = Residual(
        load_cases, values, slopes, offsets, nominal, prediction.nominal, none, none, nothing, nothing > 0.0
    )
    # True inputs are those that fit best with what was written, and with unknown zeros, as they fit best.
    shift = load_cases.input_sigma**2 * np.einsum("rik,ri->rk", gain, it.level)
    sides = on_their_sides(prediction, shift, load_cases.input_sigma, gain)
    shift, across = (_near(each, load_cases.input_sigma) for each in (sides.shift, sides.across))
    return replace(it, shift=shift, across=across, charge=sides.charge, undecided=sides.undecided)


def _near(shift: Array, sigma: Array) -> Array:
    """(R, 7) shifts of the inputs, each row shortened to what noise could be: what would take more is explained by
    something else, and a model that is linearised so far away is another one."""
    size = np.divide(np.abs(shift), sigma, out=np.zeros_like(shift), where=sigma > 0.0).max(
        axis=1, keepdims=True
    )
    return shift * (INPUTS.farthest / np.maximum(size, INPUTS.farthest))


def _unknown_zeros(load_cases: LoadCases, prediction: Prediction) -> Array:
    """(R, C, O) what an unknown zero of each sensor does in the tests that leave it unknown.

    Sensors that were zeroed at a first row have zeros that are known to the noise of one reading. A constant of each
    is as well known by that reading itself, which is one of those compared. What is prescribed was zeroed as well then:
    to first order that is a constant of what is read.
    """
    columns = []
    channels = load_cases.measured.shape[1]
    for k, test in enumerate(load_cases.campaign.tests):
        rows = slice(int(load_cases.first[k]), int(load_cases.first[k + 1]))
        control = load_cases.channels[rows.start]
        through = load_cases.loose[k] if test.zero == "fitted" else load_cases.from_first[k]
        for channel in np.flatnonzero(load_cases.loose[k]):
            column = np.zeros((len(load_cases.test), channels))
            if channel in control:
                # A zero of a prescribed quantity acts through the mechanism.
                known = not np.any(load_cases.input_sigma[rows, :6][:, control == channel])
                if known or not through[channel]:
                    continue
                column[rows] = -prediction.by_inputs[rows][..., np.flatnonzero(control == channel)[0]]
            elif np.any(load_cases.predicted[rows, channel]):
                column[rows, channel] = 1.0
            else:
                continue
            columns.append(column)
    return np.stack(columns, axis=-1) if columns else np.zeros((len(load_cases.test), channels, 0))
