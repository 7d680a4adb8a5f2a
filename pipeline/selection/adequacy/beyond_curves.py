"""How much each sensor scatters beyond any smooth curve along a load path, where a model leaves more than noise.

A misfit is smooth along a test, noise is not. Of every six or so steps in a row, combinations w of unit length are
taken that vanish for a parabola in the number of the step. They leave of a row's residual vector, and of the errors v
of its readings that vary little from row to row,

    d = sum over steps i of w_i r_i ~ N(0, sum over sensors s of  lambda_s² v_s v_s^T),  v_s = sum of w_i² v_si,

so that the factors are found as those of `scatter` are. A misfit that is not so smooth, a kink or a jump adds to a
scatter, in a campaign of few steps like noise that is larger than declared; nothing makes one smaller. So only sensors
that scatter less than declared are told of.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.adequacy.scatter import Mixed, Scatter, residuals
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]
WINDOW = 6
"""Steps whose combinations are taken, where a run of them can be parted so."""
CURVE = 3
"""Numbers of the smooth curve: a parabola."""


def scatters_beyond_curves(found: Fit, criteria: Criteria) -> tuple[Scatter, ...]:
    """Sensors of the fitted tests that scatter less than was declared, whatever the model leaves."""
    it = _combined(found)
    every = () if it is None else it.scatters
    return tuple(each for each in every if each.factor < 1.0 and each.differs(criteria, unexplained=True))


def _combined(found: Fit) -> Mixed | None:
    """A row for each combination of steps; None where there is none."""
    of, left = ReadingErrors.of(found), residuals(found)
    every = list(_windows(of.there, found.residual.load_cases.test))
    if not every:
        return None
    pairs = [(rows, _blind(rows.size)) for rows in every]
    first = np.concatenate([np.repeat(rows[:1], len(w)) for rows, w in pairs])
    return Mixed.of(
        np.concatenate([w @ left[rows] for rows, w in pairs]),
        np.concatenate([np.einsum("kr,rcm->kcm", w**2, of.columns[rows]) for rows, w in pairs]),
        of.channels[first],
        of.there[first],
    )


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
