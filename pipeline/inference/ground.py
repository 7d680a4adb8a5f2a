"""The least sum of squares on firm ground: linearised near the inputs that fit best, and not where a step came from.

Where rows choose their sides of a kink, the sum of squares at the same numbers depends on where a fit came from, some
units of it: a step may look good against where it began, and be worse once linearised anew. A fit that follows
such steps climbs, a little with each, and needs an end and a way back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.objective import Objective, Place

Array = NDArray[np.float64]
NEAR = 0.1
"""Of their sigmas: so near to the inputs that fit best a fit must have been linearised to end there."""
CIRCLES = 3
"""Times in a row that a fit is linearised anew and finds no less than before."""


@dataclass(eq=False)
class Ground:
    """The best of the places at which an objective was linearised anew. total: what is made least, of values (P,)."""

    aim: Objective
    total: Callable[[Array], float]
    least: float = np.inf
    best: tuple[Array, Place] | None = field(default=None, repr=False)
    vain: int = 0

    def anew(self, place: Place, values: Array) -> bool:
        """Whether back at a place it took to be linearised anew, as it was far from the inputs that fit best."""
        self.aim.back(place)
        if self.aim.unsettled(values) <= NEAR:
            return False
        self.aim.again(values)
        self.note(values)
        return True

    def note(self, values: Array) -> None:
        """Compare where it stands with the best place, and keep the better."""
        total = self.total(values)
        if total < self.least:
            self.least, self.best, self.vain = total, (values, self.aim.place), 0
        else:
            self.vain += 1

    @property
    def circling(self) -> bool:
        """Whether nothing less was found for so long that nothing will be."""
        return self.vain >= CIRCLES

    def end(self, place: Place, values: Array) -> Array:
        """The values to end with; the objective stands there."""
        # One that ends on a step not taken ends where it was linearised before that.
        if not self.circling and not self.anew(place, values):
            self.note(values)
        if self.best is not None:
            values, place = self.best
            self.aim.back(place)
        return values
