"""One discrete mistake: what it is in words, what mends it, and the campaign without it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES, channel_columns
from pipeline.inference.sensor_noise import from_roughness

Array = NDArray[np.float64]
Mended = Callable[[Campaign], Campaign]


@dataclass(frozen=True, eq=False)
class Mistake:
    """kind: of mistake. columns: that have it. words: as a guess; mend: what to do in the table or the file. mended:
    the campaign without it. changes: of campaign.toml that do so, none where only the table can be mended."""

    kind: str
    columns: tuple[str, ...]
    words: str
    mend: str
    mended: Mended
    changes: tuple[Change, ...] = ()


def columns_of(campaign: Campaign) -> tuple[str, ...]:
    """All columns of readings, in the order of the channels."""
    return tuple(channel_columns(campaign.gauges))


def read(campaign: Campaign) -> list[str]:
    """Columns that have readings which are not all zero."""
    there = np.zeros(len(columns_of(campaign)), dtype=bool)
    for test in campaign.tests:
        there |= np.any(np.nan_to_num(test.data.readings) != 0.0, axis=0)
    return [name for name, known in zip(columns_of(campaign), there, strict=True) if known]


def with_readings(
    campaign: Campaign, change: Callable[[Array], Array], sigmas: Array | None = None
) -> Campaign:
    """The campaign with the readings (N, C) of each test changed; sigmas: (C,) default as they are."""
    tests = []
    for test in campaign.tests:
        new = change(test.data.readings)
        data = replace(test.data, displacement=new[:, :6], wrench=new[:, 6:12], gauges=new[:, 12:])
        tests.append(replace(test, data=data))
    noise = campaign.noise
    if sigmas is not None:
        noise = noise.of(sigmas)
    return replace(campaign, tests=tuple(tests), noise=noise)


def sigmas_of(campaign: Campaign) -> Array:
    """(C,) of all channels."""
    return campaign.noise.sigmas


def times(campaign: Campaign, columns: tuple[str, ...], factor: float) -> Campaign:
    """Columns times a factor. A sigma goes with them where the readings scatter by it as they are; it stays where they
    scatter by it once they are multiplied, and where too few readings tell that."""
    every = columns_of(campaign)
    factors = np.where(np.isin(every, columns), factor, 1.0)
    sigmas = sigmas_of(campaign)
    size = abs(factor)
    for channel in np.flatnonzero(np.abs(factors) != 1.0):
        scatter, sigma = _scatters(campaign)[channel], sigmas[channel]
        # What was prescribed in steps that were chosen counts as exact, in whatever unit; what has no sigma needs none.
        if scatter is None or not sigma > 0.0:
            continue
        if abs(np.log(scatter / sigma)) < abs(np.log(size * scatter / sigma)):
            sigmas[channel] = sigma * size
    return with_readings(campaign, lambda values: values * factors, sigmas)


@lru_cache(maxsize=2)
def _scatters(campaign: Campaign) -> tuple[float | None, ...]:
    """Of the readings of every channel beyond a smooth path, in their unit; None where that cannot be told."""
    out = []
    every = [test.data.readings for test in campaign.tests]
    for channel in range(every[0].shape[1]):
        columns = [values[np.isfinite(values[:, channel]), channel] for values in every]
        paths = [(np.arange(column.size, dtype=float), column) for column in columns]
        out.append(from_roughness(paths).value or None)
    return tuple(out)


FORCES, MOMENTS, TRAVELS, TURNS = WRENCHES[:3], WRENCHES[3:], DISPLACEMENTS[:3], DISPLACEMENTS[3:]
GROUPS = {
    "all forces": FORCES,
    "all moments": MOMENTS,
    "all forces and moments": WRENCHES,
    "all displacements": TRAVELS,
    "all rotations": TURNS,
}
ALIKE = {"_mm": "readings in mm", "_rad": "readings in rad"}
"""By the end of a column's name: of platform and gauges together."""


def groups(campaign: Campaign) -> dict[str, tuple[str, ...]]:
    """Each column that was read, and groups of several, by what to call them."""
    there = read(campaign)
    out: dict[str, tuple[str, ...]] = {name: (name,) for name in there}
    # Dials on the bars are of the same make as those at the platform.
    every = {f"all {words}": [name for name in there if name.endswith(unit)] for unit, words in ALIKE.items()}
    for words, names in (GROUPS | every).items():
        mine = tuple(name for name in names if name in there)
        if len(mine) > 1 and mine not in out.values():
            out[words] = mine
    return out


def verb(columns: tuple[str, ...], one: str, many: str) -> str:
    """That agrees with how many columns there are."""
    return one if len(columns) == 1 else many
