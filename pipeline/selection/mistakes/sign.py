"""A column or an instrument that counts the other way: the wrench on the cell instead of that on the platform."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Mistake, groups, times, verb


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Every column and group the other way."""
    for name, columns in groups(campaign).items():
        yield Mistake(
            "sign",
            columns,
            f"{name} {verb(columns, 'has', 'have')} the wrong sign",
            f"multiply {', '.join(columns)} by -1",
            partial(times, columns=columns, factor=-1.0),
            tuple(Change("columns", each, "sign") for each in columns),
        )
