"""A sensor that was not zeroed: its readings begin far from zero, as positions do."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import (
    GROUPS,
    Array,
    Mistake,
    columns_of,
    sigmas_of,
    verb,
    with_readings,
)


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Every column that begins far from zero in each of its tests by about as much."""
    far = [name for name, begins in _begins(campaign, criteria.doctor_plain).items() if begins]
    named: dict[str, tuple[str, ...]] = {name: (name,) for name in far}
    for words, names in GROUPS.items():
        mine = tuple(name for name in names if name in far)
        if len(mine) > 1:
            named[words] = mine
    for name, columns in named.items():
        yield Mistake(
            "zero",
            columns,
            f"{name} {verb(columns, 'was', 'were')} not zeroed: absolute positions or loads",
            f'subtract the reading of the unloaded rig from {", ".join(columns)}, or write zero = "first_row" in '
            "the tests whose first row is unloaded",
            partial(_from_first, columns=columns),
            tuple(Change("columns", each, "zero", "first_row") for each in columns),
        )


def _begins(campaign: Campaign, plain: float) -> dict[str, bool]:
    sigmas, names = sigmas_of(campaign), columns_of(campaign)
    firsts = np.array([test.data.readings[0] for test in campaign.tests if test.zero == "nominal"])
    if not firsts.size:
        return {}
    size = np.abs(np.nan_to_num(firsts))
    limit = plain * np.where(np.isfinite(sigmas), sigmas, np.inf)
    there = np.isfinite(firsts)
    every = np.all((size > limit) | ~there, axis=0) & there.any(axis=0)
    return dict(zip(names, every.tolist(), strict=True))


def _from_first(campaign: Campaign, columns: tuple[str, ...]) -> Campaign:
    mine = np.isin(columns_of(campaign), columns)

    def less(values: Array) -> Array:
        return np.asarray(values - np.where(mine, np.nan_to_num(values[:1]), 0.0))

    return with_readings(campaign, less, sigmas_of(campaign) * np.where(mine, np.sqrt(2.0), 1.0))
