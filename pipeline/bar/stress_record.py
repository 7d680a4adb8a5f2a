"""The record of the stresses of a bar under unit loads."""

from __future__ import annotations

from pydantic import Field

from pipeline.record import Record

LOADS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
"""At the tip point, base held; N and N·mm."""


class Peak(Record):
    """The most stressed point of a part of the bar under a unit load; with yield stresses, the first to yield."""

    stress: float
    """Von Mises, MPa per N of a force, per N·mm of a moment."""
    at_mm: list[float]
    """(3,) bar frame."""
    first_yield: float | None = None
    """N or N·mm, either sign; None where its material has no yield stress."""
    change: float | None = None
    """Of the stress from the mesh before to this one, relative; None where there is one mesh."""


class UnitLoad(Record):
    """Peaks under one unit load."""

    load: str
    """Fx .. Mz."""
    body: Peak
    """Away from the ends."""
    ends: Peak
    """Within `ends_reach_mm` of a tied surface: it depends on how the ends are tied."""


class Stresses(Record):
    """Von Mises' stress of a straight bar, linear elastic, base held, unit loads at its tip point."""

    loads: list[UnitLoad]
    ends_reach_mm: dict[str, float] = Field(default_factory=dict)
    """How far base and tip reach: half the largest extent of the tied surface."""
    yield_MPa: float | None = None
    """The lowest yield stress of its materials."""

    def of(self, load: str) -> UnitLoad:
        """The peaks under a load."""
        return next(each for each in self.loads if each.load == load)
