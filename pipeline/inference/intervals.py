"""95 % intervals of fitted numbers, and which of them the data cannot tell apart.

An interval is what raises the sum of squares by no more than 3.841 after all other numbers were fitted again
(profile likelihood). Where the sum is a parabola in the number the end is 1.96 standard errors away (Wald), and one
evaluation a side shows it.
Sources: D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37 (1988) 87-94; D. M. Bates, D. G. Watts, Nonlinear
Regression Analysis, Wiley 1988, ch. 6.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Free
from pipeline.inference.objective import Objective
from pipeline.inference.predicted import Prediction
from pipeline.inference.profile_likelihood import RISE, ProfileLikelihood, Range
from pipeline.inference.rounding import AT_BOUND, EXACTLY
from pipeline.inference.settings import PROFILE
from pipeline.inference.solvers import WORK, allowance
from pipeline.inference.stops import sided
from pipeline.inference.subsets import at_rows
from pipeline.processors import at_once
from vjm.work import at_most

Array = NDArray[np.float64]
Out = TypeVar("Out")
Z = float(norm.ppf(0.5 * (1.0 + PROFILE.confidence)))


@dataclass(frozen=True)
class Interval:
    """A fitted number. std: standard error, infinite where the data say nothing.

    low, high: 95 %; None where the data set no end on that side. kind: how the ends were found; "undetermined"
    where the whole range remains.
    """

    value: float
    std: float
    low: float | None
    high: float | None
    kind: Literal["wald", "profile", "undetermined"]

    def error(self, side: int) -> float:
        """Standard error towards what is below (-1) or above (1): the way to that end of the interval over 1.96.

        One that differs by side is what a sum of squares that is no parabola gives (F. James, M. Roos, Computer Physics
        Communications 10, 1975, 343-367, MINOS). Where no end was found, that of a parabola.
        """
        end = self.low if side < 0 else self.high
        return self.std if end is None or end == self.value else abs(end - self.value) / Z


def profile_likelihood(best: Fit, load_cases: LoadCases) -> ProfileLikelihood:
    """The sum of squares about a best fit."""
    kinks = {term.effect.name for term in best.model.terms if sided(term.effect)}
    doubt = best.residual.doubt + best.residual.spread
    ranges = [_range(each, doubt if each.effect in kinks else 0.0) for each in best.model.free]
    rows, own = load_cases.by_role[0]
    near = at_rows(best.prediction, load_cases, own, rows)
    if near.nominal.size:
        own = replace(own, by_nominal=near.by_nominal)
    return ProfileLikelihood(
        _Near(Objective(best.model, own), near),
        best.model.values,
        ranges,
        best.residual.aimed,
        best.residual.aimed_by,
        most=PROFILE.work * WORK * allowance(own),
    )


def _range(each: Free, doubt: float) -> Range:
    return Range(*each.bounds, each.parameter.null, each.parameter.one_sided, doubt)


@dataclass(frozen=True, eq=False)
class _Near:
    """The residuals of a campaign about its best fit, found from there."""

    aim: Objective
    near: Prediction

    def residuals(self, values: Array) -> Array:
        """(N + 1,)"""
        return self.aim.at(values, self.near, slopes=False, within=PROFILE.close).residuals

    def both(self, values: Array) -> tuple[Array, Array]:
        """(N + 1,) and (N + 1, P)"""
        found = self.aim.at(values, self.near, within=PROFILE.close)
        return found.residuals, found.jacobian


def intervals(land: ProfileLikelihood) -> tuple[Interval, ...]:
    """The interval of every number. TooMuch where they take more work than `land.most`."""
    with at_most(land.most):
        return _intervals(land)


def _intervals(land: ProfileLikelihood) -> tuple[Interval, ...]:
    looks = _at_once(land, [partial(_looked, land, k) for k in range(land.values.size)])
    sides = [
        (k, *side) for k, look in enumerate(looks) if not isinstance(look, Interval) for side in look.items()
    ]
    ends = _at_once(land, [partial(_end, land, *each) for each in sides])
    found = {(k, side): end for (k, side, _), end in zip(sides, ends, strict=True)}
    return tuple(
        look if isinstance(look, Interval) else _profile(land, k, {side: found[k, side] for side in look})
        for k, look in enumerate(looks)
    )


def straight(land: ProfileLikelihood) -> tuple[Interval, ...]:
    """As if the sum of squares were a parabola: for a model that leaves more than noise, of which a rise by 3.841 says
    nothing that many solutions would be worth."""
    return tuple(_straight(land, k) for k in range(land.values.size))


def _straight(land: ProfileLikelihood, k: int) -> Interval:
    value, span = float(land.values[k]), land.ranges[k]
    std = float(np.sqrt(land.ridge(k)[1]))
    low, high = (value + side * Z * std for side in (-1, 1))
    seen = std < span.high - span.low
    open_ends = low <= span.low and high >= span.high
    return Interval(
        value,
        std if seen else np.inf,
        low if low > span.low else span.end(-1),
        high if high < span.high else span.end(1),
        "wald" if seen and not open_ends else "undetermined",
    )


def _at_once(land: ProfileLikelihood, calls: Sequence[Callable[[], Out]]) -> list[Out]:
    """What calls that look at a profile likelihood return; it counts what they took wherever they were made."""
    before = land.evaluations
    found = at_once([partial(_counted, land, call) for call in calls])
    land.evaluations = before + sum(count for _, count in found)
    return [each for each, _ in found]


def _counted(land: ProfileLikelihood, call: Callable[[], Out]) -> tuple[Out, int]:
    before = land.evaluations
    return call(), land.evaluations - before


def _looked(land: ProfileLikelihood, k: int) -> Interval | dict[int, float]:
    """The interval of a number where no end must be looked for; else the sides, -1 and 1, on which one must, and how
    far away it may be."""
    value, span = float(land.values[k]), land.ranges[k]
    way, variance = land.ridge(k)
    std = float(np.sqrt(variance))
    if not std < span.high - span.low:
        return Interval(value, np.inf, span.end(-1), span.end(1), "undetermined")
    reach = Z * std
    sides = [side for side in (-1, 1) if not _null_in_doubt(land, k, side, way)]
    if land.active[k] or len(sides) < 2 or min(span.room(value, side) for side in sides) <= reach:
        return {side: _distance(land, k, side, variance) for side in sides}
    # One look a side, the others moved along; what they could still gain makes the rise no larger.
    rises = [land.chi_square(land.values + side * reach * way) - land.least for side in sides]
    if all(abs(rise - RISE) < PROFILE.nearly * RISE for rise in rises):
        return Interval(value, std, value - reach, value + reach, "wald")
    return {side: reach * _farther(rise) for side, rise in zip(sides, rises, strict=True)}


def _distance(land: ProfileLikelihood, k: int, side: int, variance: float) -> float:
    """At which a parabola has risen by 3.841, from a bound where that stops the number."""
    slope = 2.0 * side * float(land.jacobian[:, k] @ land.residuals) if land.active[k] else 0.0
    return float(0.5 * (np.hypot(slope * variance, 2.0 * np.sqrt(RISE * variance)) - slope * variance))


def _farther(rise: float) -> float:
    """Times a distance with this rise at which a parabola has risen by 3.841, within reason; 1 where it rose by so much
    that it is none, and the others will have to move another way."""
    times = Z / float(np.sqrt(max(rise, PROFILE.least_rise)))
    return 1.0 if times < 1.0 / PROFILE.farther else min(times, PROFILE.farther)


def _profile(land: ProfileLikelihood, k: int, ends: dict[int, float | None]) -> Interval:
    """ends: of the sides on which they were looked for."""
    span, std = land.ranges[k], float(np.sqrt(land.ridge(k)[1]))
    low, high = (ends.get(side, span.end(side)) for side in (-1, 1))
    open_ends = low == span.end(-1) and high == span.end(1)
    return Interval(float(land.values[k]), std, low, high, "undetermined" if open_ends else "profile")


def _null_in_doubt(land: ProfileLikelihood, k: int, side: int, way: Array) -> bool:
    """Whether the number has its null on that side, and what speaks against null may be choices of sides."""
    span = land.ranges[k]
    if not span.doubt or span.end(side) is None:
        return False
    room, most = span.room(float(land.values[k]), side), RISE + span.doubt
    return room <= 0.0 or land.rise(k, side * room, way, most)[0] < most


def _end(land: ProfileLikelihood, k: int, side: int, guess: float) -> float | None:
    """The value at which the profile has risen by 3.841 on that side, looked for at first at a distance; what the
    interval says if the bound comes first."""
    value, span = float(land.values[k]), land.ranges[k]
    shift = _shift(land, k, side, guess, span.room(value, side), land.ridge(k)[0])
    return span.end(side) if shift is None else value + side * shift


def _shift(land: ProfileLikelihood, k: int, side: int, guess: float, room: float, way: Array) -> float | None:
    """Distance from the value at which the profile has risen by 3.841; None if the bound comes first."""
    if room <= AT_BOUND * (land.ranges[k].high - land.ranges[k].low):
        return None
    inside, below, outside, above = 0.0, 0.0, np.inf, np.inf
    step = min(max(guess, PROFILE.first * room), room)
    for _ in range(PROFILE.steps):
        rise, way = land.rise(k, side * step, way)
        height = float(np.sqrt(max(rise, 0.0)))
        if abs(height - Z) < PROFILE.close * Z:
            return step
        if height < Z:
            if step >= room:
                return None
            inside, below = step, height
        else:
            outside, above = step, height
        if np.isinf(outside):
            step = min(room, step * max(_farther(rise), PROFILE.no_less_far))
            continue
        # The square root of a parabola is a line; kept off the ends of the bracket it also halves a jump.
        part = float(np.clip((Z - below) / (above - below), PROFILE.off_ends, 1.0 - PROFILE.off_ends))
        step = inside + part * (outside - inside)
        if outside - inside < PROFILE.close * outside:
            return step
    return step


def has_an_end(land: ProfileLikelihood, k: int) -> bool:
    """Whether the interval of a number ends before its bounds on any side, without a search for where."""
    value, span = float(land.values[k]), land.ranges[k]
    way, variance = land.ridge(k)
    std, width = float(np.sqrt(variance)), span.high - span.low
    if not std < width:
        return False
    rooms = {side: span.room(value, side) for side in (-1, 1)}
    if max(rooms.values()) > PROFILE.farther * Z * std:
        return True
    for side, room in rooms.items():
        most = RISE + (0.0 if span.end(side) is None else span.doubt)
        if room > AT_BOUND * width and land.rise(k, side * room, way, most)[0] > most:
            return True
    return False


def holds_null(land: ProfileLikelihood, k: int) -> bool:
    """Whether the interval of a number holds its null, without a search for the ends: by the rise there."""
    span = land.ranges[k]
    way, variance = land.ridge(k)
    shift = float(np.clip(span.null, span.low, span.high)) - float(land.values[k])
    if not np.sqrt(variance) < span.high - span.low or abs(shift) <= AT_BOUND * (span.high - span.low):
        return True
    most = RISE + (span.doubt if span.one_sided else 0.0)
    return land.rise(k, shift, way, most)[0] < most


def correlations(land: ProfileLikelihood, least: float = PROFILE.told) -> list[tuple[int, int, float]]:
    """Pairs of numbers whose errors go together, strongest first: (i, j, correlation) of at least this size."""
    free = np.flatnonzero(~land.active)
    slopes = land.jacobian[:, free]
    sizes = np.linalg.norm(slopes, axis=0)
    seen = [
        int(k)
        for k, size in zip(free, sizes, strict=True)
        if size > 0.0 and np.isfinite(land.ridge(int(k))[1])
    ]
    if len(seen) < 2:
        return []
    scaled = land.jacobian[:, seen] / np.linalg.norm(land.jacobian[:, seen], axis=0)
    values, axes = np.linalg.eigh(scaled.T @ scaled)
    # Numbers that go together exactly leave a value that is rounding, of either sign.
    covariance = (axes / np.maximum(values, EXACTLY * values.max())) @ axes.T
    std = np.sqrt(np.diag(covariance))
    both = covariance / np.outer(std, std)
    pairs = [
        (int(seen[i]), int(seen[j]), float(both[i, j]))
        for i in range(len(seen))
        for j in range(i + 1, len(seen))
        if abs(both[i, j]) >= least
    ]
    return sorted(pairs, key=lambda pair: -abs(pair[2]))


def only_together(land: ProfileLikelihood) -> list[tuple[int, ...]]:
    """Sets of numbers of which the data see only combinations: each is visible, none is determined."""
    sizes = np.linalg.norm(land.jacobian, axis=0)
    free = np.flatnonzero(~land.active & (sizes > 0.0))
    if free.size < 2:
        return []
    _, values, ways = np.linalg.svd(land.jacobian[:, free] / sizes[free], full_matrices=True)
    hidden = ways[int(np.sum(values > PROFILE.blind * values.max())) :]
    groups: list[set[int]] = []
    for way in hidden:
        # Any mixture of hidden directions is hidden: sets that share a number are one.
        joined = {int(k) for k in free[np.abs(way) > PROFILE.shared]}
        for group in [g for g in groups if g & joined]:
            groups.remove(group)
            joined |= group
        groups.append(joined)
    return [tuple(sorted(group)) for group in groups if len(group) > 1]
