"""A small campaign on the Orthoglide: two postures, four steps a test, controls of several kinds, no noise in it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pipeline.assessment.virtual.manipulator import NOISE
from pipeline.campaign import Campaign, Data, ManipulatorRig, Noise, Test
from pipeline.manipulator.description import read

POINTS = ((0.0, 0.0, 0.0), (50.0, -40.0, 60.0))
FREE = ("force",) * 6
SLIDING = ("displacement", "force", "force", "force", "force", "displacement")
STEPS = np.array([0.5, 1.0, 0.2, -0.4])
LOADS = np.array([150.0, -80.0, 60.0, 2e3, -1e3, 3e3])
WAY = np.array([0.03, 0.0, 0.0, 0.0, 0.0, 5e-4])


def rig(weight: float = 0.0) -> ManipulatorRig:
    described = read("orthoglide").manipulator
    gravity = (0.0, 0.0, -2.0) if weight else None
    return ManipulatorRig(
        length=described.length,
        gravity=gravity,
        platform_weight=weight,
        manipulator=described,
        file="orthoglide",
    )


def campaign(weight: float = 0.0, noise: Noise = NOISE) -> Campaign:
    base = rig(weight)
    rigs = [replace(base, at=point) for point in POINTS]
    tests = [
        test("free_0", rigs[0], FREE),
        test("sliding_0", rigs[0], SLIDING),
        test("free_1", rigs[1], FREE),
    ]
    return Campaign("small", base, noise, (), tuple(tests))


def test(name: str, at: ManipulatorRig, control: tuple[str, ...]) -> Test:
    """Readings of what is prescribed; what is measured beside it is zero and finite."""
    data = Data(
        np.arange(STEPS.size),
        STEPS[:, None] * np.where([by == "displacement" for by in control], WAY, 0.0),
        STEPS[:, None] * np.where([by == "force" for by in control], LOADS, 0.0),
        np.zeros((STEPS.size, 0)),
        None,
        np.zeros(STEPS.size, dtype=np.int64),
    )
    return Test(name, 0.0, "fit", control, "nominal", at, data)


test.__test__ = False  # type: ignore[attr-defined]
