"""What a sensor may do wrong that no effect of a linkage explains: gains, growth, drift, lag, loops, cross-talk.

Each is one column: what the readings would be off by. An error of a sensor that controls a coordinate acts through
the mechanism. What is left after a fit must not follow any of them; they describe and are no physics.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.driving import column_name
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.residual import Whitening, whitening
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import PATTERNS
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pattern:
    """A pattern that the residual follows. score: in sigmas, without the reading that says most for it. amplitude:
    largest error of the reading, its unit. takes: chi-square that it takes off, all readings counted."""

    channel: int
    words: str
    score: float
    amplitude: float
    takes: float


@dataclass(frozen=True, eq=False)
class Shape:
    """What a fault of a sensor does to the residual of a fit, free of what the fit can move. words: of the fault.

    column: (N,) whitened. size: its length. largest: largest error of the reading, of a fault of size 1.
    """

    channel: int
    words: str
    column: Array
    size: float
    largest: float


def shapes(found: Fit, criteria: Criteria) -> Iterator[Shape]:
    """Every pattern of every sensor that the fit does not take up."""
    whole = found.residual.load_cases
    readings = expected(found, criteria.chosen_side)
    for channel in range(whole.measured.shape[1]):
        named = list(_errors(whole, readings, channel))
        if not named:
            continue
        errors = np.stack([error for _, error in named], axis=-1)
        yield from left_of(found, channel, [words for words, _ in named], errors)


def left_of(found: Fit, channel: int, words: Sequence[str], errors: Array) -> Iterator[Shape]:
    """The shapes of errors (R, K) of a channel's readings, those of which the fit leaves any."""
    whole = found.residual.load_cases
    used = whole.predicted & whole.fitted[:, None]
    weights, taken = _weights_and_taken(found)
    columns = found.residual.weakened(weights.apply(acting(found, channel, errors))[used])
    left = columns - taken @ (taken.T @ columns)
    sizes, whole_sizes = np.linalg.norm(left, axis=0), np.linalg.norm(columns, axis=0)
    name = column_name(channel, whole.campaign.gauges)
    for k in np.flatnonzero(sizes > PATTERNS.left * np.maximum(whole_sizes, TINY)).tolist():
        largest = float(np.abs(errors[..., k]).max())
        yield Shape(channel, f"{name} {words[k]}", left[:, k], float(sizes[k]), largest)


@lru_cache(maxsize=1)
def _weights_and_taken(found: Fit) -> tuple[Whitening, Array]:
    """The whitening of a fit, and (N, P) what it can move, orthonormal: the same for all channels that follow."""
    taken = basis(np.hstack([found.jacobian, found.residual.flat(found.residual.offsets)]))
    return whitening(found.residual.load_cases, found.prediction), taken


def scores(found: Fit, criteria: Criteria) -> list[Pattern]:
    """How well the residual of the fitted tests follows each pattern, after the fit took its part; largest first."""
    out = []
    for it in shapes(found, criteria):
        score = steady(it.column, found.whitened)
        takes = float(it.column @ found.whitened / it.size) ** 2
        out.append(Pattern(it.channel, it.words, score, score / it.size * it.largest, takes))
    return sorted(out, key=lambda it: -abs(it.score))


def steady(column: Array, residual: Array, rows: NDArray[np.int64] | None = None) -> float:
    """Sigmas by which a residual (N,) follows a column (N,), without the one reading that says most for it; rows (N,):
    without the one row, in all of whose readings a bad one may show.

    A faulty sensor shows in many readings; near a kink of the model a single one may be off by far.
    """
    of = np.arange(len(column)) if rows is None else rows
    parts, squares = (
        np.asarray(np.bincount(of, weights=it), dtype=float) for it in (column * residual, column**2)
    )
    total, size = float(parts.sum()), float(squares.sum())
    best = int(np.argmax(parts * np.sign(total)))
    rest = size - float(squares[best])
    whole = total / np.sqrt(size)
    without = (total - float(parts[best])) / np.sqrt(rest) if rest > PATTERNS.left**2 * size else 0.0
    return float(np.sign(total) * max(0.0, min(abs(whole), without * np.sign(total))))


def acting(found: Fit, channel: int, errors: Array) -> Array:
    """(R, C, K) what errors (R, K) of a channel's readings do to the differences of readings and predictions."""
    whole = found.residual.load_cases
    out = np.zeros((*whole.measured.shape, errors.shape[1]))
    out[:, channel] = errors
    controls = whole.channels == channel
    rows = np.flatnonzero(controls.any(axis=1))
    place = np.argmax(controls[rows], axis=1)
    through = found.prediction.by_inputs[rows, :, place]
    out[rows] = -through[..., None] * errors[rows][:, None, :]
    return out


def expected(found: Fit, chosen_side: float) -> Array:
    """(R, C) readings as they would be without noise: with it, a pattern would follow the noise of its own sensor. So
    would small ones, up to so many sigmas, of a row that chose its side of a play by that noise, and of a coordinate
    that is held where it is in every row: the inputs that fit best follow the residual. They are zero."""
    whole = found.residual.load_cases
    readings = found.prediction.values.copy()
    given = np.take_along_axis(np.nan_to_num(whole.measured), whole.channels, axis=1)
    np.put_along_axis(readings, whole.channels, given + found.residual.shift[:, :6], axis=1)
    readings[found.prediction.lost] = 0.0
    for channel in np.unique(whole.channels):
        rows = np.any(whole.channels == channel, axis=1)
        there = np.abs(np.nan_to_num(whole.measured[rows, channel])).max(initial=0.0)
        if there < chosen_side * whole.sigma[channel]:
            readings[rows, channel] = 0.0
    chosen = found.residual.undecided[:, None] & (np.abs(readings) < chosen_side * whole.spread)
    return np.where(chosen, 0.0, readings)


def _errors(whole: LoadCases, readings: Array, channel: int) -> Iterator[tuple[str, Array]]:
    """(R,) errors of a channel's readings, largest about 1, with words for each."""
    mine = readings[:, channel]
    span = float(np.abs(mine).max(initial=0.0))
    if span == 0.0 and not np.any(whole.input_sigma[:, :6][whole.channels == channel]):
        return
    m = mine / max(span, TINY)
    if span > 0.0:
        yield "reads too much or too little in proportion", m
        yield "has a gain that grows with its reading", m * np.abs(m)
        yield "has a gain that grows one way", m * m
    yield "has an offset", np.ones_like(m)
    yield "has a zero that moves during a test", _within(whole)
    yield "has a zero that moves during the campaign", np.linspace(0.0, 1.0, m.size)
    if span > 0.0:
        yield "follows slowly", _lagged(whole, m)
        yield "depends on the direction of travel", _direction(whole, m)
    for other in _neighbours(channel):
        there = np.abs(readings[:, other]).max(initial=0.0)
        if there > 0.0:
            name = column_name(other, whole.campaign.gauges)
            yield f"answers to {name}", readings[:, other] / there


def _neighbours(channel: int) -> list[int]:
    """Channels of the same instrument."""
    if channel >= 12:
        return []
    first = 6 * (channel // 6)
    return [k for k in range(first, first + 6) if k != channel]


def _within(whole: LoadCases) -> Array:
    """Place of a row within its test, 0 to 1."""
    first = whole.first
    return np.concatenate([np.linspace(0.0, 1.0, int(b - a)) for a, b in pairwise(first)])


def _lagged(whole: LoadCases, m: Array) -> Array:
    out = np.zeros_like(m)
    for row in range(1, m.size):
        if whole.test[row] == whole.test[row - 1]:
            out[row] = PATTERNS.lag * out[row - 1] + (m[row] - m[row - 1])
    return out


def _direction(whole: LoadCases, m: Array) -> Array:
    steps = np.diff(m, prepend=0.0)
    steps[whole.first[:-1]] = m[whole.first[:-1]]
    return np.asarray(np.sign(np.where(np.abs(steps) > PATTERNS.travel, steps, 0.0)))
