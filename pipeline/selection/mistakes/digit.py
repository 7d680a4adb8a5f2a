"""A decimal point that slipped in one reading: it is ten or a hundred times what its neighbours are."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from pipeline.campaign import Campaign, Test
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Array, Mistake, columns_of, sigmas_of

POWERS = (10.0, 100.0)
OTHERS = 3
"""Readings of the column in the test beside it, at least."""


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Each reading that stands out in its test, and is among the others once it is divided."""
    sigmas = np.nan_to_num(sigmas_of(campaign))
    for number, test in enumerate(campaign.tests):
        for channel, name in enumerate(columns_of(campaign)):
            values = test.data.readings[:, channel]
            found = _slipped(values, float(sigmas[channel]), criteria)
            if found is None:
                continue
            row, power = found
            step, right = int(test.data.steps[row]), float(values[row] / power)
            yield Mistake(
                "digit",
                (name,),
                f"{name} of test {test.id}, step {step}, is {power:g} times too large: its decimal point slipped",
                f"write {right:.6g} instead of {values[row]:.6g} there if that is what was read, or leave it empty",
                partial(_divided, number=number, row=row, channel=channel, power=power),
            )


def _slipped(values: Array, sigma: float, criteria: Criteria) -> tuple[int, float] | None:
    """Row of the one reading that stands out of others of which the largest is plainly no noise, and what it is to be
    divided by; None where there is none. Where the others are noise, any knocked reading is ten times that."""
    size = np.nan_to_num(np.abs(values))
    if np.count_nonzero(np.isfinite(values)) <= OTHERS:
        return None
    row = int(np.argmax(size))
    rest = np.delete(values, row)
    rest = rest[np.isfinite(rest)]
    most = float(np.max(np.abs(rest)))
    if most < criteria.doctor_plain * sigma or not 0.0 < criteria.doctor_apart * most < size[row]:
        return None
    near = [k for k in (row - 1, row + 1) if 0 <= k < values.size and np.isfinite(values[k])]
    beside = float(np.mean(values[near])) if near else 0.0
    power = min(POWERS, key=lambda it: abs(values[row] / it - beside))
    return (row, power) if abs(values[row] / power) <= criteria.doctor_apart * most else None


def _divided(campaign: Campaign, number: int, row: int, channel: int, power: float) -> Campaign:
    tests = list(campaign.tests)
    tests[number] = _with(tests[number], row, channel, power)
    return replace(campaign, tests=tuple(tests))


def _with(test: Test, row: int, channel: int, power: float) -> Test:
    new = test.data.readings.copy()
    new[row, channel] /= power
    data = replace(test.data, displacement=new[:, :6], wrench=new[:, 6:12], gauges=new[:, 12:])
    return replace(test, data=data)
