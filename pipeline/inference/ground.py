"""Sums of squares on firm ground: linearised near the inputs that fit best, and not where a step came from.

Where rows choose their sides of a kink, the sum of squares at the same numbers depends on where a fit came from, some
units of it: a step may look good against where it began, and be worse once linearised anew. A fit that follows
such steps climbs, a little with each, and needs an end and a way back. The way back is to where it began, if that is
the end of a fit with less in it: the least that is met on the way has only taken up more noise than the others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.objective import Objective, Place
from pipeline.inference.residual import residual

Array = NDArray[np.float64]
NEAR = 0.1
"""Of their sigmas: so near to the inputs that fit best a fit must have been linearised to end there."""
SAME = 0.1
"""Of chi-square, by which numbers that begin beside their null may leave less than the start."""
CIRCLES = 3
"""Times in a row that a fit is linearised anew and finds no less than before."""
FAR = 2.0
"""A model that leaves so many times what noise does is far from it: no verdict hangs on how much it leaves."""
DRAGGING = 0.01
"""Of what is left beyond noise: less than this is nothing there."""


def far(total: float, count: int) -> bool:
    """Whether a sum of so many squares is far above noise."""
    return total > FAR * count


def nothing(gain: float, total: float, count: int) -> bool:
    """Whether a sum of so many squares is far above noise, and what it fell by is nothing."""
    return far(total, count) and gain < DRAGGING * (total - count)


@dataclass(eq=False)
class Ground:
    """Where an objective was linearised anew. total: what is made least, of values (P,) where the objective stands."""

    aim: Objective
    total: Callable[[Array], float]
    least: float = np.inf
    vain: int = 0
    _firm: Array | None = field(default=None, repr=False)
    _refuge: tuple[float, Array, Place] | None = field(default=None, repr=False)

    def begin(self, values: Array) -> None:
        """Solve at the first values. Where that leaves no less than the start did, it is as good a place; less is left
        by rows that chose sides of a play from inputs that belong to none."""
        start = self.aim.last
        left = self.aim.residuals(values)
        if start is not None and left @ left >= np.sum(residual(self.aim.program, start).aimed ** 2) - SAME:
            self._refuge = (self._noted(values), values, self.aim.place)

    def anew(self, place: Place, values: Array) -> bool:
        """Whether back at a place it took to be linearised anew, as it was far from the inputs that fit best.

        Far above noise it is not where that changed nothing before: inputs that no noise could bring to the readings
        are never found.
        """
        self.aim.back(place)
        if self.aim.unsettled(values) <= NEAR or (
            self._firm is not None and np.array_equal(values, self._firm)
        ):
            return False
        before, after = self.aim.residuals(values), self.aim.again(values)
        left = float(after @ after)
        change = abs(left - float(before @ before))
        self._firm = values if nothing(change, left, after.size) else None
        self._noted(values)
        return True

    @property
    def circling(self) -> bool:
        """Whether nothing less was found for so long that nothing will be."""
        return self.vain >= CIRCLES

    def end(self, place: Place, values: Array) -> Array:
        """The values to end with, those of the beginning where these are worse; the objective stands there."""
        # One that ends on a step not taken ends where it was linearised before that.
        self.anew(place, values)
        if self._refuge is not None and self._refuge[0] < self.total(values):
            _, values, place = self._refuge
            self.aim.back(place)
        return values

    def _noted(self, values: Array) -> float:
        total = self.total(values)
        self.vain = 0 if total < self.least else self.vain + 1
        self.least = min(self.least, total)
        return total
