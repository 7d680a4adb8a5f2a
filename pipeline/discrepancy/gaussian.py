"""A Gaussian process of all inputs: squared exponential, one length for each input, and noise of one sigma.

C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press 2006, chapters 2 and 5.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.discrepancy.regressors import Samples

Array = NDArray[np.float64]
RESTARTS, SEED = 8, 0
LENGTHS = (1.0, 1e3)
"""Spreads of an input, from a third of what a test goes through to no dependence at all."""
HEIGHTS = (1e-4, 1e3)
"""Variance of the process over that of the residuals."""
EXCESS = (1e-6, 1.0)
"""Variance that is neither the process nor known noise, over that of the residuals."""


@dataclass(frozen=True, eq=False)
class Process:
    """One that was learned. lengths: (m,) over which it varies, in spreads of each input."""

    lengths: Array
    kernel: object
    mean: float
    spread: float
    predict: Callable[[Array], Array]

    def given(self, own: Samples) -> Callable[[Array], Array]:
        """Prediction (n,) at scaled inputs (n, m) from other samples, with the numbers that were learned here."""
        from sklearn.gaussian_process import GaussianProcessRegressor

        process = GaussianProcessRegressor(self.kernel, alpha=self.spread**-2.0, optimizer=None)
        process.fit(own.inputs, (own.values - self.mean) / self.spread)
        return lambda inputs: np.asarray(self.mean + self.spread * process.predict(inputs))


def learned(own: Samples, restarts: int = RESTARTS) -> Process | None:
    """The process at the best marginal likelihood of several starts; None where there is nothing to learn.

    Far from all samples it is their mean.
    """
    mean, spread = float(own.values.mean()), float(own.values.std())
    if own.values.size < 2 or not own.inputs.shape[1] or spread == 0.0:
        return None
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    lengths = RBF(np.ones(own.inputs.shape[1]), LENGTHS)
    kernel = ConstantKernel(1.0, HEIGHTS) * lengths + WhiteKernel(1e-2, EXCESS)
    process = GaussianProcessRegressor(
        kernel, alpha=spread**-2.0, n_restarts_optimizer=restarts, random_state=SEED
    )
    with warnings.catch_warnings():
        # A number at its bound is an answer: an input that does not matter, a residual that is noise.
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(own.inputs, (own.values - mean) / spread)
    found = np.atleast_1d(process.kernel_.k1.k2.length_scale)
    return Process(
        np.asarray(found, dtype=float),
        process.kernel_,
        mean,
        spread,
        lambda inputs: np.asarray(mean + spread * process.predict(inputs)),
    )


def gaussian(own: Samples) -> Callable[[Array], Array]:
    """The mean (n,) of the process at scaled inputs (n, m), given the samples."""
    process = learned(own)
    mean = float(own.values.mean())
    return (lambda inputs: np.full(len(inputs), mean)) if process is None else process.predict
