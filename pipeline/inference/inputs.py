"""Near which inputs a model is linearised: the measured ones, those of the last step, or on the far side of a kink.

With a kink, such as the stop of a play, the inputs that fit a row best may lie beyond it, where the slope at the
measured ones does not point: within a play of ± 10 µm a force of half a newton decides the position, and it is read
with a noise of one. What a row prescribed as force is then better looked for from the displacement that was measured
with it: solved with displacements prescribed, the model says which forces it takes to be where the platform was.
Rows that fit badly are tried from there as well, and keep what leaves the lesser sum of squares.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.inference.model import Model
from pipeline.inference.parts import ARRAYS, states_at
from pipeline.inference.prediction import Prediction, predict
from pipeline.inference.program import Program
from pipeline.inference.residual import Residual, residual

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
BADLY = 1e-3
"""A row fits badly if noise gives its sum of squares less often. Others are left where they are: the better of two
sides takes up noise in every row, and with it a play of a third of a micrometre is found where there is none."""


def linearised(
    model: Model,
    cases: Program,
    slopes: bool = True,
    start: Prediction | None = None,
    shift: Array | None = None,
) -> tuple[Prediction, Residual]:
    """Prediction and residual, arguments as of `predict`; of a model with kinks each row on its better side."""
    swapped = cases.by_displacement if kinked(model) else None
    if swapped is None:
        here = predict(model, cases, slopes, start=start, shift=shift)
        return here, residual(cases, here)
    reached = predict(model, swapped, slopes=False, start=start)
    here = predict(model, cases, slopes, start=reached, shift=shift)
    left = residual(cases, here)
    rows = np.flatnonzero(_badly(cases, left))
    if not rows.size:
        return here, left
    part = cases.only(rows)
    begin = replace(reached, states=states_at(reached, cases, part, rows))
    other = predict(model, part, slopes, start=begin, shift=_shift_to(reached, swapped, cases)[rows])
    better = _squares(residual(part, other)) < _squares(left)[rows]
    merged = _merged(here, other, rows, better)
    return merged, residual(cases, merged)


def kinked(model: Model) -> bool:
    """Whether the response has kinks that depend on the present inputs alone; along a history none is jumped."""
    effects = [term.effect for term in model.terms]
    return any(not e.smooth for e in effects) and not any(e.history for e in effects)


def _squares(left: Residual) -> Array:
    """(R,) sum of squares of each row."""
    return np.asarray(np.sum(left.values**2, axis=1))


def _badly(cases: Program, left: Residual) -> Mask:
    """(R,) rows that fit badly; of a test that was zeroed at its first row all, or none."""
    count = np.sum(cases.predicted, axis=1)
    badly = np.asarray(_squares(left) > chi2.isf(BADLY, np.maximum(count, 1)))
    for number, test in enumerate(cases.campaign.tests):
        rows = cases.test == number
        if test.zero == "first_row":
            badly[rows] = badly[rows].any()
    return badly


def _shift_to(reached: Prediction, swapped: Program, cases: Program) -> Array:
    """(R, 7) from the measured inputs to those at which the measured displacements are reached."""
    read = np.take_along_axis(reached.values, cases.channels, axis=1)
    given = np.take_along_axis(cases.measured, cases.channels, axis=1)
    differs = (cases.channels != swapped.channels) & ~reached.lost[:, None]
    shift = np.zeros_like(cases.input_sigma)
    shift[:, :6] = np.where(differs, read - given, 0.0)
    return shift


def _merged(here: Prediction, other: Prediction, rows: NDArray[np.int64], better: Mask) -> Prediction:
    """The prediction with those of its rows replaced that are better in another one of these rows."""
    place = rows[better]
    parts = {}
    for name in ARRAYS:
        array = getattr(here, name).copy()
        array[place] = getattr(other, name)[better]
        parts[name] = array
    reasons = {row: said for row, said in here.reasons.items() if parts["lost"][row]}
    reasons |= {int(rows[k]): said for k, said in other.reasons.items() if better[k]}
    return replace(here, reasons=reasons, **parts)
