"""Bars that yield on the virtual bench: elements short enough for their plastic zones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.frame import bench as frame
from pipeline.assessment.virtual import bench
from pipeline.assessment.virtual.plan import SENSORS, bench_plan
from pipeline.campaign import UniformBar
from pipeline.simulate import bench_rig

HIDDEN = {"material_yield.strain": 1e-3}
PLAN = [test for test in bench_plan(9) if test.id == "lateral_q+0"]


@pytest.mark.long
def test_finer_bars_change_little_when_they_yield(monkeypatch: pytest.MonkeyPatch) -> None:
    """Elements half as long move no reading by more than a fiftieth of what yielding does."""
    (elastic,) = bench.true_readings(bench_rig(), PLAN, {})
    (yields,) = bench.true_readings(bench_rig(), PLAN, HIDDEN)
    monkeypatch.setattr(bench, "YIELDING", 2 * bench.YIELDING)
    (finer,) = bench.true_readings(bench_rig(), PLAN, HIDDEN)
    size = sigmas(yields, elastic)
    assert size > 20.0
    assert sigmas(yields, finer) < 0.02 * size


def test_bars_of_many_elements_go_through_a_play() -> None:
    """Stocky ones are pulled by 3 kN in the first step, of which the play of 3.3 µm takes 0.1 N."""
    bar = UniformBar(EA=9e6, EIy=5e8, EIz=1.1e8, GJ=2.7e7)
    rig = replace(bench_rig(), length=224.0, width=61.0, bar=bar, fibre_y=8.3, fibre_z=10.9)
    pull = np.zeros((2, 6))
    pull[1, 0] = 2950.0
    plan = [replace(bench_plan(9)[0], q_deg=30.0, values=pull, temperature=np.full(2, 20.0))]
    hidden = {"joint_clearance.play_mm": 3.3e-3, "material_yield.strain": 0.0187}
    (tight,) = bench.true_readings(rig, plan, {"material_yield.strain": 0.0187})
    (loose,) = bench.true_readings(rig, plan, hidden)
    moved = (loose.displacement - tight.displacement)[1, 0]
    assert moved == pytest.approx(3.3e-3 / np.cos(np.radians(30.0)), rel=0.01)


def sigmas(one: frame.Readings, other: frame.Readings) -> float:
    """The largest difference of a reading."""
    moved = np.abs(one.displacement - other.displacement) / SENSORS.displacement
    pulled = np.abs(one.wrench - other.wrench) / SENSORS.wrench
    return float(max(moved.max(), pulled.max()))
