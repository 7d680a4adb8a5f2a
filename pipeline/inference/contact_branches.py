"""Which side of its stops each row is on, of a model with kinks such as the stop of a play.

The response is a line on either side of a kink, and the inputs that fit a row best may lie beyond it: within a play of
± 10 µm a force of half a newton decides the position, and it is read with a noise of one. Each row is on the side on
which its least chi-square is lowest, with the inputs held to that side (`pipeline.inference.stops`). Two places begin:
the measured inputs and, as what was prescribed as force is better looked for from the displacement that was measured
with it, where the platform was. A row that a stop charges is tried beyond that stop: its sum of squares is continuous
there, so it falls, until no stop is worth crossing. One that fits badly may belong to a stop that is not next to it,
where a displacement that was prescribed is read with a noise as large as the play: it is tried beyond each that is
near.

Where laws remember, each row chooses its side with the memory that the history has brought to it; the history is then
solved once more, at the inputs that were chosen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import Residual, residual
from pipeline.inference.settings import CROSSINGS
from pipeline.inference.stops import Bounds, sided
from pipeline.inference.subsets import ARRAYS, states_at, states_with
from vjm.mechanism import initial_memory

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Trial:
    """Rows (N,), in the order of the campaign, that are tried at other inputs, shifted by (N, 7) from the measured
    ones."""

    rows: NDArray[np.int64]
    shift: Array


def on_best_sides(model: Model, cases: LoadCases, start: Prediction | None = None) -> Prediction:
    """Readings of a model with kinks, each row on the side of its stops that leaves the least chi-square; without
    derivatives by the free parameters.

    Where it begins the readings say, never the start: from whose states equilibria are only found sooner.
    """
    # A row chooses its side where the model is, not along a line from there.
    cases, held = cases.plain, remembering(model)
    if held:
        start = predict(model, cases, slopes=False, start=start, order=0)
    every = np.ones(len(cases.test), dtype=bool)
    here, going = _crossed(model, cases, _reached(model, cases, start, held), every)
    tried = _beyond_near_stops(model, cases, here)
    # A row that stayed would stay again, but for what its zero follows.
    going |= np.any(tried.shift != here.shift, axis=1) | _follows_others(cases)
    here, _ = _crossed(model, cases, tried, going)
    return predict(model, cases, slopes=False, start=here, shift=here.shift) if held else here


def _crossed(model: Model, cases: LoadCases, here: Prediction, going: Mask) -> tuple[Prediction, Mask]:
    """Rows that a stop charges on its other side where that is better, from there on too; of those that are `going`
    (R,), and those that still were at the end."""
    for _ in range(CROSSINGS.most):
        left = residual(cases, here)
        rows = _whole(cases, (left.charge > CROSSINGS.worth) & going)
        if not rows.size:
            break
        there = _better(model, cases, here, [Trial(rows, left.across[rows])], here, left)
        here, going = there, np.any(there.shift != here.shift, axis=1)
    return here, going


def _beyond_near_stops(model: Model, cases: LoadCases, here: Prediction) -> Prediction:
    """Rows that fit badly on the other side of the near stop beyond which they fit best, if that is better."""
    left = residual(cases, here)
    # Each from here: once taken to the wrong one of two stops, a row has no way to the other.
    return _better(model, cases, here, list(_misplaced(cases, here, left)), here, left)


def _misplaced(cases: LoadCases, here: Prediction, left: Residual) -> Iterator[Trial]:
    """For each stop rows that fit badly and are near it, with the inputs just beyond it; none where half of all rows
    fit badly: there the model is wrong, not a side missed."""
    bounds, sigma = Bounds.of(here, cases.input_sigma), cases.input_sigma
    bad = _squares(left) > chi2.isf(CROSSINGS.badly, np.maximum(cases.predicted.sum(axis=1), 1))
    if np.mean(bad) < CROSSINGS.rows:
        for number in range(bounds.room.shape[1]):
            way, far = bounds.beyond(number)
            rows = _whole(cases, bad & (far < CROSSINGS.within))
            yield Trial(rows, (here.shift + sigma * way)[rows])


def _follows_others(cases: LoadCases) -> Mask:
    """(R,) rows of tests with an unknown zero: what that is, and so what a row leaves, all rows of the test say."""
    return np.asarray(np.any(cases.loose, axis=1))[cases.test]


def _reached(model: Model, cases: LoadCases, start: Prediction | None, held: bool) -> Prediction:
    """At the measured inputs or, where that is better, where the platform was: there with the forces that take it."""
    swapped = cases.by_displacement
    if swapped is None:
        return predict(model, cases, slopes=False, start=start, held=held)
    # Which stops are pressed where the platform was, a row that is lost there does not say on any branch.
    there = predict(model, swapped, slopes=False, start=start, order=0, held=held, bent=False)
    here = predict(model, cases, slopes=False, start=there, held=held)
    rows = _whole(cases, _elsewhere(there, here) & ~there.lost)
    if not rows.size:
        return here
    trial = Trial(rows, _shift_to(there, swapped, cases)[rows])
    return _better(model, cases, here, [trial], there, residual(cases, here))


def _better(
    model: Model,
    cases: LoadCases,
    here: Prediction,
    trials: Sequence[Trial],
    start: Prediction,
    left: Residual,
) -> Prediction:
    """The prediction with those of its rows replaced that fit better in a trial, by the best of theirs; left: its
    residual, start: where all begin. A test that was zeroed at its first row is replaced as one."""
    trials = [trial for trial in trials if trial.rows.size]
    if not trials:
        return here
    rows, shift = (np.concatenate(parts) for parts in zip(*((t.rows, t.shift) for t in trials), strict=True))
    part = cases.only(*(trial.rows for trial in trials))
    begin = replace(start, states=states_at(start, cases, part, rows))
    other = predict(model, part, slopes=False, start=begin, shift=shift, held=remembering(model))
    unit = _units(cases)
    least, best = np.bincount(unit, _squares(left), len(unit)), np.full(len(unit), -1)
    ends = np.cumsum([trial.rows.size for trial in trials]).tolist()
    for number, (trial, end) in enumerate(zip(trials, ends, strict=True)):
        # Each by itself: unknown zeros are one column for every test and sensor.
        own = _rows_of(other, slice(end - trial.rows.size, end))
        squares = _squares(residual(cases.only(trial.rows), own))
        total = np.bincount(unit[trial.rows], squares, len(unit))
        better = np.isin(np.arange(len(unit)), unit[trial.rows]) & (total < least)
        least[better], best[better] = total[better], number
    taken = best[unit[rows]] == np.repeat(np.arange(len(trials)), [trial.rows.size for trial in trials])
    states = states_with(here, cases, part, rows, other, taken)
    return replace(_merged(here, other, rows, taken), states=states)


def _units(cases: LoadCases) -> NDArray[np.int64]:
    """(R,) the row by which each is replaced: its own, or the first of a test of which all readings are less those."""
    whole = np.array([test.zero == "first_row" for test in cases.campaign.tests])[cases.test]
    return np.where(whole, cases.first[cases.test], np.arange(len(cases.test)))


def _rows_of(found: Prediction, rows: slice) -> Prediction:
    """Some rows of a prediction, without its states."""
    return replace(found, states=(), reasons={}, **{name: getattr(found, name)[rows] for name in ARRAYS})


def kinked(model: Model) -> bool:
    """Whether the response has kinks of which each row chooses the side, as stops of plays; where friction or yielding
    turn back is no choice of a row."""
    return any(sided(term.effect) for term in model.terms)


def begun(model: Model, cases: LoadCases, start: Prediction | None) -> Array | None:
    """Shift (R, 7) at which a fit from a start is first linearised: that of the start, none where laws begin to
    remember. There the inputs of the start have taken up what the laws will explain, such as a loop, each a little, and
    what is remembered follows them: the fit would end near them.
    """
    if start is None:
        return None
    if remembering(model):
        own = [model.mechanism(group, cases.campaign.gauges) for group in cases.groups]
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


def _whole(cases: LoadCases, chosen: Mask) -> NDArray[np.int64]:
    """Numbers of the chosen rows; of a test that was zeroed at its first row all, or none."""
    chosen = chosen.copy()
    for number, test in enumerate(cases.campaign.tests):
        rows = cases.test == number
        if test.zero == "first_row":
            chosen[rows] = chosen[rows].any()
    return np.flatnonzero(chosen)


def _shift_to(reached: Prediction, swapped: LoadCases, cases: LoadCases) -> Array:
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
