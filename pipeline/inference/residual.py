"""Residuals in units of their own noise, with inputs that are measured as well.

What is prescribed at a step is read with noise too: y = f(xi) + noise, x = xi + noise, the true inputs xi unknown.
Linearised at inputs xi_0 near them, with A = df/dxi there, the residual

    e = y - f(xi_0) - A (x - xi_0),    covariance S = diag(sigma_y²) + A diag(sigma_x²) A^T,

has chi² = e^T S^-1 e, which is what remains when xi is fitted as well, at xi = x + Sigma_x A^T S^-1 e. Taking
f and its derivatives there, and not at the measured x, keeps the noise of the inputs out of the slopes, where it
would pull every stiffness down. An input's error moves several channels at once, so S is not diagonal; residuals
are whitened with its Cholesky factor. What the noise of earlier steps does to a memory is left out.
W. A. Fuller, "Measurement Error Models", Wiley 1987, chapter 3; H. I. Britt, R. H. Luecke, Technometrics 15 (1973).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.prediction import Prediction
from pipeline.inference.program import Program

Array = NDArray[np.float64]
LOST = 30.0
"""Sigmas that stand for a reading for which the model has no stable equilibrium."""


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


def whitening(program: Program, prediction: Prediction) -> Whitening:
    """That of a prediction's own tangent."""
    used = program.predicted
    through = _through(program, prediction) * program.input_sigma[:, None, :]
    scale = np.where(used, program.sigma, 1.0)
    through = through / scale[..., None]
    unit = through @ np.swapaxes(through, -1, -2) + np.eye(used.shape[1])
    factors = np.linalg.inv(np.linalg.cholesky(unit)) / scale[:, None, :]
    return Whitening(factors, used)


def _through(program: Program, prediction: Prediction) -> Array:
    """(R, C, 7) derivative by the inputs of the channels that are compared; none of a lost row."""
    kept = program.predicted & ~prediction.lost[:, None]
    return np.where(kept[..., None], prediction.by_inputs, 0.0)


@dataclass(frozen=True, eq=False)
class Residual:
    """e whitened: (R, C), zero where nothing is compared.

    slopes: (R, C, P) of the prediction, whitened. offsets: (R, C, O) whitened columns of unknown zeros.
    shift: (R, 7) of the inputs that fit best, from the measured ones.
    """

    program: Program
    values: Array
    slopes: Array
    offsets: Array
    shift: Array

    @cached_property
    def rows(self) -> np.ndarray:
        """(N, 2) row and channel of every residual of the tests that may be fitted."""
        return np.argwhere(self.program.predicted & self.program.fitted[:, None])

    def flat(self, array: Array) -> Array:
        """(N, ...) of the tests that may be fitted."""
        return np.asarray(array[self.rows[:, 0], self.rows[:, 1]])


def residual(program: Program, prediction: Prediction) -> Residual:
    """The residual of a prediction with the weights of its own tangent."""
    weights, through = whitening(program, prediction), _through(program, prediction)
    carried = np.einsum("rci,ri->rc", through, prediction.shift)
    difference = np.where(program.predicted, program.measured - prediction.values + carried, 0.0)
    values = weights.apply(difference)
    slopes, offsets = weights.apply(prediction.by_free), weights.apply(_unknown_zeros(program, prediction))
    gain = np.einsum("rij,rjk->rik", weights.factors, through)
    shift = program.input_sigma**2 * np.einsum("rik,ri->rk", gain, values)
    values[prediction.lost] = np.where(program.predicted[prediction.lost], LOST, 0.0)
    slopes[prediction.lost] = 0.0
    offsets[prediction.lost] = 0.0
    return Residual(program, values, slopes, offsets, shift)


def _unknown_zeros(program: Program, prediction: Prediction) -> Array:
    """(R, C, O) what an unknown zero of each sensor does in the tests that ask for it."""
    columns = []
    channels = program.measured.shape[1]
    for k, test in enumerate(program.campaign.tests):
        if test.zero != "fitted":
            continue
        rows = slice(int(program.first[k]), int(program.first[k + 1]))
        control = program.channels[rows.start]
        for channel in range(channels):
            column = np.zeros((len(program.test), channels))
            if channel in control:
                # A zero of a prescribed quantity acts through the mechanism.
                if not np.any(program.input_sigma[rows, :6][:, control == channel]):
                    continue
                column[rows] = -prediction.by_inputs[rows][..., np.flatnonzero(control == channel)[0]]
            elif np.any(program.predicted[rows, channel]):
                column[rows, channel] = 1.0
            else:
                continue
            columns.append(column)
    return np.stack(columns, axis=-1) if columns else np.zeros((len(program.test), channels, 0))
