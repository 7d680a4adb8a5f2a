"""Tables as somebody would have written them by mistake, made without the code that looks for mistakes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data

Floats = NDArray[np.float64]
Wrong = Callable[[Campaign], Campaign]
COLUMNS = [
    *("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad"),
    *("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm"),
]
FORCES, MOMENTS = ("fx_N", "fy_N", "fz_N"), ("mx_Nmm", "my_Nmm", "mz_Nmm")


def changed(campaign: Campaign, change: Callable[[Floats], Floats]) -> Campaign:
    """Twelve columns (N, 12) of each test changed."""

    def data(old: Data) -> Data:
        new = change(np.hstack([old.displacement, old.wrench]))
        return replace(old, displacement=new[:, :6], wrench=new[:, 6:])

    return replace(campaign, tests=tuple(replace(test, data=data(test.data)) for test in campaign.tests))


def over(divisor: float, *columns: str) -> Wrong:
    """Columns in a unit of that many."""
    factors = np.array([1.0 / divisor if name in columns else 1.0 for name in COLUMNS])
    return lambda campaign: changed(campaign, lambda values: values * factors)


def exchanged(one: str, other: str) -> Wrong:
    """Two columns under each other's names."""
    order = list(range(12))
    a, b = COLUMNS.index(one), COLUMNS.index(other)
    order[a], order[b] = b, a
    return lambda campaign: changed(campaign, lambda values: values[:, order])


def shifted(by: float, column: str) -> Wrong:
    """A column that was not zeroed."""
    more = np.array([by if name == column else 0.0 for name in COLUMNS])
    return lambda campaign: changed(campaign, lambda values: values + more)


def backwards(campaign: Campaign) -> Campaign:
    """The last step first."""
    return changed(campaign, lambda values: values[::-1])


def angles_in_radians(campaign: Campaign) -> Campaign:
    """q_deg of every test in radians."""
    tests = (replace(test, q_deg=float(np.radians(test.q_deg))) for test in campaign.tests)
    return replace(campaign, tests=tuple(tests))


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
