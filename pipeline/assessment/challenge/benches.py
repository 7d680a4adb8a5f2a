"""Rigs and test plans of all sizes, drawn at random; loads and travels grow with the rig."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pipeline.assessment.virtual.plan import SENSORS, PlannedTest, bench_plan
from pipeline.campaign import Noise, ParallelogramRig, UniformBar
from pipeline.simulate import REFERENCE_C, bench_rig

_EA, _EIZ, _EIY, _GJ = 6.82e6, 4.5e7, 2.0e8, 1.08e7
"""N and N·mm²: a uniform bar like the paper's (Eq. 12)."""
_REACH_Y, _REACH_Z = 2.33, 1.45
"""Outermost fibres of an I-bar in radii of gyration."""
AXIAL = tuple(f"axial_held_q{a}" for a in ("+0", "+30", "-30"))
RICH, FAIR, POOR = "rich", "fair", "poor"
HELD = 24
"""Rows of a test that is held out: of fewer the noise alone is often 1.15 sigmas."""


@dataclass(frozen=True, eq=False)
class Bench:
    """What measures: a rig, its sensors, and the tests that are done."""

    rig: ParallelogramRig
    noise: Noise
    plan: tuple[PlannedTest, ...]
    label: str


def drawn_rig(generator: np.random.Generator) -> ParallelogramRig:
    """The paper's parallelogram in one case of three, else one of other length, width and bars."""
    if generator.random() < 1.0 / 3.0:
        return bench_rig()
    length = float(generator.uniform(180.0, 500.0))
    width = length * float(generator.uniform(0.2, 0.4))
    axial, thick = generator.uniform(0.5, 2.0), generator.uniform(0.7, 1.6)
    EA, EIz, EIy = _EA * axial, _EIZ * axial * thick**2, _EIY * axial * thick**2
    bar = UniformBar(EA=EA, EIy=EIy, EIz=EIz, GJ=_GJ * axial * thick**2)
    return ParallelogramRig(
        length=round(length, 1),
        width=round(width, 1),
        bar=bar,
        gravity=(0.0, 0.0, -1.0),
        reference_temperature=REFERENCE_C,
        fibre_y=_REACH_Y * float(np.sqrt(EIz / EA)),
        fibre_z=_REACH_Z * float(np.sqrt(EIy / EA)),
    )


def drawn_noise(generator: np.random.Generator) -> Noise:
    """Sensors half as good to three times better than those of the good bench."""
    factor = float(np.exp(generator.uniform(np.log(1.0 / 3.0), np.log(2.0))))
    return replace(
        SENSORS,
        displacement=factor * SENSORS.displacement,
        wrench=factor * SENSORS.wrench,
        gauges=factor * SENSORS.gauges,
    )


def whole_plan(steps: int) -> tuple[PlannedTest, ...]:
    """All tests of the good bench, the fitted ones of so many steps, those held out of `HELD`."""
    plans = bench_plan(steps), bench_plan(HELD)
    return tuple(held if test.holdout else test for test, held in zip(*plans, strict=True))


def drawn_plan(generator: np.random.Generator, label: str, steps: int) -> tuple[PlannedTest, ...]:
    """All tests, half of them, or three; those held out are always done."""
    every = whole_plan(steps)
    fitted = [test for test in every if not test.holdout]
    count = {RICH: len(fitted), FAIR: len(fitted) // 2, POOR: 3}[label]
    chosen = set(generator.choice(len(fitted), count, replace=False).tolist())
    kept = {fitted[k].id for k in chosen}
    return tuple(test for test in every if test.holdout or test.id in kept)
