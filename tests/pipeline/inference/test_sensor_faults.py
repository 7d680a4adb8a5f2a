"""Faults of sensors in a prediction: of what is read, of what is prescribed, and against the virtual bench."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.errors import InputError
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.sensor_faults import moved
from pipeline.inference.suitable import check_suitable, columns_read, named_effects
from pipeline.selection.adequacy.patterns import shapes
from pipeline.selection.criteria import CRITERIA
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import MIXED, bench
from vjm.effects import catalogue
from vjm.effects.sensor_fault import SensorFault

ALWAYS = "bar_geometric_nonlinearity"
HIDDEN = {
    "sensor_gain@fy_N": {"share": 0.03},
    "sensor_gain@y_mm": {"share": 0.03},
    "sensor_drift@fz_N": {"size": 12.0},
    "sensor_settling@fy_N": {"size": 8.0, "steps": 2.5},
    "sensor_lag@x_mm": {"keeps": 0.1},
    "sensor_cross_talk@mz_Nmm<fx_N": {"share": 0.02},
    "sensor_backlash@fz_N": {"gap": 9.0, "start": 0.5},
    "sensor_backlash@x_mm": {"gap": 0.02, "start": -0.6},
}
"""Two of them of columns that control a coordinate in all or in some tests."""
PLAIN = Model().with_effects(named_effects([ALWAYS], catalogue()))


def with_fault(name: str) -> Model:
    return Model().with_effects(named_effects([ALWAYS, name], catalogue()))


@cache
def measured(name: str) -> Campaign:
    """A bench of the frame finite elements, read by a faulty sensor."""
    plan = [test for test in bench_plan(12) if test.id in MIXED]
    hidden = {f"{name}.{key}": value for key, value in HIDDEN[name].items()}
    return measure("faulty", bench_rig(), plan, SENSORS, hidden, 7, GAUGES)


@pytest.mark.parametrize("name", HIDDEN)
def test_a_fit_finds_the_fault_of_the_virtual_bench(name: str) -> None:
    cases = load_cases(measured(name))
    without, found = fit(PLAIN, cases), fit(with_fault(name), cases)
    assert found.chi_square < 1.25 * found.degrees < without.chi_square
    std = np.sqrt(np.diag(np.linalg.inv(found.jacobian.T @ found.jacobian)))
    truth = np.array([HIDDEN[name][each.parameter.name] for each in found.model.free])
    assert np.all(np.abs(found.model.values - truth) < 4.0 * std)
    assert np.all(std < 0.2 * np.abs(truth))


@pytest.mark.parametrize("name", HIDDEN)
def test_derivatives_are_those_of_predicting_again(name: str) -> None:
    cases = load_cases(bench())
    effects = named_effects([ALWAYS, "joint_torsional_stiffness", name], catalogue())
    model = Model().with_effects(effects)
    model = model.at(np.array([each.parameter.null + 0.7 * each.parameter.typical for each in model.free]))
    there = predict(model, cases)
    for k, each in enumerate(model.free):
        step = np.zeros(len(model.free))
        step[k] = 1e-3 * each.parameter.typical
        up, down = (predict(model.at(model.values + s), cases, slopes=False).values for s in (step, -step))
        slope = ((up - down) / (2.0 * step[k]) / cases.sigma)[cases.predicted]
        error = (there.by_free[..., k] / cases.sigma)[cases.predicted] - slope
        assert np.abs(error).max() < 1e-3 * np.abs(slope).max(), each


def test_what_was_really_done_gives_what_was_read() -> None:
    """A prescribed column with a gain of 25 %: the linkage stands where y (1 + 0.25) is the reading."""
    right, name = bench(), "sensor_gain@y_mm"
    model = with_fault(name).at(np.array([0.25]))
    shift = np.zeros((len(load_cases(right).test), 7))
    cases = load_cases(right)
    rows, coordinates = np.nonzero(cases.channels == 1)
    shift[rows, coordinates] = cases.measured[rows, 1] * (1.0 / 1.25 - 1.0)
    expected = predict(PLAIN, cases, slopes=False, shift=shift).values[rows]
    found = predict(model, cases, slopes=False).values[rows]
    size = np.abs(expected).max(axis=0)
    np.testing.assert_allclose(found / size, expected / size, atol=1e-4)


@pytest.mark.parametrize("true", [1.0, 2.0])
def test_a_column_that_stands_scatters_in_its_gap(true: float) -> None:
    """A force that is held at nothing is not dragged through its backlash by noise, twice its sigma or not."""
    cases = load_cases(bench())
    fault = named_effects(["sensor_backlash@fy_N"], catalogue())[0]
    assert isinstance(fault, SensorFault)
    column, sigma = cases.rows.columns.index("fy_N"), np.ones(len(cases.test))
    generator, read = np.random.default_rng(4), cases.measured.copy()
    for first, end in pairwise(cases.first):
        read[first:end, column] = generator.normal(scale=true, size=end - first)
    there = moved(fault, read, cases, sigma)[:, column]
    stands = [np.ptp(there[first:end]) == 0.0 for first, end in pairwise(cases.first)]
    assert np.mean(stands) > 0.8


def test_a_column_that_moves_within_few_sigmas_is_followed() -> None:
    """A ramp and one step, each of no more scatter than a column that stands may have."""
    cases = load_cases(bench())
    fault = named_effects(["sensor_backlash@fy_N"], catalogue())[0]
    assert isinstance(fault, SensorFault)
    column, sigma, read = cases.rows.columns.index("fy_N"), np.ones(len(cases.test)), cases.measured.copy()
    for number, (first, end) in enumerate(pairwise(cases.first)):
        steps = np.arange(end - first)
        read[first:end, column] = 4.0 * (steps >= steps.size // 2) if number % 2 else 8.0 * steps / steps[-1]
    there = moved(fault, read, cases, sigma)[:, column]
    for first, end in pairwise(cases.first):
        assert np.std(read[first:end, column]) < 3.0
        assert np.ptp(there[first:end]) >= 3.0


def test_a_part_of_the_rows_has_the_clock_of_the_whole() -> None:
    """Drift is told by the row of the campaign, whichever rows are looked at."""
    cases = load_cases(bench())
    rows = np.arange(5, len(cases.test), 7)
    model = with_fault("sensor_drift@fy_N").at(np.array([9.0]))
    whole, part = predict(model, cases, slopes=False), predict(model, cases.only(rows), slopes=False)
    errors = whole.values[rows] - predict(PLAIN, cases, slopes=False).values[rows]
    again = part.values - predict(PLAIN, cases.only(rows), slopes=False).values
    np.testing.assert_allclose(again[:, 7], errors[:, 7], atol=1e-9)
    assert np.abs(errors[:, 7]).max() > 4.0


def test_a_sensor_that_was_not_read_is_refused() -> None:
    campaign = bench()
    assert "mid_mm" in columns_read(campaign)
    check_suitable(named_effects(["sensor_gain@mid_mm"], catalogue()), campaign)
    for name, said in (
        (
            "sensor_gain",
            "sensor_gain needs a sensor that was read, write sensor_gain@COLUMN with any of x_mm, y_mm",
        ),
        ("sensor_drift@other_mm", "write sensor_drift@COLUMN with any of"),
        ("sensor_cross_talk", "write sensor_cross_talk@COLUMN<OTHER with any of"),
    ):
        with pytest.raises(InputError, match=said):
            check_suitable(named_effects([name], catalogue()), campaign)


def test_a_gain_that_is_fitted_leaves_no_pattern_of_its_own_noise() -> None:
    """Of a column that is prescribed in some tests and read in others: a slope at noisy inputs would follow them."""
    plan = [test for test in bench_plan(12) if test.id in (*MIXED, "turn_z_q+0", "lateral_pushed_q+30")]
    hidden = {"sensor_gain@mz_Nmm.share": 0.04}
    found = fit(
        with_fault("sensor_gain@mz_Nmm"),
        load_cases(measure("gain", bench_rig(), plan, SENSORS, hidden, 7, GAUGES)),
    )
    words = "mz reads too much or too little in proportion"
    assert not [it for it in shapes(found, CRITERIA) if it.words == words]
