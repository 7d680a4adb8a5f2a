"""The truth of faulty sensors has formulas of its own, which agree with those of the models of faults."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.manipulator import measure_manipulator, plan
from pipeline.assessment.virtual.plan import GAUGES, bench_plan
from pipeline.assessment.virtual.sensors import as_read, of_sensors
from pipeline.errors import InputError
from pipeline.inference.load_cases import load_cases
from pipeline.simulate import bench_rig
from tests.pipeline.inference.manipulators import rig
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue, effect_of

VALUES = {
    "sensor_gain@fy_N": {"share": -0.02},
    "sensor_drift@mid_mm": {"size": 0.03},
    "sensor_settling@rz_rad": {"size": 1e-4, "steps": 2.3},
    "sensor_lag@x_mm": {"keeps": 0.15},
    "sensor_backlash@y_mm": {"gap": 0.02, "start": 0.4},
    "sensor_backlash@fy_N": {"gap": 9.0, "start": -1.0},
    "sensor_cross_talk@mx_Nmm<fx_N": {"share": 0.04},
}


def paths(effect: str) -> dict[str, float]:
    return {f"{effect}.{name}": value for name, value in VALUES[effect].items()}


@pytest.mark.parametrize("name", VALUES)
def test_both_have_the_same_error(name: str) -> None:
    campaign = bench()
    every = [np.hstack([t.data.displacement, t.data.wrench, t.data.gauges]) for t in campaign.tests]
    read = np.vstack(as_read(every, paths(name), campaign.gauges))
    there, fault = np.vstack(every), effect_of(name, catalogue())
    rows = load_cases(campaign).rows
    own = rows.columns.index(fault.column)  # type: ignore[attr-defined]
    error = fault.error(there, rows, VALUES[name])  # type: ignore[attr-defined]
    assert np.abs(error).max() > 0.0
    np.testing.assert_allclose(read[:, own] - there[:, own], error, atol=1e-12 * np.abs(error).max())
    others = np.delete(read, own, axis=1)
    np.testing.assert_array_equal(others, np.delete(there, own, axis=1))


def test_faults_of_two_sensors_are_each_of_what_is_there() -> None:
    both = paths("sensor_cross_talk@mx_Nmm<fx_N") | {"sensor_gain@fx_N.share": 0.5}
    one = [np.random.default_rng(2).normal(size=(6, 12))]
    found = as_read(one, both)[0] - one[0]
    np.testing.assert_allclose(found[:, 9], 0.04 * 50.0 * one[0][:, 6], rtol=1e-12)
    np.testing.assert_allclose(found[:, 6], 0.5 * one[0][:, 6], rtol=1e-12)


@pytest.mark.parametrize(
    "wrong", ["sensor_gain@fq_N.share", "sensor_nothing@fy_N.share", "sensor_gain@mid_mm.share"]
)
def test_what_is_no_sensor_is_refused(wrong: str) -> None:
    with pytest.raises(InputError, match=r"no such column, allowed are x_mm|is no fault of a sensor"):
        as_read([np.ones((3, 12))], {wrong: 0.1})


def test_a_bench_reads_with_the_fault_and_its_noise() -> None:
    tests = [test for test in bench_plan(8) if test.id == "lateral_q+0"]
    few = replace(bench().noise, wrench=1e-6 * bench().noise.wrench)
    right, wrong = (
        measure("it", bench_rig(), tests, few, hidden, 1, GAUGES)
        for hidden in ({}, {"sensor_gain@fy_N.share": 0.1})
    )
    np.testing.assert_allclose(
        wrong.tests[0].data.wrench[:, 1], 1.1 * right.tests[0].data.wrench[:, 1], atol=1e-5
    )
    np.testing.assert_array_equal(wrong.tests[0].data.displacement, right.tests[0].data.displacement)
    assert of_sensors({"sensor_gain@fy_N.share": 0.1, "modulus_error.scale": 0.9}) == {
        "sensor_gain@fy_N.share": 0.1
    }


def test_a_machine_reads_with_the_fault_too() -> None:
    own = rig()
    assert own.manipulator is not None
    loadings = plan(own.manipulator, np.zeros(6))[:1]
    right, wrong = (
        measure_manipulator("it", own, loadings, hidden, 3)
        for hidden in ({}, {"sensor_gain@fx_N": {"share": 0.1}})
    )
    more = wrong.tests[0].data.wrench[:, 0] - right.tests[0].data.wrench[:, 0]
    np.testing.assert_allclose(more, 0.1 * loadings[0].loads[:, 0], rtol=1e-12, atol=1e-12)
