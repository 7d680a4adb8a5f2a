"""How fine a mesh is: a coarse element size and a whole-number refinement of it.

Refinement multiplies the element counts, so that the meshes of a convergence study are nested.
"""

from dataclasses import dataclass
from math import isfinite, log

# A cell in the middle of the bar is this many times as long as one at its ends, where warping and the
# rigid faces make the stress vary within a few millimetres.
STRETCH = 8.0


@dataclass(frozen=True)
class Resolution:
    """`size` mm of a coarse element across the section; `level` divides every coarse element `level` times."""

    size: float
    level: int = 1

    def __post_init__(self) -> None:
        if not (isfinite(self.size) and self.size > 0.0):
            raise ValueError(f"mesh size is {self.size:g}, allowed is a length above 0 mm")
        if self.level < 1:
            raise ValueError(f"mesh level is {self.level}, allowed is a whole number from 1")

    def across(self, length: float) -> int:
        """Number of elements over a `length` in the section or in a lug, mm."""
        return self.level * max(1, round(length / self.size))

    def along(self, length: float) -> tuple[int, float]:
        """Number of elements over a graded `length` of the body, and the ratio of neighbouring elements."""
        mean = self.size * (STRETCH - 1.0) / log(STRETCH)
        coarse = max(2, round(length / mean))
        ratio = STRETCH ** (1.0 / (coarse - 1))
        return self.level * coarse, ratio ** (1.0 / self.level)
