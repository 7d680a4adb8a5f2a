"""The tests of a campaign in an order that hangs on their names alone, and when each was done."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Campaign, Test


def by_name(campaign: Campaign) -> Campaign:
    """The campaign with its tests by their ids, in which numbers count as numbers, each with its run.

    Sums over all rows are the same to the last digit then, in whatever order tests are written.
    """
    runs = np.argsort(run_order(campaign.tests))
    tests = [replace(test, run=int(run)) for test, run in zip(campaign.tests, runs, strict=True)]
    return replace(campaign, tests=tuple(sorted(tests, key=_name)))


def run_order(tests: Sequence[Test]) -> NDArray[np.int64]:
    """(T,) numbers of the tests in the order in which they were done; those that do not say so come last, as they
    stand."""
    runs = [(test.run is None, test.run or 0, number) for number, test in enumerate(tests)]
    return np.array([number for *_, number in sorted(runs)], dtype=np.int64)


def _name(test: Test) -> tuple[list[str | int], str]:
    return [int(part) if k % 2 else part for k, part in enumerate(re.split(r"(\d+)", test.id))], test.id
