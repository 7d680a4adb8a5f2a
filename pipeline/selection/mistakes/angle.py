"""Angles of the bars in radians where degrees are written."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pipeline.campaign import Campaign
from pipeline.campaign.edited import Change
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Mistake

LARGEST = float(np.pi / 2.0)


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Where no angle is larger than those of radians, and one is not zero."""
    angles = [abs(test.q_deg) for test in campaign.tests]
    if 0.0 < max(angles, default=0.0) <= LARGEST:
        yield Mistake(
            "angle",
            ("q_deg",),
            "q_deg is in radians",
            "write q_deg of every test in degrees: multiply it by 57.29578",
            _in_degrees,
            tuple(_changes(campaign)),
        )


def _changes(campaign: Campaign) -> Iterator[Change]:
    """Of every angle that is not zero, to the digits that somebody would write."""
    for test in _in_degrees(campaign).tests:
        if test.q_deg:
            yield Change("tests", test.id, "q_deg", float(f"{test.q_deg:.10g}"))


def _in_degrees(campaign: Campaign) -> Campaign:
    tests = tuple(replace(test, q_deg=float(np.degrees(test.q_deg))) for test in campaign.tests)
    return replace(campaign, tests=tests)
