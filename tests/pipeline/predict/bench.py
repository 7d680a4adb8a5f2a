"""A small bench with softer bars than written, of which one test is held out, and its fit: made once for all tests."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import SENSORS, PlannedTest, bench_plan
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.predict.predicting import Fitted, fitted_to
from pipeline.simulate import bench_rig
from vjm.effects import catalogue

HIDDEN = {"modulus_error.scale": 0.97}
IDS = ("axial_held_q+0", "lateral_q+0", "axial_held_q+30", "axial_held_q+15")


def plan(times: float = 1.0) -> list[PlannedTest]:
    """Four tests, their loads and travels so many times those of the good bench."""
    return [replace(test, values=times * test.values) for test in bench_plan(8) if test.id in IDS]


@cache
def bench() -> Campaign:
    """Softer bars by three hundredths; EIz is known to two hundredths, the angle to half a milliradian."""
    whole = measure("low", bench_rig(), plan(), SENSORS, HIDDEN, 7)
    return replace(whole, tolerance={"EIz": 0.02, "q_mrad": 0.5})


@cache
def fitted() -> Fitted:
    """The model with that effect at its best fit."""
    names = ("bar_geometric_nonlinearity", "modulus_error")
    return fitted_to(bench(), Model().with_effects([catalogue()[name] for name in names]))
