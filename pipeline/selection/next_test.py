"""The test that tells most rivals apart: where fitted models, refitted after it, would still differ.

With d the whitened difference of both predictions in the new test, J their derivatives there and H the information
on their numbers so far, chi-square between them grows by d^T (I - J (H + J^T J)^-1 J^T) d: what neither uncertainty
nor refitting explains. Of several rivals, the most pairs are to be parted.
Sources: G. Buzzi-Ferraris, P. Forzatti, Chem. Eng. Sci. 38 (1983) 225-232; A. C. Atkinson, V. V. Fedorov, Biometrika
62 (1975) 57-70 (T-optimality).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import Residual, residual, whitening
from pipeline.inference.rounding import SQUARED, TINY
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.possible_tests import Choice, menu

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NextTest:
    """A test, or two that tell only together, and the chi-square expected between each pair of models, by number."""

    choices: tuple[Choice, ...]
    parted: dict[tuple[int, int], float]

    @property
    def worth(self) -> float:
        """How many pairs are parted well, a poorly parted one counting for its share."""
        enough = CRITERIA.next_test
        return sum(min(value, enough) for value in self.parted.values()) / enough

    @property
    def apart(self) -> list[tuple[int, int]]:
        """Pairs of models that would be told apart."""
        return [pair for pair, value in self.parted.items() if value > CRITERIA.next_test / 2]


@dataclass(frozen=True, eq=False)
class _Foreseen:
    """What a fit predicts for the menu: readings and their derivatives, and what is known of its numbers."""

    found: Fit
    prediction: Prediction
    slopes: Residual
    information: Array


@dataclass(frozen=True, eq=False)
class _Share:
    """What a test adds between two models: d^T d, J^T d and J^T J, of J in typical sizes."""

    square: float
    pull: Array
    inner: Array

    def __add__(self, other: _Share) -> _Share:
        return _Share(self.square + other.square, self.pull + other.pull, self.inner + other.inner)


def best_next_test(fits: Sequence[Fit], whole: LoadCases) -> NextTest | None:
    """The best of the menu; two together where no single one parts all; None if nothing parts any."""
    choices = menu(whole.campaign)
    if not choices:
        return None
    cases = load_cases(replace(whole.campaign, tests=tuple(c.test for c in choices)))
    seen = [_foreseen(found, cases) for found in fits]
    pairs = [(k, n) for n in range(len(seen)) for k in range(n)]
    known = {pair: _known(*(seen[k] for k in pair)) for pair in pairs}
    shares: list[tuple[Choice, dict[tuple[int, int], _Share]]] = []
    for number, choice in enumerate(choices):
        rows = cases.test == number
        if not any(each.prediction.lost[rows].any() for each in seen):
            shares.append((choice, {p: _share(seen[p[0]], seen[p[1]], cases, rows) for p in pairs}))
    singles = [NextTest((c,), {p: _parted(own[p], known[p]) for p in pairs}) for c, own in shares]
    best = max(singles, key=lambda it: it.worth, default=None)
    if best is None or len(best.apart) == len(pairs):
        return best
    doubles = [
        NextTest((a, b), {p: _parted(mine[p] + own[p], known[p]) for p in pairs})
        for (a, mine), (b, own) in combinations(shares, 2)
    ]
    both = max(doubles, key=lambda it: it.worth, default=best)
    return both if len(both.apart) > len(best.apart) else best


def _foreseen(found: Fit, cases: LoadCases) -> _Foreseen:
    prediction = predict(found.model, cases)
    return _Foreseen(found, prediction, residual(cases, prediction), found.jacobian.T @ found.jacobian)


def _known(a: _Foreseen, b: _Foreseen) -> Array:
    """Information on the numbers of both, so far."""
    return block_diag(*(each.information * np.outer(s, s) for each in (a, b) for s in [_scale(each.found)]))


def _share(a: _Foreseen, b: _Foreseen, cases: LoadCases, rows: NDArray[np.bool_]) -> _Share:
    used = cases.predicted[rows]
    weights = whitening(cases, a.prediction)
    difference = np.where(cases.predicted, a.prediction.values - b.prediction.values, 0.0)
    d = weights.apply(difference)[rows][used]
    slopes = np.hstack([each.slopes.slopes[rows][used] * _scale(each.found) for each in (a, b)])
    return _Share(float(d @ d), slopes.T @ d, slopes.T @ slopes)


def _parted(share: _Share, known: Array) -> float:
    """Expected growth of chi-square between two models."""
    explained = 0.0
    if share.pull.size:
        inner = known + share.inner
        size = np.sqrt(np.maximum(np.diag(inner), TINY))
        step = np.linalg.lstsq(inner / np.outer(size, size), share.pull / size, rcond=SQUARED)[0]
        explained = float(share.pull / size @ step)
    return max(0.0, share.square - explained)


def _scale(found: Fit) -> Array:
    return np.array([abs(each.parameter.typical) for each in found.model.free])
