"""The test that tells rivals apart best: where two fitted models, refitted after it, would still differ most.

With d the whitened difference of both predictions in the new test, J their derivatives there and H the information
on their numbers so far, chi-square between them grows by d^T (I - J (H + J^T J)^-1 J^T) d: what neither uncertainty
nor refitting explains. Of several rivals the least counts.
Sources: G. Buzzi-Ferraris, P. Forzatti, Chem. Eng. Sci. 38 (1983) 225-232; A. C. Atkinson, V. V. Fedorov, Biometrika
62 (1975) 57-70 (T-optimality).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.diagnose.menu import Choice, menu
from pipeline.inference.fit import Fit
from pipeline.inference.prediction import Prediction, predict
from pipeline.inference.program import Program, program
from pipeline.inference.residual import Residual, residual, whitening

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NextTest:
    """A test and the chi-square by which it is expected to part the two rivals that it parts least."""

    choice: Choice
    chi_square: float


@dataclass(frozen=True, eq=False)
class _Foreseen:
    """What a fit predicts for the menu: readings and their derivatives, and what is known of its numbers."""

    found: Fit
    prediction: Prediction
    slopes: Residual
    information: Array


def best_next_test(fits: Sequence[Fit], whole: Program) -> NextTest | None:
    """The best of the menu; None if no test can be done that parts them at all."""
    choices = menu(whole.campaign)
    cases = program(replace(whole.campaign, tests=tuple(c.test for c in choices)))
    seen = [_foreseen(found, cases) for found in fits]
    best = None
    for number, choice in enumerate(choices):
        rows = cases.test == number
        if any(each.prediction.lost[rows].any() for each in seen):
            continue
        least = min(parted(a, b, cases, rows) for k, a in enumerate(seen) for b in seen[:k])
        if best is None or least > best.chi_square:
            best = NextTest(choice, least)
    return best


def _foreseen(found: Fit, cases: Program) -> _Foreseen:
    prediction = predict(found.model, cases)
    return _Foreseen(found, prediction, residual(cases, prediction), found.jacobian.T @ found.jacobian)


def parted(a: _Foreseen, b: _Foreseen, cases: Program, rows: NDArray[np.bool_]) -> float:
    """Expected growth of chi-square between two fits in some rows."""
    used = cases.predicted[rows]
    weights = whitening(cases, a.prediction)
    difference = np.where(cases.predicted, a.prediction.values - b.prediction.values, 0.0)
    d = weights.apply(difference)[rows][used]
    slopes = np.hstack([each.slopes.slopes[rows][used] for each in (a, b)])
    scale = np.concatenate([_scale(each.found) for each in (a, b)])
    known = np.zeros((scale.size, scale.size))
    first = len(a.found.model.free)
    known[:first, :first], known[first:, first:] = a.information, b.information
    slopes, known = slopes * scale, known * np.outer(scale, scale)
    pull = slopes.T @ d
    inner = known + slopes.T @ slopes
    explained = pull @ np.linalg.lstsq(inner, pull, rcond=1e-12)[0] if pull.size else 0.0
    return max(0.0, float(d @ d - explained))


def _scale(found: Fit) -> Array:
    return np.array([abs(each.parameter.typical) for each in found.model.free])
