"""Near which inputs a model is linearised: the measured ones, those of the last step, or on the far side of a kink.

With a kink, such as the stop of a play, the inputs that fit a row best may lie beyond it, where the slope at the
measured ones does not point: within a play of ± 10 µm a force of half a newton decides the position, and it is read
with a noise of one. What a row prescribed as force is then better looked for from the displacement that was measured
with it: solved with displacements prescribed, the model says which forces it takes to be where the platform was.
Rows that press other stops there are tried from there as well, those that are not sure of their side or charged for the
stop that they press (`pipeline.inference.residual`) from the measured inputs, and keep what leaves the lesser
chi-square: with only what the last step of a fit left to them they would stay on the sides of other numbers. A row that
fits badly with a slide inside its play may belong to one of its stops, where a displacement that was prescribed is read
with a noise as large as the play: it is tried from the nearest inputs at which the slide touches.

Where laws remember, each row chooses its side with the memory that the history has brought to it; the history is then
solved once more, at the inputs that were chosen.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.inference.model import Model
from pipeline.inference.parts import ARRAYS, states_at, states_with
from pipeline.inference.prediction import Prediction, predict
from pipeline.inference.program import Program
from pipeline.inference.residual import Residual, residual
from pipeline.inference.sides import sided
from vjm.mechanism import initial_memory

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
BADLY = 0.05
"""Chance that noise makes a row so bad that other sides are tried: sides tried for all rows would take up noise."""
MOST = 0.5
"""Part of the rows: a model that fits fewer has other faults than their sides."""
WITHIN = 4.0
"""Sigmas of the inputs within which a stop may have been touched."""
OVER = 0.01
"""Of half the play, by which the stop is passed, so that the slide is at it."""


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
    held = remembering(model)
    if held:
        start = predict(model, cases, slopes=False, start=start, shift=shift, order=0)
    # Which stops are pressed where the platform was, a row that is lost there does not say on any branch.
    reached = predict(model, swapped, slopes=False, start=start, order=0, held=held, bent=False)
    # Which side is better the readings say: what the numbers change is asked where that is settled.
    here = predict(model, cases, slopes=False, start=reached, shift=shift, held=held)
    for rows, other in (
        (_elsewhere(reached, here) & ~reached.lost, _shift_to(reached, swapped, cases)),
        (_unsure(residual(cases, here)) & np.any(here.shift, axis=1), np.zeros_like(cases.input_sigma)),
    ):
        here = _better(model, cases, here, _whole(cases, rows), other, reached)
    for play in range(here.slides.shape[1]):
        # Both stops are tried from inside: once taken to the wrong one, a row has no way to the other.
        for rows, other in [_touching(cases, here, play, side) for side in (1.0, -1.0)]:
            here = _better(model, cases, here, _whole(cases, rows), other, here)
    if slopes:
        return sloped(model, cases, here)
    if held:
        here = predict(model, cases, slopes=False, start=here, shift=here.shift)
    return here, residual(cases, here)


def sloped(model: Model, cases: Program, here: Prediction) -> tuple[Prediction, Residual]:
    """A prediction and its residual again, on the sides that its rows have chosen, with derivatives."""
    there = predict(model, cases, start=here, shift=here.shift)
    return there, residual(cases, there)


def _touching(cases: Program, here: Prediction, play: int, side: float) -> tuple[Mask, Array]:
    """(R,) rows that fit badly with this slide inside its play, and the shift (R, 7) to the nearest inputs, in their
    sigmas, at which it touches the stop on that side; none that are far, and none where half of all rows fit
    badly: there the model is wrong, not a stop missed."""
    strain, half, slope = here.slides[:, play, 0], here.slides[:, play, 1], here.slides[:, play, 2:]
    count = np.sum(cases.predicted, axis=1)
    bad = _squares(residual(cases, here)) > chi2.isf(BADLY, np.maximum(count, 1))
    inside = (np.abs(strain) < half) & np.isfinite(half) & ~here.lost
    rows = bad & inside & (np.mean(bad) < MOST)
    gap = np.where(rows, side * (1.0 + OVER) * half - strain, 0.0)
    moved = cases.input_sigma**2 * slope
    variance = np.sum(slope * moved, axis=1)
    rows &= (gap**2 < WITHIN**2 * variance) & (variance > 0.0)
    way = np.divide(gap, variance, out=np.zeros_like(gap), where=rows)
    return rows, here.shift + way[:, None] * moved


def _better(
    model: Model,
    cases: Program,
    here: Prediction,
    rows: NDArray[np.int64],
    shift: Array,
    start: Prediction,
) -> Prediction:
    """The prediction with those of these rows (N,) replaced that fit better with the inputs shifted like this."""
    if not rows.size:
        return here
    part = cases.only(rows)
    begin = replace(start, states=states_at(start, cases, part, rows))
    other = predict(model, part, slopes=False, start=begin, shift=shift[rows], held=remembering(model))
    better = _squares(residual(part, other)) < _squares(residual(cases, here))[rows]
    states = states_with(here, cases, part, rows, other, better)
    return replace(_merged(here, other, rows, better), states=states)


def kinked(model: Model) -> bool:
    """Whether the response has kinks of which each row chooses the side, as stops of plays; where friction or yielding
    turn back is no choice of a row."""
    return any(sided(term.effect) for term in model.terms)


def begun(model: Model, cases: Program, start: Prediction | None) -> Array | None:
    """Shift (R, 7) at which a fit from a start is first linearised: that of the start, none where laws begin to
    remember. There the inputs of the start have taken up what the laws will explain, such as a loop, each a little, and
    what is remembered follows them: the fit would end near them.
    """
    if start is None:
        return None
    if remembering(model):
        own = [model.mechanism(group.rig, cases.campaign.gauges) for group in cases.groups]
        pairs = zip(own, start.states, strict=True)
        if any(initial_memory(rig).size != state.memory.shape[-1] for rig, state in pairs):
            return None
    return start.shift


def remembering(model: Model) -> bool:
    """Whether a step depends on those before it."""
    return any(term.effect.history for term in model.terms)


def _squares(left: Residual) -> Array:
    """(R,) chi-square of each row."""
    return np.asarray(np.sum(left.values**2, axis=1) + left.charge)


def _elsewhere(one: Prediction, other: Prediction) -> Mask:
    """(R,) rows that press other stops."""
    return np.asarray(np.any(np.sign(one.stops[..., 0]) != np.sign(other.stops[..., 0]), axis=1))


def _unsure(left: Residual) -> Mask:
    """(R,) rows that may belong to another side of a play than the one they are on."""
    return np.asarray((left.charge > 0.0) | left.undecided)


def _whole(cases: Program, chosen: Mask) -> NDArray[np.int64]:
    """Numbers of the chosen rows; of a test that was zeroed at its first row all, or none."""
    chosen = chosen.copy()
    for number, test in enumerate(cases.campaign.tests):
        rows = cases.test == number
        if test.zero == "first_row":
            chosen[rows] = chosen[rows].any()
    return np.flatnonzero(chosen)


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
