"""What a fit leaves when faults of sensors may take up some of it: patterns chosen one after the other, all of them.

A gain, a drift or a cross-talk of each sensor, and each test's own zero, each the largest that is left (forward
selection): S. Weisberg, Applied Linear Regression, 4th ed., Wiley 2014, section 10.2.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.selection.adequacy.patterns import Shape, left_of, shapes
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]
NEW = 0.1
"""Part of a pattern that must be left when those that were chosen are taken out of it."""


def falls(found: Fit, criteria: Criteria, most: int) -> list[float]:
    """Chi-square that is left of the fitted tests with none, one, ... `most` patterns; shorter where no more differ."""
    every = [it.column / it.size for it in (*shapes(found, criteria), *_zeros(found))]
    left = float(found.whitened @ found.whitened)
    out = [left]
    if not every:
        return out
    columns, residual = np.stack(every, axis=1), found.whitened.copy()
    there = np.ones(columns.shape[1])
    for _ in range(most):
        sizes = np.linalg.norm(columns, axis=0)
        usable = (sizes > NEW) & (there > 0.0)
        if not usable.any():
            return out
        pull = np.where(usable, columns.T @ residual / np.where(usable, sizes, 1.0), 0.0)
        best = int(np.argmax(np.abs(pull)))
        unit = columns[:, best] / sizes[best]
        there[best] = 0.0
        residual = residual - unit * pull[best]
        columns = columns - np.outer(unit, unit @ columns)
        out.append(float(residual @ residual))
    return out


def _zeros(found: Fit) -> Iterator[Shape]:
    """A constant of each channel in each test."""
    whole = found.residual.load_cases
    tests = np.unique(whole.test[whole.fitted])
    errors = (whole.test[:, None] == tests).astype(float)
    errors[found.prediction.lost] = 0.0
    for channel in np.flatnonzero(np.isfinite(whole.measured).any(axis=0) & (whole.sigma > 0.0)):
        own = [f"has a zero of its own in {whole.campaign.tests[k].id}" for k in tests]
        yield from left_of(found, int(channel), own, errors)
