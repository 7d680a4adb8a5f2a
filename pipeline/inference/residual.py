"""Residuals in units of their own noise.

The noise of a predicted channel is that of its sensor and, through the model's tangent, that of what was
prescribed at the same step: S = diag(sigma²) + A diag(sigma_in²) A^T + a a^T sigma_T², A the derivative by what is
prescribed and a that by temperature. An input's error moves several channels at once, so S is not diagonal;
residuals are whitened with its Cholesky factor. What the noise of earlier steps does to a memory is left out.
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
    through = np.where(used[..., None], prediction.by_inputs, 0.0) * program.input_sigma[:, None, :]
    through = np.where(prediction.lost[:, None, None], 0.0, through)
    warm = np.where(used & ~prediction.lost[:, None], prediction.by_temperature, 0.0)
    warm = warm[..., None] * program.temperature_sigma
    noise = through @ np.swapaxes(through, -1, -2) + warm @ np.swapaxes(warm, -1, -2)
    scale = np.where(used, program.sigma, 1.0)
    unit = noise / scale[:, :, None] / scale[:, None, :]
    unit[:, range(used.shape[1]), range(used.shape[1])] += 1.0
    factors = np.linalg.inv(np.linalg.cholesky(unit)) / scale[:, None, :]
    return Whitening(factors, used)


@dataclass(frozen=True, eq=False)
class Residual:
    """Measured less predicted, whitened: (R, C), zero where nothing is compared.

    slopes: (R, C, P) of the prediction, whitened. offsets: (R, C, O) whitened columns of unknown zeros.
    """

    program: Program
    values: Array
    slopes: Array
    offsets: Array
    log_determinant: float

    @cached_property
    def rows(self) -> np.ndarray:
        """(N, 2) row and channel of every residual of the tests that may be fitted."""
        return np.argwhere(self.program.predicted & self.program.fitted[:, None])

    def flat(self, array: Array) -> Array:
        """(N, ...) of the tests that may be fitted."""
        return np.asarray(array[self.rows[:, 0], self.rows[:, 1]])


def residual(program: Program, prediction: Prediction, weights: Whitening) -> Residual:
    """The residual of a prediction, whitened with given weights."""
    difference = np.where(program.predicted, program.measured - prediction.values, 0.0)
    values = weights.apply(difference)
    slopes, offsets = weights.apply(prediction.by_free), weights.apply(_unknown_zeros(program, prediction))
    values[prediction.lost] = np.where(program.predicted[prediction.lost], LOST, 0.0)
    slopes[prediction.lost] = 0.0
    offsets[prediction.lost] = 0.0
    diagonal = np.diagonal(weights.factors, axis1=1, axis2=2)
    use = program.predicted & program.fitted[:, None]
    determinant = -2.0 * float(np.sum(np.log(np.abs(diagonal[use]))))
    return Residual(program, values, slopes, offsets, determinant)


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
                if not np.any(program.input_sigma[rows, control == channel]):
                    continue
                column[rows] = -prediction.by_inputs[rows][..., np.flatnonzero(control == channel)[0]]
            elif np.any(program.predicted[rows, channel]):
                column[rows, channel] = 1.0
            else:
                continue
            columns.append(column)
    return np.stack(columns, axis=-1) if columns else np.zeros((len(program.test), channels, 0))
