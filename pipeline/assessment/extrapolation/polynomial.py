"""A polynomial of all inputs, its degree and its damping by cross-validation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.linear_model import Ridge
from sklearn.model_selection import KFold
from sklearn.preprocessing import PolynomialFeatures

from pipeline.assessment.extrapolation.correction import Learned
from pipeline.discrepancy.regressors import Samples

Array = NDArray[np.float64]
DEGREES = (1, 2, 3)
DAMPINGS = (1e-6, 1e-2, 1.0, 1e2)
"""Ridge, in squared sigmas for a coefficient of one sigma: from none to as much as a hundred readings."""
FOLDS = 5


def polynomial(own: Samples) -> Learned:
    """A ridge regression; nothing but a constant where no polynomial predicts left-out rows better."""
    best, least = (0, 0.0), _left_out(np.zeros((own.values.size, 1)), own, 1.0)
    for degree in DEGREES if own.inputs.shape[1] else ():
        columns = PolynomialFeatures(degree, include_bias=False).fit_transform(own.inputs)
        for damping in DAMPINGS:
            error = _left_out(columns, own, damping)
            if error < least:
                best, least = (degree, damping), error
    return _fitted(own, *best)


def _fitted(own: Samples, degree: int, damping: float) -> Learned:
    mean = float(own.values.mean())
    if not degree:
        return lambda inputs: np.full(len(inputs), mean)
    powers = PolynomialFeatures(degree, include_bias=False).fit(own.inputs)
    ridge = Ridge(damping).fit(powers.transform(own.inputs), own.values)
    return lambda inputs: np.asarray(ridge.predict(powers.transform(inputs)))


def _left_out(columns: Array, own: Samples, damping: float) -> float:
    """Sum of squares, in sigmas, of rows that a fold leaves out."""
    count = own.values.size
    if count < 2:
        return 0.0
    total = 0.0
    for kept, left in KFold(min(FOLDS, count), shuffle=True, random_state=0).split(columns):
        ridge = Ridge(damping).fit(columns[kept], own.values[kept])
        total += float(np.sum((own.values[left] - ridge.predict(columns[left])) ** 2))
    return total
