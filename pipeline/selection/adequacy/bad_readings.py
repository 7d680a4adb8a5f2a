"""Single bad readings: a display misread, a dial that was knocked. Each is off alone, and its neighbours are not.

A reading (y, or x of what was prescribed) that is off by d moves the whitened residual r of a fit by d times a column
c. What the fit can move taken out of the column, c', the mean shift is d = c'·r / c'·c', and

    t = c'·r / abs(c')

is standard normal where nothing is wrong (R. D. Cook, S. Weisberg, Residuals and Influence in Regression, Chapman and
Hall 1982, section 2.2.2). The largest t is looked at first, in units of the median of its sensor's (1.4826 MAD) where
that is more than was declared: the median of what they are once this shift is taken out. Beyond Bonferroni's bound over
all readings it is a bad one if its neighbours in the same channel are not off as well: a play or a step of a sensor
comes in runs; and if nothing else of its row is: a state that is another one moves several sensors. Its column joins
what the fit can move, and the next one is looked at, with those that were refused before. Those at the greatest
loads of test after test are none (`pipeline.selection.adequacy.greatest_loads`). Of few readings a law may show in one:
there a bad one has two readings of its channel on either side that are not off, and others at greater loads.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from pipeline.campaign import Campaign, Test
from pipeline.campaign.aside import without
from pipeline.campaign.names import channel_columns
from pipeline.inference.fit import Fit
from pipeline.inference.noise import MEDIAN
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.residual import Residual
from pipeline.selection.adequacy.greatest_loads import at_greatest_loads, of_a_law
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
FOR_NEITHER = 2.0 * float(np.log(2.0))
"""Twice the logarithm by which one explanation of a row has to be likelier than another."""
FEW_BESIDE = 2
"""Rows on either side that speak for a bad reading where there are few."""


@dataclass(frozen=True)
class BadReading:
    """One reading by the id of its test, its step and its column. sigmas: by how many of its own it is off. instead:
    columns of the same row of which one may be off in its place. line: of its file, None where it is not known."""

    test: str
    step: int
    column: str
    sigmas: float
    instead: tuple[str, ...] = ()
    line: int | None = field(default=None, compare=False)

    @property
    def cell(self) -> tuple[str, int, str]:
        """Where it stands."""
        return self.test, self.step, self.column


@dataclass(frozen=True, eq=False)
class _Shifts:
    """Mean shifts of all readings about a residual r (N,) that is free of a basis (N, k).

    seen: part of a column that must be left when what the fit can move is taken out.
    """

    it: Residual
    of: ReadingErrors
    residual: Array
    taken: Array
    seen: float

    @cached_property
    def lengths(self) -> Array:
        """(R, M) of the columns, what the fit can move taken out; infinite where there is no reading or nothing is
        left."""
        it, columns = self.it, self.of.columns
        sizes = np.sum(columns**2, axis=1)
        left = sizes - np.sum(self._inner(it.zeros) ** 2, axis=-1)
        if it.marginal is not None:
            share = it.marginal.sizes**2 / (1.0 + it.marginal.sizes**2)
            left -= np.sum(share * self._inner(it.marginal.left) ** 2, axis=-1)
        left -= np.sum(self._inner(it.weakened(self.taken)) ** 2, axis=-1)
        seen = self.of.there & (left / np.where(sizes > 0.0, sizes, 1.0) > self.seen**2)
        return np.where(seen, np.sqrt(np.where(seen, left, 1.0)), np.inf)

    @cached_property
    def scores(self) -> Array:
        """(R, M) t, zero where there is no reading or nothing of its column is left."""
        return np.asarray(self._inner(self.it.weakened(self.residual)[:, None])[..., 0] / self.lengths)

    def without(self, row: int, number: int) -> _Shifts:
        """The same with the shift of one reading taken out."""
        whole = np.zeros(self.of.columns.shape[:2])
        whole[row] = self.of.columns[row, :, number]
        column = self.it.free(whole)
        for _ in range(2):
            column = column - self.taken @ (self.taken.T @ column)
        column = column / np.linalg.norm(column)
        residual = self.residual - column * (column @ self.residual)
        return replace(self, residual=residual, taken=np.column_stack([self.taken, column]))

    def _inner(self, array: Array) -> Array:
        """(R, M, k) products of every reading's column with those of an array (N, k)."""
        whole = np.zeros((*self.of.columns.shape[:2], array.shape[1]))
        whole[self.it.rows[:, 0], self.it.rows[:, 1]] = array
        return np.einsum("rcm,rck->rmk", self.of.columns, whole)


def bad_readings(found: Fit, criteria: Criteria) -> tuple[BadReading, ...]:
    """The single bad readings of the fitted tests, the worst first; none of those that are kept by hand."""
    it, taken = found.residual, basis(found.jacobian)
    residual = found.whitened - taken @ (taken.T @ found.whitened)
    shifts = _Shifts(it, ReadingErrors.of(found), residual, taken, criteria.bad_seen)
    there = shifts.of.there.copy()
    count, few = int(there.sum()), found.degrees < criteria.few_readings
    there &= ~_kept(shifts)
    if few:
        there &= _amid(shifts)
    limit = float(norm.isf(0.5 * criteria.false_alarm / max(count, 1)))
    channels = it.load_cases.measured.shape[1]
    out: list[tuple[int, int, float, list[int]]] = []
    refused: list[int] = []
    while len(out) < max(1.0, criteria.bad_share * count):
        sizes = np.where(there, np.abs(shifts.scores), 0.0)
        looks = [_look(shifts, sizes, row, channels) for row in _farthest(shifts, sizes, limit)]
        if not looks:
            break
        look = max(looks, key=lambda it: it.size)
        if not look.size > limit:
            break
        row, number, scale = look.row, look.number, look.scale
        # One of a row: what was off twice was another state.
        there[row] = False
        beside = _beside(shifts, row, number, look.less.scores / scale, FEW_BESIDE if few else 1)
        rest = np.abs(look.less.scores[row]) / np.maximum(
            criteria.bad_neighbours * scale[row], criteria.bad_rest * sizes[row].max()
        )
        if np.all(np.abs(beside) < criteria.bad_neighbours) and rest.max() < 1.0:
            off = float(shifts.scores[row, number] / shifts.lengths[row, number])
            instead = _not_told_apart(look, shifts, sizes[row], criteria)
            out.append((row, int(shifts.of.channels[row, number]), off, instead))
            shifts = look.less
            # Beside this one what was refused may stand alone: it pulled the fit, and with it all that is near.
            there[refused] = shifts.of.there[refused]
            refused = []
        else:
            refused.append(row)
    whole = it.load_cases
    law = of_a_law([each[:2] for each in out], _of_channels(shifts.of, channels), whole, criteria.false_alarm)
    return tuple(_named(found, *each) for each in out if each[:2] not in law)


def _of_channels(of: ReadingErrors, channels: int) -> Mask:
    """(R, C) whether a row has a reading of a channel, as what is compared or as what was prescribed."""
    out = np.zeros((len(of.there), channels), dtype=bool)
    rows, numbers = np.nonzero(of.there)
    out[rows, of.channels[rows, numbers]] = True
    return out


@dataclass(frozen=True, eq=False)
class _Look:
    """The likeliest bad reading of a row. less: the shifts with its own taken out, and scale: (R, M) what scores are
    like then; size: its score in those. One bad reading of few moves all others, and with them their median."""

    row: int
    number: int
    less: _Shifts
    scale: Array
    size: float


def _farthest(shifts: _Shifts, sizes: Array, limit: float) -> list[int]:
    """The row of the largest score of each sensor, where that is beyond the limit."""
    of = shifts.of
    largest = (np.where(of.channels == k, sizes, 0.0).max(axis=1) for k in np.unique(of.channels))
    return sorted({int(np.argmax(it)) for it in largest if it.max() > limit})


def _look(shifts: _Shifts, sizes: Array, row: int, channels: int) -> _Look:
    number = _likeliest(sizes[row], shifts.lengths[row], channels)
    less = shifts.without(row, number)
    scale = _scales(less)
    return _Look(row, number, less, scale, float(sizes[row, number] / scale[row, number]))


def _kept(shifts: _Shifts) -> Mask:
    """(R, 1) rows with a reading that counts whatever it is: the one that was prescribed beside it would take it
    along."""
    whole = shifts.it.load_cases
    out = np.zeros((shifts.of.there.shape[0], 1), dtype=bool)
    for number, test in enumerate(whole.campaign.tests):
        steps = [step for step, _ in test.keep]
        out[whole.first[number] + np.flatnonzero(np.isin(test.data.steps, steps))] = True
    return out


def _scales(shifts: _Shifts) -> Array:
    """(R, M) what the scores of a reading's sensor are like, at least 1."""
    scores, of = np.abs(shifts.scores), shifts.of
    out = np.ones(scores.shape)
    for channel in np.unique(of.channels[of.there]):
        own = of.there & (of.channels == channel)
        out[own] = max(1.0, float(np.median(scores[own])) / MEDIAN)
    return out


def _likely(sizes: Array, lengths: Array) -> Array:
    """Twice the logarithm of what is likely, of the readings of a row (M,) by their t; minus infinity where there is
    none. With a shift of d = t / |c'| sigmas as rare as 1 / d², and known to 1 / |c'|, it is t² - 2 ln d, but for what
    is nearly the same for all."""
    off = np.where(sizes > 0.0, sizes / lengths, 1.0)
    return np.where(sizes > 0.0, sizes**2 - 2.0 * np.log(off), -np.inf)


def _likeliest(sizes: Array, lengths: Array, channels: int) -> int:
    """Of the readings of a row (M,), by their t; the first so many are read only, the others were prescribed.

    What is prescribed and what answers to it may say the same of a row: then it is the one that is off by fewer of its
    own sigmas. Where that speaks for neither it is what was read only: then the row stays.
    """
    likely = _likely(sizes, lengths)
    likely[channels:] -= FOR_NEITHER
    return int(np.argmax(likely))


def _not_told_apart(look: _Look, shifts: _Shifts, sizes: Array, criteria: Criteria) -> list[int]:
    """Channels of the readings of its row that explain it as well, as a rival of an effect would."""
    likely = _likely(sizes, shifts.lengths[look.row])
    near = np.flatnonzero(likely > likely[look.number] - criteria.exclusion)
    of = shifts.of.channels[look.row]
    return sorted({int(of[k]) for k in near} - {int(of[look.number])})


def _amid(shifts: _Shifts) -> Mask:
    """(R, M) readings in rows with `FEW_BESIDE` of the same test before and after, not at its greatest load."""
    whole = shifts.it.load_cases
    first, rows = whole.first[whole.test], np.arange(len(whole.test))
    after = whole.first[whole.test + 1] - 1 - rows
    amid = (rows - first >= FEW_BESIDE) & (after >= FEW_BESIDE) & ~at_greatest_loads(whole)
    return np.asarray(amid[:, None])


def _beside(shifts: _Shifts, row: int, number: int, scores: Array, reach: int) -> Array:
    """Scores of the same channel in so many rows before and after, of the same test."""
    whole = shifts.it.load_cases
    channel = shifts.of.channels[row, number]
    near = [row + k for k in range(-reach, reach + 1) if k]
    rows = [k for k in near if 0 <= k < len(whole.test) and whole.test[k] == whole.test[row]]
    return np.concatenate([scores[k][shifts.of.channels[k] == channel] for k in rows] or [np.zeros(0)])


def _named(found: Fit, row: int, channel: int, off: float, instead: list[int]) -> BadReading:
    whole = found.residual.load_cases
    test = whole.campaign.tests[whole.test[row]]
    number = row - whole.first[whole.test[row]]
    step, line = int(test.data.steps[number]), int(test.data.lines[number]) or None
    names = channel_columns(whole.campaign.gauges)
    return BadReading(test.id, step, names[channel], off, tuple(names[k] for k in instead), line)


def set_aside(campaign: Campaign, bad: tuple[BadReading, ...]) -> Campaign:
    """The campaign without these readings. A row where one of them was prescribed has nothing that is compared, for
    what was done there is not known; it stays on the way, with what was prescribed before and after. A test without
    another row is left out."""
    if not bad:
        return campaign
    names = channel_columns(campaign.gauges)
    found = [(test, set(_of(test, bad, names))) for test in campaign.tests]
    tests = [without(test, cells, campaign.gauges) if cells else test for test, cells in found]
    return replace(campaign, tests=tuple(test for test in tests if test is not None))


def _of(test: Test, bad: tuple[BadReading, ...], names: list[str]) -> Iterator[tuple[int, int]]:
    """Row in the test and channel of each."""
    for each in bad:
        if each.test == test.id:
            yield int(np.flatnonzero(test.data.steps == each.step)[0]), names.index(each.column)
