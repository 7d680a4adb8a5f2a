"""A test as it is usually done on a rig: in words, with what it prescribes."""

from dataclasses import dataclass


@dataclass(frozen=True)
class UsualTest:
    """A test in words, what it prescribes, and which coordinate is taken there and back, both ways.

    control: as in `Test`. push: axial force that stands meanwhile, as a share of the largest.
    """

    words: str
    control: tuple[str, ...]
    coordinate: int
    push: float = 0.0


STEPS = 16
"""Load steps of one that is there and back, both ways."""
WARMER_K = 10.0
"""Of one that is repeated in a warmer hall."""
MODEST = (0.0, 0.02, 0.05, 0.03, 0.03, 0.04)
"""Travel where nothing like it was done: lengths of the bar, and rad."""
MODEST_LOAD = 0.2
"""Axial load where none was applied, of the load at which a bar that is guided sideways buckles."""
