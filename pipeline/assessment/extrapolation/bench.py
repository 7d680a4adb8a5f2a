"""A case of the challenge measured for this study: what is fitted, with noise, and what is to be predicted, exactly."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.cases import Case, case
from pipeline.assessment.challenge.outcome import SHARES, campaign_of, each_alone, shows
from pipeline.assessment.virtual.bench import read_out, true_readings
from pipeline.assessment.virtual.plan import GAUGES, PlannedTest
from pipeline.campaign import Campaign
from pipeline.inference.driving import driving
from pipeline.inference.load_cases import LoadCases, load_cases

Mask = NDArray[np.bool_]
BEYOND = 1.5
"""Times the fitted loads and travels."""
EDGE = 0.01
"""Of the fitted range, by which a row must lie beyond it: at its edge nothing is extrapolated."""


@dataclass(frozen=True, eq=False)
class Measured:
    """share: of the loads, that the bench bears even 1.5 times. campaign: the fitted tests with their sensors' noise.
    asked: what is to be predicted, read without noise, R rows. inside, outside: (R,) those that count. sizes: mu,
    sigmas by which each hidden effect shows in the campaign."""

    case: Case
    share: float
    campaign: Campaign
    asked: LoadCases
    inside: Mask
    outside: Mask
    sizes: dict[str, float]


def measured(number: int) -> Measured:
    """The case of that number. RuntimeError where its bench bears no share of the loads."""
    for share in SHARES:
        it = case(number, share)
        fitted = tuple(test for test in it.bench.plan if not test.holdout)
        try:
            return measured_case(replace(it, bench=replace(it.bench, plan=fitted)), share)
        except RuntimeError as error:
            last = error
    raise RuntimeError(f"case {number} at {SHARES[-1]:g} of its loads: {last}")


def measured_case(it: Case, share: float = 1.0) -> Measured:
    """The bench of a case, all of whose tests are fitted. RuntimeError where it does not bear 1.5 times the loads."""
    plan = it.bench.plan
    apart, far = [between(test) for test in plan], [beyond(test) for test in plan]
    asked = load_cases(_exact(it, (*apart, *far)))
    without = true_readings(it.bench.rig, plan, {}, GAUGES)
    found = true_readings(it.bench.rig, plan, it.hidden, GAUGES) if it.hidden else without
    inside, outside = _counted(asked, len(plan))
    return Measured(
        it, share, campaign_of(it, found, it.seed), asked, inside, outside, _sizes(it, found, without)
    )


def between(test: PlannedTest) -> PlannedTest:
    """The same way with a step in the middle of every two: odd steps are new, turning points are the same."""
    count = len(test.values)
    steps = np.arange(2 * count - 1) / 2.0
    values = np.column_stack([np.interp(steps, np.arange(count), each) for each in test.values.T])
    heat = np.interp(steps, np.arange(count), test.temperature)
    return replace(test, id=f"{test.id}_between", values=values, temperature=heat)


def beyond(test: PlannedTest) -> PlannedTest:
    """1.5 times the loads and travels, at the same temperatures."""
    return replace(test, id=f"{test.id}_beyond", values=BEYOND * test.values)


def _exact(it: Case, plan: tuple[PlannedTest, ...]) -> Campaign:
    found: list[Readings] = true_readings(it.bench.rig, plan, it.hidden, GAUGES)
    return read_out("asked", it.bench.rig, plan, it.bench.noise, None, found, GAUGES)


def _counted(asked: LoadCases, count: int) -> tuple[Mask, Mask]:
    """Steps between the fitted ones, and steps beyond the range of what drives the test."""
    inside, outside = np.zeros((2, len(asked.test)), dtype=bool)
    tests, gauges = asked.campaign.tests, asked.campaign.gauges
    for k, (near, far) in enumerate(zip(tests[:count], tests[count:], strict=True)):
        rows = np.flatnonzero(asked.test == k)
        inside[rows[1::2]] = True
        _, fitted = driving(near, gauges)
        _, values = driving(far, gauges)
        margin = EDGE * np.ptp(fitted)
        out = (values > fitted.max() + margin) | (values < fitted.min() - margin)
        outside[np.flatnonzero(asked.test == count + k)[out]] = True
    return inside, outside


def _sizes(it: Case, found: list[Readings], without: list[Readings]) -> dict[str, float]:
    alone = each_alone(it, found, it.bench.rig)
    return {name: float(np.linalg.norm(shows(it, only, without))) for name, only in alone.items()}
