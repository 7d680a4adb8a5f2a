"""Whether the numbers that were fitted are the same in all tests: what one angle or one test alone asks for is none.

An effect that is named though it is another, or one that is there at some angles alone, needs other numbers elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import PATTERNS
from pipeline.selection.adequacy.patterns import steady


@dataclass(frozen=True)
class Departure:
    """A number that some tests would have otherwise. where: which. score: in sigmas. looks: how many were taken."""

    name: str
    where: str
    change: float
    score: float
    looks: int


def largest_departure(found: Fit) -> Departure | None:
    """The plainest of all numbers at each angle and in each test, to first order; None where none can be seen."""
    return max(departures(found), key=lambda it: abs(it.score), default=None)


def departures(found: Fit) -> list[Departure]:
    """Of all numbers at each angle and in each test, to first order, those that can be seen."""
    it = found.residual
    taken = basis(np.hstack([found.jacobian, it.flat(it.offsets)]))
    seen: list[tuple[str, str, float, float]] = []
    for where, rows in _parts(found):
        columns = it.weakened(np.where(rows[:, None], it.without_zeros(it.slopes), 0.0))
        left = columns - taken @ (taken.T @ columns)
        sizes, whole = np.linalg.norm(left, axis=0), np.linalg.norm(columns, axis=0)
        for k in np.flatnonzero(sizes > PATTERNS.left * np.maximum(whole, TINY)):
            score = steady(left[:, k], found.whitened)
            seen.append((found.model.free[k].name, where, score / float(sizes[k]), score))
    return [Departure(*one, looks=len(seen)) for one in seen]


def _parts(found: Fit) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Residuals (N,) of each angle and of each test, where there are several, in words."""
    whole = found.residual.load_cases
    tests = whole.test[found.residual.rows[:, 0]]
    angles = np.array([round(float(np.degrees(test.q)), 6) for test in whole.campaign.tests])[tests]
    for q in np.unique(angles):
        if np.any(angles != q):
            yield f"at q = {q:g}°", angles == q
    for k in np.unique(tests):
        # One test that is all of its angle was looked at.
        if np.any((tests != k) & (angles == angles[tests == k][0])):
            yield f"in test {whole.campaign.tests[k].id}", tests == k
