"""Bars that yield on the virtual bench: elements short enough for their plastic zones."""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame import bench as frame
from pipeline.simulate import bench_rig
from pipeline.virtual import bench
from pipeline.virtual.plan import SENSORS, bench_plan

HIDDEN = {"material_yield.strain": 1e-3}
PLAN = [test for test in bench_plan(9) if test.id == "lateral_q+0"]


def test_finer_bars_change_little_when_they_yield(monkeypatch: pytest.MonkeyPatch) -> None:
    """Elements half as long move no reading by more than a fiftieth of what yielding does."""
    (elastic,) = bench.true_readings(bench_rig(), PLAN, {})
    (yields,) = bench.true_readings(bench_rig(), PLAN, HIDDEN)
    monkeypatch.setattr(bench, "YIELDING", 2 * bench.YIELDING)
    (finer,) = bench.true_readings(bench_rig(), PLAN, HIDDEN)
    size = sigmas(yields, elastic)
    assert size > 20.0
    assert sigmas(yields, finer) < 0.02 * size


def sigmas(one: frame.Readings, other: frame.Readings) -> float:
    """The largest difference of a reading."""
    moved = np.abs(one.displacement - other.displacement) / SENSORS.displacement
    pulled = np.abs(one.wrench - other.wrench) / SENSORS.wrench
    return float(max(moved.max(), pulled.max()))
