"""Two columns of an instrument under each other's names."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import combinations

import numpy as np

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import (
    FORCES,
    MOMENTS,
    TRAVELS,
    TURNS,
    Mistake,
    columns_of,
    read,
    sigmas_of,
    with_readings,
)


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Every pair that reads the same quantity, where at least one of the two was read."""
    there = read(campaign)
    gauges = columns_of(campaign)[12:]
    for group in (FORCES, MOMENTS, TRAVELS, TURNS, gauges):
        for pair in combinations(group, 2):
            if any(name in there for name in pair):
                yield Mistake(
                    "exchanged",
                    pair,
                    f"{pair[0]} and {pair[1]} are exchanged",
                    f"exchange the names {pair[0]} and {pair[1]} in the header",
                    partial(_exchanged, pair=pair),
                    (Change("columns", pair[0], "is", pair[1]), Change("columns", pair[1], "is", pair[0])),
                )


def _exchanged(campaign: Campaign, pair: tuple[str, str]) -> Campaign:
    every = list(columns_of(campaign))
    order = np.arange(len(every))
    one, other = (every.index(name) for name in pair)
    order[[one, other]] = other, one
    sigmas = sigmas_of(campaign)
    # A sigma may belong to the name or to the numbers.
    sigmas[[one, other]] = np.fmax(sigmas[one], sigmas[other])
    return with_readings(campaign, lambda values: values[:, order], sigmas)
