"""Tables as somebody would have written them by mistake, made without the code that looks for mistakes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.mistaken import tables
from pipeline.campaign import Campaign

Floats = NDArray[np.float64]
Wrong = Callable[[Campaign], Campaign]
FORCES, MOMENTS = tables.FORCES, tables.MOMENTS
angles_in_radians, changed = tables.in_radians, tables.written


def over(divisor: float, *columns: str) -> Wrong:
    """Columns in a unit of that many."""
    return lambda campaign: tables.over(campaign, divisor, columns)


def exchanged(one: str, other: str) -> Wrong:
    """Two columns under each other's names."""
    return lambda campaign: tables.exchanged(campaign, one, other)


def shifted(by: float, column: str) -> Wrong:
    """A column that was not zeroed."""
    return lambda campaign: tables.shifted(campaign, by, column)


def backwards(campaign: Campaign) -> Campaign:
    """The last step first."""
    return changed(campaign, lambda values: values[::-1])


def with_bars(campaign: Campaign, stiffness: Floats) -> Campaign:
    """Another 6x6 written of the bars."""
    rig = replace(campaign.rig, bar_stiffness=stiffness)
    return replace(campaign, rig=rig, tests=tuple(replace(test, rig=rig) for test in campaign.tests))


def section_turned(campaign: Campaign) -> Campaign:
    """What bends about y bends about z, entry by entry."""
    old = campaign.rig.stiffness
    new = old.copy()
    new[1, 1], new[2, 2], new[4, 4], new[5, 5] = old[2, 2], old[1, 1], old[5, 5], old[4, 4]
    new[1, 5] = new[5, 1] = -old[2, 4]
    new[2, 4] = new[4, 2] = -old[1, 5]
    return with_bars(campaign, new)
