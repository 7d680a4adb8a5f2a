"""Single bad readings are found where they are, and nothing else is taken for one."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pipeline.answer.summary import set_aside_records
from pipeline.campaign import Campaign
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.campaign.tolerance import usual
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.inference.residual import whitening
from pipeline.selection.adequacy.bad_readings import BadReading, bad_readings, set_aside
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

IDS = ("axial_held_q+0", "swing_q+0", "swing_q+30", "axial_held_q+15")
COLUMNS = (*DISPLACEMENTS, *WRENCHES)
Cell = tuple[str, int, str]


@cache
def campaign(effect: str = "", value: float = 0.0, seed: int = 1) -> Campaign:
    return bench(effect, value, IDS, seed)


def fitted(it: Campaign, *names: str) -> Fit:
    model = Model().with_effects([catalogue()[n] for n in ("bar_geometric_nonlinearity", *names)])
    return best_fit(model, load_cases(it), names)


def knocked(it: Campaign, off: dict[Cell, float]) -> Campaign:
    """The campaign with readings that are off by so many of their sigmas."""
    sigma = np.concatenate([it.noise.displacement, it.noise.wrench])
    tests = []
    for test in it.tests:
        readings = np.hstack([test.data.displacement, test.data.wrench])
        for (name, step, column), size in off.items():
            if name == test.id:
                channel = COLUMNS.index(column)
                readings[test.data.steps == step, channel] += size * sigma[channel]
        data = replace(test.data, displacement=readings[:, :6], wrench=readings[:, 6:])
        tests.append(replace(test, data=data))
    return replace(it, tests=tuple(tests))


def found(it: Campaign, *names: str) -> set[Cell]:
    return {each.cell for each in bad_readings(fitted(it, *names), CRITERIA)}


def test_one_that_another_kept_from_standing_alone_is_looked_at_again() -> None:
    """Two bad readings of a test pull the fit, and with it a neighbour that noise has moved far by itself: the first is
    refused, and found once the other is taken out."""
    first, other = ("swing_q+0", 5, "y_mm"), ("swing_q+0", 9, "y_mm")
    off = {first: 60.0, ("swing_q+0", 6, "y_mm"): 4.5}
    assert first in found(knocked(campaign(), off), "axis_flexibility")
    assert first in found(knocked(campaign(), off | {other: 40.0}), "axis_flexibility")


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_noise_has_none(seed: int) -> None:
    assert not found(campaign(seed=seed))


def test_each_that_is_off_alone_is_found_and_no_other() -> None:
    off = {
        (IDS[0], 3, "x_mm"): 25.0,
        (IDS[1], 5, "mz_Nmm"): -40.0,
        (IDS[2], 2, "fz_N"): 15.0,
        (IDS[0], 8, "fy_N"): 60.0,
    }
    assert found(knocked(campaign(), off)) == set(off)


def test_one_that_is_kept_by_hand_is_none_and_the_others_stay() -> None:
    off = {("axial_held_q+0", 5, "x_mm"): 14.0, ("swing_q+30", 7, "fz_N"): -12.0}
    it = knocked(campaign(), off)
    assert found(it) == set(off)
    tests = (replace(t, keep=((5, "x_mm"),)) if t.id == "axial_held_q+0" else t for t in it.tests)
    assert found(replace(it, tests=tuple(tests))) == {("swing_q+30", 7, "fz_N")}


def test_a_score_is_that_of_a_fit_with_the_shift_as_a_number() -> None:
    """As least squares with a column more, of the readings alone."""
    cell = (IDS[0], 3, "x_mm")
    it = fitted(knocked(campaign(), {cell: 25.0}))
    (bad,) = bad_readings(it, CRITERIA)
    row = int(np.flatnonzero(it.residual.load_cases.test == 0)[3])
    column = np.zeros(it.residual.values.shape)
    factors = whitening(it.residual.load_cases, it.prediction).factors
    column[row] = factors[row][:, 0]
    flat = it.residual.free(column)
    expected = flat @ it.whitened / (flat @ flat) / it.residual.load_cases.campaign.noise.displacement[0]
    assert bad.cell == cell and bad.sigmas == pytest.approx(float(expected), rel=1e-6)


def test_of_two_that_say_the_same_it_is_what_is_off_less() -> None:
    """A moment answers to a rotation that is prescribed: misread by 40 of its sigmas that is 400 of the moment's."""
    cell = (IDS[0], 6, "ry_rad")
    (bad,) = bad_readings(fitted(knocked(campaign(), {cell: 40.0})), CRITERIA)
    assert bad.cell == cell and bad.sigmas == pytest.approx(40.0, abs=4.0)


def test_what_was_prescribed_may_be_misread_as_well() -> None:
    cell = (IDS[0], 4, "fx_N")
    assert campaign().tests[0].control[0] == "force"
    (bad,) = bad_readings(fitted(knocked(campaign(), {cell: 120.0})), CRITERIA)
    # Along the bars the force and the displacement that it makes say the same, until both are in the same row.
    assert bad.cell in (cell, (IDS[0], 4, "x_mm"))


def test_two_readings_that_say_the_same_of_their_step_are_both_told() -> None:
    """A platform on parallel bars goes along a circle: where z was prescribed, x tells of z alone."""
    for column in ("x_mm", "z_mm"):
        (bad,) = bad_readings(fitted(knocked(campaign(), {(IDS[2], 4, column): 60.0})), CRITERIA)
        assert {bad.column, *bad.instead} == {"x_mm", "z_mm"}
    # A force that is read only stands alone.
    (bad,) = bad_readings(fitted(knocked(campaign(), {(IDS[1], 5, "mz_Nmm"): 40.0})), CRITERIA)
    assert bad.column == "mz_Nmm" and not bad.instead


def test_the_line_of_a_bad_reading_is_that_of_its_file() -> None:
    it = knocked(campaign(), {(IDS[1], 5, "mz_Nmm"): 40.0})
    tests = [replace(t, data=replace(t.data, lines=100 + 7 * np.arange(t.data.steps.size))) for t in it.tests]
    (bad,) = bad_readings(fitted(replace(it, tests=tuple(tests))), CRITERIA)
    row = int(np.flatnonzero(it.tests[1].data.steps == 5)[0])
    assert bad.line == 100 + 7 * row
    (said,) = set_aside_records((bad,))
    assert said.place == f"step 5 of {IDS[1]}, line {bad.line} of its file"
    (unknown,) = bad_readings(fitted(it), CRITERIA)
    assert unknown == bad and unknown.line is None


def test_a_run_is_none() -> None:
    """Three steps in a row: a shape, not a single reading."""
    it = knocked(campaign(), {(IDS[1], step, "mz_Nmm"): 20.0 for step in (4, 5, 6)})
    assert not found(it)


@pytest.mark.parametrize(
    ("effect", "value"),
    [
        ("joint_friction.torque_Nmm", 150.0),
        pytest.param("joint_clearance.play_mm", 0.01, marks=pytest.mark.long),
    ],
)
def test_friction_and_play_are_none_once_they_are_in_the_model(effect: str, value: float) -> None:
    assert not found(campaign(effect, value), effect.split(".")[0])


def test_tolerances_take_no_reading_for_a_bad_one() -> None:
    it = campaign("modulus_error.scale", 1.03)
    it = replace(it, tolerance=usual(it.rig.written))
    cell = (IDS[1], 5, "mz_Nmm")
    assert not found(it)
    assert found(knocked(it, {cell: 30.0})) == {cell}


def test_what_is_set_aside_is_gone_and_a_prescribed_one_takes_what_its_row_compares() -> None:
    it = campaign()
    read, given = BadReading(IDS[0], 3, "x_mm", 9.0), BadReading(IDS[0], 4, "fx_N", 9.0)
    less = set_aside(it, (read, given))
    before, after = it.tests[0].data, less.tests[0].data
    np.testing.assert_array_equal(after.steps, before.steps)
    assert np.isnan(after.displacement[3, 0]) and np.isfinite(after.wrench[3, 1])
    # The step is on the way from the one before to the one after.
    assert after.wrench[4, 0] == pytest.approx(0.5 * (before.wrench[3, 0] + before.wrench[5, 0]), rel=1e-12)
    assert not load_cases(less).predicted[4].any() and load_cases(less).predicted[5].any()
    few = replace(
        before,
        steps=before.steps[4:5],
        displacement=before.displacement[4:5],
        wrench=before.wrench[4:5],
        gauges=before.gauges[4:5],
        temperature=None,
        lines=before.lines[4:5],
    )
    only = replace(it, tests=(replace(it.tests[0], data=few),))
    assert not set_aside(only, (given,)).tests
    assert set_aside(it, ()) is it
