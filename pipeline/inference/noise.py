"""Whether a whitened residual is noise: its size (chi-square) and its order (lag-1 correlation along the load path)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.linalg import block_diag
from scipy.stats import chi2, norm

from pipeline.inference.settings import IMHOF

Array = NDArray[np.float64]
MEDIAN = float(norm.isf(0.5 / 2.0))
"""Median magnitude of noise, in sigmas."""


@dataclass(frozen=True)
class Check:
    """A test of "this is noise". p_value: how often noise gives this statistic or a larger one.

    chi-square: statistic is the sum of squares, degrees its degrees of freedom. lag-1: statistic is the
    correlation of neighbours, degrees the number of residuals less that of fitted parameters.
    """

    statistic: float
    degrees: int
    p_value: float


def chi_square(residual: Array, parameters: int = 0) -> Check:
    """Size of the whitened residual (N,) against its sigmas, after `parameters` were fitted to it.

    Small p: the residual is larger than noise; p near 1: the sigmas are too large. ValueError if no degree of
    freedom is left, or for values that are not finite.
    """
    degrees = residual.size - parameters
    _finite(residual)
    if degrees < 1:
        raise ValueError(f"{residual.size} residuals and {parameters} parameters leave no degree of freedom")
    total = float(residual @ residual)
    return Check(total, degrees, float(chi2.sf(total, degrees)))


def lag_one(series: Sequence[Array], fitted: Array | None = None) -> Check:
    """Correlation of neighbours along the load paths, over all tests and channels together.

    series: one whitened residual (n,) a test and channel, in the order of the steps. fitted: (N, p) whitened
    derivative of all predictions by the p parameters that were fitted, rows in the order of the series; a fit
    takes some correlation away, and the null distribution knows. With A = half of both side diagonals, one block
    a series, the statistic is c = r'Ar / r'r, free of the scale of the sigmas, and for normal noise

        P(c or more) = P(sum of (a_i - c) z_i² > 0)

    with a_i the eigenvalues of A in the space that the fit leaves: exact for any N, by Imhof's integral.
    One-sided: what a model lacks makes neighbours alike. ValueError if fewer than three degrees are left, if
    the residual is zero, or for values that are not finite.
    Sources: J. P. Imhof, Biometrika 48 (1961) 419-426; J. Durbin, G. S. Watson, Biometrika 37 (1950) 409-428.
    """
    residual = np.concatenate([np.asarray(r, dtype=float) for r in series]) if series else np.zeros(0)
    degrees = residual.size - (0 if fitted is None else int(np.linalg.matrix_rank(fitted)))
    if degrees < 3:
        raise ValueError(f"{degrees} degrees of freedom are left, allowed are 3 or more")
    _finite(residual)
    largest = float(np.abs(residual).max())
    if largest == 0.0:
        raise ValueError("the residual is zero")
    # The squares of what is nearly met may be below the smallest float.
    scaled = [np.asarray(r, dtype=float) / largest for r in series]
    squares = float(np.sum((residual / largest) ** 2))
    statistic = sum(float(r[1:] @ r[:-1]) for r in scaled) / squares
    values = _eigenvalues([len(r) for r in series], fitted)
    return Check(statistic, degrees, positive_form(values - statistic))


def _finite(residual: Array) -> None:
    """ValueError for a residual that is not known everywhere: leave out what was not measured."""
    if not np.isfinite(residual).all():
        raise ValueError("the residual has values that are not finite")


def _eigenvalues(lengths: Sequence[int], fitted: Array | None) -> Array:
    """Those of A, in the space orthogonal to the columns of `fitted`."""
    if fitted is None:
        # Closed form of a tridiagonal matrix with zeros on the diagonal and halves beside it.
        return np.concatenate([np.cos(np.pi * np.arange(1, n + 1) / (n + 1)) for n in lengths])
    a = block_diag(*[0.5 * (np.eye(n, k=1) + np.eye(n, k=-1)) for n in lengths])
    left, sizes, _ = np.linalg.svd(fitted, full_matrices=True)
    rank = int(np.sum(sizes > max(fitted.shape) * np.finfo(float).eps * sizes.max(initial=0.0)))
    rest = left[:, rank:]
    return np.asarray(np.linalg.eigvalsh(rest.T @ a @ rest), dtype=float)


def positive_form(weights: Array) -> float:
    """P(sum of w_i z_i² > 0), weights (n,), for independent standard normal z_i (Imhof 1961, eq. 3.2), to about
    1e-8."""
    if np.all(weights >= 0.0) or np.all(weights <= 0.0):
        return float(np.any(weights > 0.0))
    w = weights / np.linalg.norm(weights)

    def integrand(u: float) -> float:
        # sin(theta) / (u rho), with rho as a logarithm: its product overflows.
        theta = 0.5 * float(np.sum(np.arctan(w * u)))
        fall = 0.25 * float(np.sum(np.log1p((w * u) ** 2)))
        return float(np.sin(theta) * np.exp(-fall) / u)

    # Over the logarithm of u: the tail of few weights falls slowly, that of many within u of one.
    value = quad(
        lambda t: integrand(np.exp(t)) * np.exp(t),
        IMHOF.low,
        IMHOF.high,
        limit=IMHOF.pieces,
        epsabs=IMHOF.error,
    )[0]
    return float(np.clip(0.5 + value / np.pi, 0.0, 1.0))
