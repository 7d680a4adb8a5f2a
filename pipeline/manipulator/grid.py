"""A grid of platform points: nothing of it is stored but its edges, so it may have any number of points."""

from dataclasses import dataclass
from math import isfinite, prod

import numpy as np
from numpy.typing import NDArray

from pipeline.errors import InputError

LARGEST = 10**9


@dataclass(frozen=True)
class Grid:
    """Points on a box: low and high corner, mm, and how many along each axis; z runs fastest.

    InputError for corners that are not finite or in the wrong order, or counts below one; one point along an axis
    lies at its low edge.
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    counts: tuple[int, int, int]

    def __post_init__(self) -> None:
        for axis, a, b, n in zip("xyz", self.low, self.high, self.counts, strict=True):
            if not (isfinite(a) and isfinite(b) and a <= b):
                raise InputError(
                    f"grid along {axis}: from {a:g} to {b:g} mm, allowed are a lower and a higher edge"
                )
            if n < 1:
                raise InputError(f"grid along {axis}: {n} points, allowed are 1 or more")
        if self.size > LARGEST:
            raise InputError(f"grid: {self.size} points, allowed are up to {LARGEST}")

    @property
    def size(self) -> int:
        """Number of points."""
        return prod(self.counts)

    def axis(self, number: int) -> NDArray[np.float64]:
        """Coordinates along one axis, mm."""
        return np.linspace(self.low[number], self.high[number], self.counts[number])

    def points(self, start: int, stop: int) -> NDArray[np.float64]:
        """(stop - start, 3) the points with these numbers, mm."""
        places = np.unravel_index(np.arange(start, stop), self.counts)
        return np.stack([self.axis(k)[place] for k, place in enumerate(places)], axis=-1)
