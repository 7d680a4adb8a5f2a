"""A campaign before it is measured: every sensor whose sigma is known reads at every step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Test

Array = NDArray[np.float64]


def foreseen(campaign: Campaign) -> tuple[Campaign, tuple[str, ...]]:
    """The campaign with readings, zeros, in the tests that have none yet, and the names of those tests.

    A test is not measured yet where nothing was read but what it prescribes.
    """
    tests = [_read(test, campaign) if _unmeasured(test) else test for test in campaign.tests]
    named = tuple(t.id for t, old in zip(tests, campaign.tests, strict=True) if t is not old)
    return replace(campaign, tests=tuple(tests)), named


def _unmeasured(test: Test) -> bool:
    d = test.data
    by_force = np.array([by == "force" for by in test.control])
    by_gauge = np.array([by not in ("force", "displacement", "support") for by in test.control])
    others = np.where(by_force, d.displacement, d.wrench)
    return not np.isfinite(others).any() and bool(by_gauge.any() or not np.isfinite(d.gauges).any())


def _read(test: Test, campaign: Campaign) -> Test:
    d, noise = test.data, campaign.noise
    displacement, wrench, gauges = (
        _filled(values, sigma)
        for values, sigma in (
            (d.displacement, noise.displacement),
            (d.wrench, noise.wrench),
            (d.gauges, noise.gauges),
        )
    )
    return replace(test, data=replace(d, displacement=displacement, wrench=wrench, gauges=gauges))


def _filled(values: Array, sigma: Array) -> Array:
    return np.where(np.isnan(values) & np.isfinite(sigma[: values.shape[1]]), 0.0, values)
