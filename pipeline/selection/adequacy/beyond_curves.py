"""How much each sensor scatters beyond any smooth curve along a load path, where a model leaves more than noise.

A misfit is smooth along a test, noise is not. Of every six or so steps in a row, combinations w of unit length are
taken that vanish for a parabola in the number of the step. They leave of a row's residual vector, and of the errors v
of its readings that vary little from row to row,

    d = sum over steps i of w_i r_i ~ N(0, sum over sensors s of  lambda_s² v_s v_s^T),  v_s = sum of w_i² v_si,

so that the factors are found as those of `scatter` are. A misfit that is not so smooth, a kink or a jump leaves its
trace in some tests or in the smoothest combination. So sensors count as scattering more than declared only where thirds
of the tests, and the smoothest combinations and the others, say the same of each of them. What scatters less needs no
such proof, for nothing makes a scatter smaller.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.inference.fit import Fit
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.adequacy.scatter import Mixed, Scatter, residuals
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]
WINDOW = 6
"""Steps whose combinations are taken, where a run of them can be parted so."""
CURVE = 3
"""Numbers of the smooth curve: a parabola."""
GROUPS = 3
"""Groups of tests that have to say the same."""


def scatters_beyond_curves(found: Fit, criteria: Criteria) -> tuple[Scatter, ...]:
    """Sensors of the fitted tests whose scatter is another one than declared whatever the model leaves."""
    it = _combined(found)
    if it is None:
        return ()
    halves = [it.smoothest, ~it.smoothest]
    thirds = [it.test % GROUPS == k for k in range(GROUPS)]
    parts = [[it.mixed.some(rows).scatters for rows in split if rows.any()] for split in (halves, thirds)]
    other = [
        (each, all(_alike([part[k] for part in split], criteria) for split in parts))
        for k, each in enumerate(it.mixed.scatters)
        if each.differs(criteria, unexplained=True)
    ]
    smooth = all(alike for each, alike in other if each.factor > 1.0)
    return tuple(each for each, _ in other if each.factor < 1.0 or smooth)


def _alike(parts: Sequence[Scatter], criteria: Criteria) -> bool:
    """Whether a sensor scatters as much in all parts."""
    logs = np.log([each.factor for each in parts])
    weight = np.array([each.error for each in parts]) ** -2.0
    spread = float(np.sum(weight * (logs - np.sum(weight * logs) / np.sum(weight)) ** 2))
    return bool(chi2.sf(spread, max(len(parts) - 1, 1)) >= criteria.check_level)


@dataclass(frozen=True, eq=False)
class _Combined:
    """mixed: a row for each combination of steps. smoothest: (K,) which is the smoothest of its steps. test: (K,)"""

    mixed: Mixed
    smoothest: NDArray[np.bool_]
    test: NDArray[np.int64]


def _combined(found: Fit) -> _Combined | None:
    of, left = ReadingErrors.of(found), residuals(found)
    tests = found.residual.load_cases.test
    every = list(_windows(of.there, tests))
    if not every:
        return None
    combinations = [_blind(rows.size) for rows in every]
    pairs = list(zip(every, combinations, strict=True))
    one = [np.repeat(rows[:1], len(w)) for rows, w in pairs]
    first = np.concatenate(one)
    mixed = Mixed.of(
        np.concatenate([w @ left[rows] for rows, w in pairs]),
        np.concatenate([np.einsum("kr,rcm->kcm", w**2, of.columns[rows]) for rows, w in pairs]),
        of.channels[first],
        of.there[first],
    )
    smoothest = np.concatenate([np.arange(len(w)) == 0 for w in combinations])
    return _Combined(mixed, smoothest, tests[first])


def _windows(there: NDArray[np.bool_], tests: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    """Steps in a row of one test that are read by the same sensors."""
    for test in np.unique(tests):
        rows = np.flatnonzero((tests == test) & there.any(axis=1))
        other = np.any(there[rows[1:]] != there[rows[:-1]], axis=1)
        for run in np.split(rows, np.flatnonzero(other) + 1):
            if run.size > CURVE:
                yield from np.array_split(run, max(1, min(run.size // (CURVE + 1), round(run.size / WINDOW))))


def _blind(count: int) -> Array:
    """(count - 3, count) combinations of steps that leave nothing of a parabola, the smoothest first."""
    powers = np.vander(np.linspace(-1.0, 1.0, count), increasing=True)
    return np.asarray(np.linalg.qr(powers)[0][:, CURVE:].T)
