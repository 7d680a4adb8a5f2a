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
