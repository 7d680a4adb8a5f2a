"""Cross-validation over whole tests, to first order: fitted, and chosen, without the test that is predicted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.rounding import SQUARED, TINY
from pipeline.selection.cost import entry
from pipeline.selection.first_order import FirstOrder
from pipeline.selection.fit_cache import FitCache, Names

Array = NDArray[np.float64]


def crossvalidated(found: Fit) -> float:
    """Whitened RMS of tests predicted by a model whose numbers were fitted to the others."""
    whole = found.residual.load_cases
    tests = whole.test[found.residual.rows[:, 0]]
    return _left_out(found.jacobian, found.whitened, tests)


def crossvalidated_with(about: FirstOrder, name: str) -> float:
    """The same for a fit with one more effect, to first order."""
    columns = about.signatures[name].columns
    slopes = np.hstack([about.base, columns[len(columns) // 2]])
    return _left_out(slopes, about.residual, about.tests)


def _left_out(slopes: Array, residual: Array, tests: NDArray[np.int_]) -> float:
    """RMS over tests, each predicted with numbers (P,) that it had no part in; slopes (N, P) of the prediction."""
    if not slopes.shape[1]:
        return float(np.sqrt(np.mean(residual**2)))
    slopes = slopes / np.maximum(np.linalg.norm(slopes, axis=0), TINY)
    square, pull = slopes.T @ slopes, slopes.T @ residual
    total = 0.0
    for test in np.unique(tests):
        mine = tests == test
        inner = square - slopes[mine].T @ slopes[mine]
        step = np.linalg.lstsq(inner, pull - slopes[mine].T @ residual[mine], rcond=SQUARED)[0]
        total += float(np.sum((residual[mine] - slopes[mine] @ step) ** 2))
    return float(np.sqrt(total / residual.size))


def agreement(cache: FitCache, names: Names, name: str) -> float | None:
    """Part of the folds in which this effect would be chosen again, to first order; None where nothing was screened,
    and where to first order all tests together would not choose it: a fold says nothing of a choice then.

    In each fold one test is left out of everything: of the fit, of the screen and of the choice.
    """
    start = names - {name}
    if start not in cache.first_orders:
        return None
    about = cache.first_orders[start]
    tests = np.unique(about.tests)
    if tests.size < 2 or name not in about.signatures or _chosen(cache, about) != name:
        return None
    return float(np.mean([_chosen(cache, about.without(int(test))) == name for test in tests]))


def _chosen(cache: FitCache, about: FirstOrder) -> str:
    every: Sequence[str] = list(about.signatures)
    worth = [about.gain([n]).value - entry(cache, n) for n in every]
    return every[int(np.argmax(worth))]
