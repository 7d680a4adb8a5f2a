"""Whether noise has long tails: Student's t against the normal law, and against a normal law with single bad readings.

Whitened residuals r of a fit that leaves no order are draws of one law. Student's t with nu degrees of freedom and
scale s is fitted by its likelihood, a normal law likewise, and a normal law with a part of the readings anywhere in
the range (J. Hampel et al., Robust Statistics, Wiley 1986, section 1.2c, the gross-error model). Long tails are there
where the t is far more likely than the normal law, and more than that with bad readings, which has as many numbers,
where each channel is counted in its own size: normal laws of several sizes together have long tails too. Of 150 and
more normal readings with two to six bad ones none of 800 draws passes both, of 60 three of 400; of Student's law of 3
degrees 72 of 100 with 330 readings, 30 with 150.

Least squares are then done on normal scores z = Phi^-1(T_nu(r / s)), standard normal where the law holds. A small
shift d of a reading moves its score by d / s_eff on average,

    1 / s_eff = E[dz/dr] = integral of t(r)² / phi(z(r)) dr,

so that a reading at its prediction plus s_eff z, of a sigma of s_eff, is one of normal noise (P. J. Huber, Robust
Statistics, Wiley 1981, section 7.8: pseudo-values).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import minimize
from scipy.stats import norm, t

from pipeline.campaign import Campaign
from pipeline.campaign.control import control_channels
from pipeline.inference.fit import Fit
from pipeline.inference.noise import MEDIAN
from pipeline.inference.residual import whitening
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import STUDENTS_LAW
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Tails:
    """Student's law of whitened residuals. degrees: of freedom. scale: in declared sigmas. growth: of twice the log
    likelihood over the normal law."""

    degrees: float
    scale: float
    growth: float

    def scores(self, residual: Array) -> Array:
        """Normal scores of residuals."""
        # By the nearer tail: one minus a small number would round it away.
        tail = t.sf(np.abs(residual) / self.scale, self.degrees)
        return np.asarray(
            np.clip(np.sign(residual) * norm.isf(tail), -STUDENTS_LAW.farthest, STUDENTS_LAW.farthest)
        )

    @cached_property
    def effective(self) -> float:
        """Standard deviation, in declared sigmas, of normal noise that says as much."""

        def integrand(z: float) -> float:
            # dr t(r)² / phi(z) = dz t(r(z)).
            return float(t.pdf(t.ppf(norm.cdf(z), self.degrees), self.degrees))

        return self.scale / quad(integrand, -STUDENTS_LAW.farthest, STUDENTS_LAW.farthest)[0]


def tails_of(found: Fit, criteria: Criteria) -> Tails | None:
    """Long tails of what a fit leaves, none where there are no more than noise has."""
    residual = _left(found)
    if residual.size < criteria.few_readings or not np.any(residual):
        return None
    (log_degrees, log_scale), student = _student(residual)
    growth = 2.0 * (student - _normal(residual))
    if growth < criteria.tails or _beyond(_evened(found)) < 0.0:
        return None
    return Tails(float(np.exp(log_degrees)), float(np.exp(log_scale)), growth)


def _left(found: Fit) -> Array:
    """Whitened residuals of all that is compared."""
    return np.asarray(found.residual.left[_used(found)])


def _used(found: Fit) -> NDArray[np.bool_]:
    """(R, C) of which readings."""
    used = found.residual.load_cases.predicted & found.residual.load_cases.fitted[:, None]
    return np.asarray(used & ~found.prediction.lost[:, None])


def _evened(found: Fit) -> Array:
    """The same, those of each channel in units of their own root mean square without what is far out; as they are where
    most are none."""
    used, out = _used(found), found.residual.left.copy()
    for channel in np.flatnonzero(used.any(axis=0)):
        own = out[used[:, channel], channel]
        ends = STUDENTS_LAW.cut * np.median(np.abs(own)) / MEDIAN
        out[:, channel] /= np.sqrt(np.mean(np.clip(own, -ends, ends) ** 2)) or 1.0
    return np.asarray(out[used])


def _normal(residual: Array) -> float:
    """Log likelihood of the normal law of zero mean."""
    return float(norm.logpdf(residual, scale=np.sqrt(np.mean(residual**2))).sum())


def _beyond(residual: Array) -> float:
    """Twice the log likelihood of Student's law over that of a normal law with single bad readings."""
    largest = float(np.abs(residual).max())
    return 2.0 * (_student(residual)[1] - _with_bad_readings(residual, largest))


def _student(residual: Array) -> tuple[Array, float]:
    """Logarithms of degrees and scale of the largest likelihood, and that."""

    def negative(at: Array) -> float:
        degrees, scale = np.exp(at)
        return -float(t.logpdf(residual, degrees, scale=scale).sum())

    spread, sizes = _sizes(residual)
    ends = [tuple(np.log(STUDENTS_LAW.degrees)), sizes]
    it = minimize(
        negative, np.array([np.log(STUDENTS_LAW.first), np.log(spread)]), bounds=ends, method="L-BFGS-B"
    )
    return np.asarray(it.x), -float(it.fun)


def _with_bad_readings(residual: Array, largest: float) -> float:
    """Log likelihood of a normal law of which a part is anywhere in the range."""

    def negative(at: Array) -> float:
        part = 1.0 / (1.0 + np.exp(-at[0]))
        density = (1.0 - part) * norm.pdf(residual, scale=np.exp(at[1])) + part / (2.0 * largest)
        return -float(np.log(np.maximum(density, TINY)).sum())

    spread, sizes = _sizes(residual)
    start = np.array([STUDENTS_LAW.bad, np.clip(np.log(spread / MEDIAN), *sizes)])
    return -float(minimize(negative, start, bounds=[(None, None), sizes], method="Nelder-Mead").fun)


def _sizes(residual: Array) -> tuple[float, tuple[float, float]]:
    """A typical size of residuals, and the logarithms between which a scale of them lies: theirs."""
    size = np.abs(residual)
    spread = float(np.median(size) or np.sqrt(np.mean(size**2)))
    return spread, (float(np.log(size[size > 0.0].min())), float(np.log(size.max())))


def without_tails(found: Fit, tails: Tails) -> Campaign:
    """The campaign of a fit with normal scores in the place of what is left, and the sigmas of as much information;
    what was prescribed stays as it was read."""
    it = found.residual
    whole = it.load_cases
    used = whole.predicted & ~found.prediction.lost[:, None]
    factors = whitening(whole, found.prediction).factors
    less = np.where(used, it.left - tails.effective * tails.scores(it.left), 0.0)
    # Back from whitened residuals to readings.
    readings = whole.measured - np.where(used, np.linalg.solve(factors, less[..., None])[..., 0], 0.0)
    campaign, noise = whole.campaign, whole.campaign.noise
    tests = []
    for k, test in enumerate(campaign.tests):
        own = readings[whole.first[k] : whole.first[k + 1]]
        data = test.data
        given = control_channels(test, campaign.gauges)
        as_read = np.hstack([data.displacement, data.wrench, data.gauges])
        own = np.where(np.isin(np.arange(own.shape[1]), given), as_read, own)
        data = replace(data, displacement=own[:, :6], wrench=own[:, 6:12], gauges=own[:, 12:])
        tests.append(replace(test, data=data))
    size = tails.effective
    wider = replace(
        noise,
        displacement=noise.displacement * size,
        wrench=noise.wrench * size,
        gauges=noise.gauges * size,
    )
    return replace(campaign, tests=tuple(tests), noise=wider)
