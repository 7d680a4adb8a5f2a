"""A bar that is to be tested: what will be prescribed stands in the campaign, nothing is read yet."""

from __future__ import annotations

import numpy as np

from pipeline.campaign import BarRig, Campaign, Data, Noise, Test
from vjm import paper

STEPS = 4
NOISE = Noise(
    displacement=np.array([1e-3] * 3 + [2e-5] * 3),
    wrench=np.array([0.5] * 3 + [50.0] * 3),
    gauges=np.zeros(0),
)


def unmeasured() -> Campaign:
    """Pushed along and across."""
    rig = BarRig(length=310.0, bar_stiffness=paper.BAR_STIFFNESS)
    return Campaign(
        "ahead", rig, NOISE, (), (_pushed("axial", rig, 0, 1e3), _pushed("lateral", rig, 1, 10.0))
    )


def _pushed(name: str, rig: BarRig, axis: int, force: float) -> Test:
    wrench = np.zeros((STEPS, 6))
    wrench[:, axis] = np.linspace(0.0, force, STEPS)
    data = Data(
        np.arange(STEPS),
        np.full((STEPS, 6), np.nan),
        wrench,
        np.zeros((STEPS, 0)),
        None,
        np.zeros(STEPS, dtype=np.int64),
    )
    return Test(name, 0.0, "fit", ("force",) * 6, "nominal", rig, data)
