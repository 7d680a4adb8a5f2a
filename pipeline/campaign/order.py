"""The tests of a campaign in an order that hangs on their names alone, and when each was done."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Campaign, Test


def by_name(campaign: Campaign) -> Campaign:
    """The campaign with its tests by their ids, numbers in them as numbers, each with the turn in which it was done.

    Sums over all rows are the same to the last digit then, in whatever order tests are written.
    """
    turns = np.argsort(turns_of(campaign.tests))
    tests = [replace(test, turn=int(turn)) for test, turn in zip(campaign.tests, turns, strict=True)]
    return replace(campaign, tests=tuple(sorted(tests, key=_name)))


def turns_of(tests: Sequence[Test]) -> NDArray[np.int64]:
    """(T,) numbers of the tests, the one that was done first before the others; those without a turn come last, as they
    stand."""
    turns = [(test.turn is None, test.turn or 0, number) for number, test in enumerate(tests)]
    return np.array([number for *_, number in sorted(turns)], dtype=np.int64)


def _name(test: Test) -> tuple[list[str | int], str]:
    parts = re.split(r"(\d+)", test.id)
    return [int(part) if k % 2 else part for k, part in enumerate(parts)], test.id
