"""Tables as somebody writes them by mistake: twelve kinds, made without the code that looks for mistakes.

A mistake is made where it shows: of a sign, an exchange and a zero in a column that reads far more than its noise, of
angles where some are not zero. `Made.words` is what the look has to say.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data
from pipeline.campaign.names import channel_columns

Array = NDArray[np.float64]
SHIFTS, TURNS = ("x_mm", "y_mm", "z_mm"), ("rx_rad", "ry_rad", "rz_rad")
FORCES, MOMENTS = ("fx_N", "fy_N", "fz_N"), ("mx_Nmm", "my_Nmm", "mz_Nmm")
COLUMNS = (*SHIFTS, *TURNS, *FORCES, *MOMENTS)
LOUD = 100.0
"""Sigmas that a column reads at least, root mean square, for its sign or its place to show."""
FARTHEST = 10.0
"""Spans of a column up to which an origin may lie away."""
LEAST_TURN = 10.0
"""Degrees of the largest angle, at least, where angles are written in radians."""


@dataclass(frozen=True)
class Made:
    """A table with a mistake. words: what names it, none where the readings do not show it."""

    table: Campaign
    words: str


Make = Callable[[Campaign, np.random.Generator], Made | None]


def written(campaign: Campaign, change: Callable[[Array], Array]) -> Campaign:
    """Twelve columns (N, 12) of each test written otherwise."""

    def data(old: Data) -> Data:
        new = change(np.hstack([old.displacement, old.wrench]))
        return replace(old, displacement=new[:, :6], wrench=new[:, 6:])

    return replace(campaign, tests=tuple(replace(test, data=data(test.data)) for test in campaign.tests))


def over(campaign: Campaign, divisor: float, columns: Sequence[str]) -> Campaign:
    """Columns written in a unit of that many."""
    factors = np.where(np.isin(COLUMNS, columns), 1.0 / divisor, 1.0)
    return written(campaign, lambda values: values * factors)


def shifted(campaign: Campaign, by: float, column: str) -> Campaign:
    """A column that was not zeroed."""
    more = np.where(np.isin(COLUMNS, column), by, 0.0)
    return written(campaign, lambda values: values + more)


def exchanged(campaign: Campaign, one: str, other: str) -> Campaign:
    """Two columns under each other's names."""
    order = list(range(len(COLUMNS)))
    a, b = COLUMNS.index(one), COLUMNS.index(other)
    order[a], order[b] = b, a
    return written(campaign, lambda values: values[:, order])


def in_radians(campaign: Campaign) -> Campaign:
    """The angle of every test in radians."""
    tests = (replace(test, q_deg=float(np.radians(test.q_deg))) for test in campaign.tests)
    return replace(campaign, tests=tuple(tests))


def _unit(divisor: float, columns: Sequence[str], words: str) -> Make:
    return lambda campaign, _: Made(over(campaign, divisor, columns), words)


def _loud(campaign: Campaign, among: Sequence[str]) -> list[str]:
    """Columns that read far more than their noise."""
    readings = np.vstack([test.data.readings for test in campaign.tests])
    sigmas = dict(zip(channel_columns(campaign.gauges), campaign.noise.sigmas, strict=True))
    sizes = np.sqrt(np.nanmean(readings[:, :12] ** 2, axis=0))
    return [
        name
        for name, size in zip(COLUMNS, sizes, strict=True)
        if name in among and size > LOUD * sigmas[name]
    ]


def _sign(among: Sequence[str]) -> Make:
    def make(campaign: Campaign, generator: np.random.Generator) -> Made | None:
        some = _loud(campaign, among)
        if not some:
            return None
        name = str(generator.choice(some))
        return Made(over(campaign, -1.0, [name]), f"{name} has the wrong sign")

    return make


def _exchanged(campaign: Campaign, generator: np.random.Generator) -> Made | None:
    some = _loud(campaign, (*SHIFTS, *FORCES, *MOMENTS))
    if not some:
        return None
    name = str(generator.choice(some))
    alike = next(group for group in (SHIFTS, FORCES, MOMENTS) if name in group)
    other = str(generator.choice([it for it in alike if it != name]))
    one, two = sorted((name, other), key=COLUMNS.index)
    return Made(exchanged(campaign, one, two), f"{one} and {two} are exchanged")


def _not_zeroed(campaign: Campaign, generator: np.random.Generator) -> Made | None:
    some = _loud(campaign, SHIFTS)
    if not some:
        return None
    name = str(generator.choice(some))
    readings = np.vstack([test.data.readings for test in campaign.tests])[:, COLUMNS.index(name)]
    away = float(generator.uniform(1.0, FARTHEST)) * float(np.ptp(readings[np.isfinite(readings)]))
    words = f"{name} was not zeroed: absolute positions or loads"
    return Made(shifted(campaign, away, name), words)


def _radians(campaign: Campaign, _: np.random.Generator) -> Made | None:
    if max(abs(test.q_deg) for test in campaign.tests) < LEAST_TURN:
        return None
    return Made(in_radians(campaign), "q_deg is in radians")


KINDS: Mapping[str, Make] = {
    "forces in kgf": _unit(9.80665, FORCES, "all forces are in kgf"),
    "forces in lbf": _unit(4.4482216, FORCES, "all forces are in lbf"),
    "forces converted twice": _unit(
        1.0 / 9.80665, FORCES, "all forces were converted to kgf the wrong way round or twice"
    ),
    "moments in N·m": _unit(1000.0, MOMENTS, "all moments are in N·m"),
    "displacements in inches": _unit(25.4, SHIFTS, "all displacements are in inches"),
    "displacements in m": _unit(1000.0, SHIFTS, "all displacements are in m"),
    "rotations in degrees": _unit(float(np.radians(1.0)), TURNS, "all rotations are in degrees"),
    "sign of a force or moment": _sign((*FORCES, *MOMENTS)),
    "sign of a displacement or rotation": _sign((*SHIFTS, *TURNS)),
    "two columns exchanged": _exchanged,
    "not zeroed": _not_zeroed,
    "angles in radians": _radians,
}
"""By what they are called on the page."""
