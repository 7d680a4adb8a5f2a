"""A sum of squares about its minimum: how it rises when one number is moved and all others are fitted again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear
from scipy.stats import chi2

from pipeline.inference.rounding import AT_BOUND, ROUNDING, TINY
from pipeline.inference.settings import PROFILE

Array = NDArray[np.float64]
RISE = float(chi2.ppf(PROFILE.confidence, 1))


class LeastSquares(Protocol):
    """A sum of squares of residuals (N,) of values (P,). both: with their Jacobian (N, P), in one solution."""

    def residuals(self, values: Array) -> Array: ...

    def both(self, values: Array) -> tuple[Array, Array]: ...


@dataclass(frozen=True)
class Range:
    """What a number may be: low and high bound a fit. null: value without the effect.

    one_sided: the bound next to null is a physical end; an interval that reaches it ends at null.
    doubt: rise of the sum of squares at that end, beyond 3.841, that still does not exclude it.
    """

    low: float
    high: float
    null: float
    one_sided: bool = False
    doubt: float = 0.0

    def room(self, value: float, side: int) -> float:
        """From a value to the bound below (-1) or above (1)."""
        return value - self.low if side < 0 else self.high - value

    def end(self, side: int) -> float | None:
        """What an interval says that reaches the bound below (-1) or above (1): None, unless null is there."""
        bound, other = (self.low, self.high) if side < 0 else (self.high, self.low)
        return self.null if self.one_sided and abs(bound - self.null) < abs(other - self.null) else None


@dataclass(eq=False)
class ProfileLikelihood:
    """A sum of squares about its minimum at values (P,): ridges, profiles. ranges: of each number. most: work
    (`vjm.work`) that its intervals may take."""

    problem: LeastSquares
    values: Array
    ranges: Sequence[Range]
    residuals: Array
    jacobian: Array
    evaluations: int = 0
    most: float = np.inf
    bounds: Array = field(init=False)
    least: float = field(init=False)
    active: NDArray[np.bool_] = field(init=False)
    """(P,) numbers that a bound stops."""

    def __post_init__(self) -> None:
        self.bounds = np.array([(r.low, r.high) for r in self.ranges]).reshape(-1, 2).T
        self.least = float(self.residuals @ self.residuals)
        near = AT_BOUND * (self.bounds[1] - self.bounds[0])
        # In sigmas. What is no steeper than a fit leaves undone stops nothing: along a valley floor a fit may end at
        # a bound as well as anywhere else.
        uphill = self.jacobian.T @ self.residuals / np.maximum(np.linalg.norm(self.jacobian, axis=0), TINY)
        self.active = ((self.values - self.bounds[0] <= near) & (uphill > PROFILE.flat)) | (
            (self.bounds[1] - self.values <= near) & (uphill < -PROFILE.flat)
        )

    def ridge(self, k: int) -> tuple[Array, float]:
        """How all numbers move (P,) with number k when the others are fitted, and its variance."""
        others = np.flatnonzero(~self.active & (np.arange(self.values.size) != k))
        own, rest = self.jacobian[:, k], self.jacobian[:, others]
        sizes = np.maximum(np.linalg.norm(rest, axis=0), TINY)
        answer = np.linalg.lstsq(rest / sizes, -own, rcond=PROFILE.blind)[0] / sizes
        left = float(np.linalg.norm(own + rest @ answer))
        way = np.zeros(self.values.size)
        way[k], way[others] = 1.0, answer
        seen = left > PROFILE.blind * float(np.linalg.norm(own)) and left > 0.0
        return way, left**-2 if seen else np.inf

    def chi_square(self, values: Array) -> float:
        """The sum of squares at values, brought within the bounds."""
        self.evaluations += 1
        found = self.problem.residuals(np.clip(values, *self.bounds))
        return float(found @ found)

    def rise(self, k: int, shift: float, way: Array, asked: float = RISE) -> tuple[float, Array]:
        """By how much the sum of squares rises when number k is moved and all others are fitted again.

        way: (P,) how the others begin, a unit of k. asked: what the rise is compared with; a much larger one is an
        estimate. Returns also how the others went, to begin with at the next shift.
        """
        values = np.clip(self.values + shift * way, *self.bounds)
        if values.size == 1:
            return self.chi_square(values) - self.least, way
        others = np.arange(values.size) != k
        values, total = self._refitted(values, others, asked)
        return total - self.least, (values - self.values) / shift

    def _refitted(self, values: Array, others: NDArray[np.bool_], asked: float) -> tuple[Array, float]:
        """Values and sum of squares after Gauss-Newton steps of the others within their bounds.

        The last step is not solved again where it gains little, or leaves a rise that is far larger than what is asked
        about: its linear estimate is taken. Residuals that no slope foresees, as those of lost rows, say nothing there.
        """
        residuals, slopes = self.problem.both(values)
        total = float(residuals @ residuals)
        self.evaluations += 1
        for _ in range(PROFILE.steps):
            sizes = np.maximum(np.linalg.norm(slopes[:, others], axis=0), TINY)
            room = (self.bounds[:, others] - values[others]) * sizes + np.array([[-ROUNDING], [ROUNDING]])
            step = lsq_linear(slopes[:, others] / sizes, -residuals, bounds=room).x
            left = residuals + (slopes[:, others] / sizes) @ step
            trial = values.copy()
            trial[others] = np.clip(values[others] + step / sizes, *self.bounds[:, others])
            gain = total - float(left @ left)
            seen = np.any(slopes[:, others] != 0.0, axis=1)
            foreseen = float(left[seen] @ left[seen] - self.residuals[seen] @ self.residuals[seen])
            if gain < PROFILE.close * RISE or foreseen > PROFILE.enough * asked:
                return trial, total - gain
            found, new = self.problem.both(trial)
            self.evaluations += 1
            if float(found @ found) >= total:
                # Across a kink the linear step may lead uphill; half of it is tried, then it is left.
                trial[others] = 0.5 * (trial[others] + values[others])
                found, new = self.problem.both(trial)
                self.evaluations += 1
            if float(found @ found) >= total:
                break
            values, residuals, slopes, total = trial, found, new, float(found @ found)
        return values, total
