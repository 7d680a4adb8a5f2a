"""A Gaussian process of all inputs: squared exponential, one length for each input, and noise of one sigma.

C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press 2006, chapters 2 and 5.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

from pipeline.extrapolation.correction import Learned
from pipeline.extrapolation.regressors import Samples

Array = NDArray[np.float64]
RESTARTS, SEED = 8, 0
LENGTHS = (1.0, 1e3)
"""Spreads of an input, from a third of what a test goes through to no dependence at all."""
HEIGHTS = (1e-4, 1e3)
"""Variance of the process over that of the residuals."""
EXCESS = (1e-6, 1.0)
"""Variance that is neither the process nor known noise, over that of the residuals."""


def gaussian(own: Samples) -> Learned:
    """The mean of the process given the samples, its numbers at the best marginal likelihood of nine starts.

    Far from all samples it is their mean.
    """
    mean = float(own.values.mean())
    spread = float(own.values.std())
    if own.values.size < 2 or not own.inputs.shape[1] or spread == 0.0:
        return lambda inputs: np.full(len(inputs), mean)
    kernel = ConstantKernel(1.0, HEIGHTS) * RBF(np.ones(own.inputs.shape[1]), LENGTHS) + WhiteKernel(
        1e-2, EXCESS
    )
    process = GaussianProcessRegressor(
        kernel, alpha=spread**-2.0, n_restarts_optimizer=RESTARTS, random_state=SEED
    )
    with warnings.catch_warnings():
        # A number at its bound is an answer: an input that does not matter, a residual that is noise.
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(own.inputs, (own.values - mean) / spread)
    return lambda inputs: np.asarray(mean + spread * process.predict(inputs))
