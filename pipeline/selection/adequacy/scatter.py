"""How much each sensor scatters, beside what is declared: variance components of the residuals of a fit.

The whitened residual of a row is a sum of the errors of all its readings: of each channel's own sensor, and through the
tangent of the model of every sensor that controls the row. With v the column of a sensor's error (of one declared
standard deviation), and lambda the factor by which that is too small,

    r ~ N(0, S),    S = sum over sensors s of  lambda_s² v_s v_s^T.

The factors are those of the largest likelihood of all rows together, by Fisher's scoring in log lambda_s²: gradient
1/2 sum lambda_s² ((v_s·S^-1 r)² - v_s·S^-1 v_s), information 1/2 sum lambda_s² lambda_t² (v_s·S^-1 v_t)². A row that is
far out is weighed down to what noise may be. It is asked only where what is left has no order: then it is noise, and
nothing smooth is in it. S. R. Searle, G. Casella, C. E. McCulloch, Variance Components, Wiley 1992, section 8.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.inference.fit import Fit
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import SCATTERING
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Scatter:
    """A sensor by the number of its channel. factor: by which its declared sigma is too small; error: standard error of
    the logarithm of that."""

    channel: int
    factor: float
    error: float

    def differs(self, criteria: Criteria, unexplained: bool) -> bool:
        """Whether it counts instead of what was declared. unexplained: whether, with what was declared, more is left
        than noise leaves."""
        off = abs(np.log(self.factor))
        errors = criteria.sigma_errors_unexplained if unexplained else criteria.sigma_errors
        known = self.error < criteria.sigma_known
        return bool(known and off > np.log(criteria.sigma_factor) and off > errors * self.error)


def scatters(found: Fit) -> tuple[Scatter, ...]:
    """Of every sensor that the fitted tests read."""
    of, residual = ReadingErrors.of(found), _residual(found)
    rows = of.there.any(axis=1)
    columns = np.where(of.there[:, None, :], of.columns, 0.0)[rows]
    channels, left = of.channels[rows], residual[rows]
    sensors = np.unique(channels[of.there[rows]])
    if not sensors.size:
        return ()
    # (R, M, S) which sensor each reading is of.
    owner = (channels[..., None] == sensors).astype(float)
    prior, logs = np.eye(sensors.size) / (2.0 * SCATTERING.wide) ** 2, np.zeros(sensors.size)
    for _ in range(SCATTERING.rounds):
        gradient, information = _scored(columns, owner, left, logs)
        step = np.linalg.solve(information + prior, gradient - prior @ logs)
        logs = logs + np.clip(step, -1.0, 1.0)
        if np.abs(step).max() < SCATTERING.settled:
            break
    errors = np.sqrt(np.diag(np.linalg.inv(_scored(columns, owner, left, logs)[1] + prior)))
    return tuple(
        Scatter(int(k), float(np.exp(0.5 * log)), 0.5 * float(error))
        for k, log, error in zip(sensors, logs, errors, strict=True)
    )


def _scored(columns: Array, owner: Array, left: Array, logs: Array) -> tuple[Array, Array]:
    """Gradient (S,) and information (S, S) of the log likelihood by log lambda²; columns (R, C, M), owner (R, M, S),
    left (R, C)."""
    size = np.einsum("rms,s->rm", owner, np.exp(logs))
    turned = np.swapaxes(columns, 1, 2)
    covariance = (columns * size[:, None, :]) @ turned
    index = np.arange(left.shape[1])
    # A channel without a reading has no column: it is apart, and its residual is zero.
    covariance[:, index, index] += np.where(np.any(columns != 0.0, axis=2), 0.0, 1.0)
    inverse = np.linalg.inv(covariance)
    pulled = np.einsum("rcd,rd->rc", inverse, left)
    count = np.maximum(np.sum(np.any(columns != 0.0, axis=2), axis=1), 1)
    farthest = chi2.isf(SCATTERING.far_out, count)
    weight = np.minimum(1.0, farthest / np.maximum(np.einsum("rc,rc->r", left, pulled), TINY))
    through = np.einsum("rcm,rc->rm", columns, pulled) ** 2 * weight[:, None]
    inner = turned @ inverse @ columns
    own = np.einsum("rmm->rm", inner)
    gradient = 0.5 * np.einsum("rm,rms->s", size * (through - own), owner)
    products = size[:, :, None] * size[:, None, :] * inner**2
    information = 0.5 * np.einsum("rms,rmt->st", owner, products @ owner)
    return gradient, information


def _residual(found: Fit) -> Array:
    """(R, C) whitened residuals of the fitted tests, zeros and what was written where they fit best."""
    it = found.residual
    out = np.zeros(it.values.shape)
    out[it.rows[:, 0], it.rows[:, 1]] = it.without_zeros(it.left)
    return out
