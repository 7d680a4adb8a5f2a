"""Faults of sensors by closed forms: what a column reads too much, and nothing of the mechanism."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from tests.vjm.effects.bench import BAR, PARALLELOGRAM
from vjm.effects import catalogue, effect_named, effect_of, for_kind
from vjm.effects.sensor_backlash import SensorBacklash
from vjm.effects.sensor_cross_talk import SensorCrossTalk
from vjm.effects.sensor_drift import SensorDrift
from vjm.effects.sensor_fault import RESOLVED, Rows, SensorFault
from vjm.effects.sensor_gain import SensorGain
from vjm.effects.sensor_lag import SensorLag
from vjm.effects.sensor_settling import SensorSettling
from vjm.effects.sized import Scale, sized

KINDS = {name: it for name, it in catalogue().items() if isinstance(it, SensorFault)}
COLUMNS = ("x_mm", "ry_rad", "fy_N", "mz_Nmm", "mid_mm")
ROWS = Rows(
    np.array([0, 0, 0, 1, 1, 1, 1]),
    np.array([0.0, 1, 2, 0, 1, 2, 3]),
    np.linspace(0.0, 1.0, 7),
    COLUMNS,
)
READINGS = np.random.default_rng(3).normal(size=(7, 5)) * (1.0, 1e-3, 50.0, 900.0, 0.2)


def test_they_are_found_and_are_no_effects_of_a_mechanism() -> None:
    assert set(KINDS) == {
        f"sensor_{it}" for it in ("gain", "drift", "settling", "cross_talk", "lag", "backlash")
    }
    for kind in ("parallelogram", "bar", "manipulator"):
        assert not set(KINDS) & set(for_kind(kind))


@pytest.mark.parametrize("name", KINDS)
def test_a_fault_has_a_sensor_and_changes_no_mechanism(name: str) -> None:
    column = "fy_N<mz_Nmm" if name == "sensor_cross_talk" else "fy_N"
    it = KINDS[name].at(column)
    assert it.name == f"{name}@{column}" and it.column == "fy_N" and it.site == column and it.kind == name
    assert it.apply(PARALLELOGRAM, it.typicals) is PARALLELOGRAM and it.apply(BAR, it.typicals) is BAR
    assert KINDS[name].column == "" and KINDS[name].name == name
    assert not np.any(it.error(READINGS, ROWS, it.nulls)) and it.absent(it.nulls)
    assert np.any(it.error(READINGS, ROWS, it.typicals)) and not it.absent(it.typicals)
    again = pickle.loads(pickle.dumps(it))
    np.testing.assert_array_equal(
        again.error(READINGS, ROWS, it.typicals), it.error(READINGS, ROWS, it.typicals)
    )


def test_names_with_a_sensor_are_found() -> None:
    known = catalogue()
    found = effect_named("sensor_gain@fy_N", known)
    assert isinstance(found, SensorGain) and found.column == "fy_N"
    assert effect_named("sensor_gain", known) is known["sensor_gain"]
    for wrong in (
        "sensor_gain@",
        "sensor_gain@fy",
        "nothing@fy_N",
        "sensor_cross_talk@fy_N",
    ):
        assert effect_named(wrong, known) is None, wrong
    # What parts a rig has is the rig's to know.
    other = effect_named("modulus_error@fy_N", known)
    assert other is not None and other.tags == "fy_N"
    with pytest.raises(KeyError):
        effect_of("sensor_gain@fy", known)


def test_gain_is_a_share_of_the_reading() -> None:
    error = SensorGain().at("mz_Nmm").error(READINGS, ROWS, {"share": 0.03})
    np.testing.assert_allclose(error, 0.03 * READINGS[:, 3], rtol=1e-15)


def test_drift_goes_on_through_the_campaign() -> None:
    error = SensorDrift().at("fy_N").error(READINGS, ROWS, {"size": 12.0})
    np.testing.assert_allclose(error, [0, 2, 4, 6, 8, 10, 12], rtol=1e-14)


def test_settling_begins_anew_in_every_test() -> None:
    error = SensorSettling().at("x_mm").error(READINGS, ROWS, {"size": 0.4, "steps": 1.0 / np.log(2.0)})
    np.testing.assert_allclose(error, [0.4, 0.2, 0.1, 0.4, 0.2, 0.1, 0.05], rtol=1e-14)


def test_lag_keeps_a_part_of_the_last_reading() -> None:
    steps = np.zeros((7, 5))
    steps[:, 4] = 1.0
    error = SensorLag().at("mid_mm").error(steps, ROWS, {"keeps": 0.5})
    np.testing.assert_allclose(error, [-0.5, -0.25, -0.125, -0.5, -0.25, -0.125, -0.0625], rtol=1e-14)


@pytest.mark.parametrize(
    ("start", "expected"),
    [(0.0, [-1, -1, 1, 1, -1, 1]), (1.0, [0, 0, 2, 2, 0, 2]), (-0.5, [-1.5, -1.5, 0.5, 0.5, -1.5, 0.5])],
)
def test_backlash_is_a_loop_of_one_width(start: float, expected: list[float]) -> None:
    steps = np.zeros((7, 5))
    steps[:, 4] = 7.0, 10.0, 20.0, 10.0, -10.0, 10.0, -20.0
    rows = Rows(np.zeros(7, dtype=int), np.arange(7.0), np.linspace(0.0, 1.0, 7), COLUMNS)
    values = {"gap": 2.0, "start": start}
    it = SensorBacklash().at("mid_mm")
    np.testing.assert_allclose(it.error(steps, rows, values), [0.0, *expected], rtol=1e-14)
    np.testing.assert_array_equal(it.follows(steps, rows, values), np.arange(7))


def test_a_motion_within_the_backlash_is_not_read_and_each_test_begins_at_its_first_row() -> None:
    steps = np.zeros((7, 5))
    steps[:, 0] = 5.0, 5.9, 4.1, -5.0, -3.5, -4.4, -6.6
    values = {"gap": 2.0, "start": 0.0}
    it = SensorBacklash().at("x_mm")
    read = it.error(steps, ROWS, values) + steps[:, 0]
    np.testing.assert_allclose(read, [5.0, 5.0, 5.0, -5.0, -4.5, -4.5, -5.6], rtol=1e-14)
    np.testing.assert_array_equal(it.follows(steps, ROWS, values), [0, 0, 0, 3, 4, 4, 6])


def test_cross_talk_is_in_what_good_sensors_tell_apart() -> None:
    it = SensorCrossTalk().at("fy_N<mz_Nmm")
    expected = 0.1 * READINGS[:, 3] * RESOLVED["N"] / RESOLVED["Nmm"]
    np.testing.assert_allclose(it.error(READINGS, ROWS, {"share": 0.1}), expected, rtol=1e-14)
    assert it.columns == ("fy_N", "mz_Nmm")
    assert set(SensorCrossTalk().sites(COLUMNS)) == {
        "x_mm<ry_rad",
        "ry_rad<x_mm",
        "fy_N<mz_Nmm",
        "mz_Nmm<fy_N",
    }
    assert list(SensorGain().sites(COLUMNS)) == list(COLUMNS)


@pytest.mark.parametrize("sized_first", [True, False])
def test_sizes_follow_the_rig_and_the_unit_of_the_column(sized_first: bool) -> None:
    scale = Scale(length=2.0, axial=3.0, bending=8.0)
    for column, unit, factor in (
        ("x_mm", "mm", 2.0),
        ("fy_N", "N", 4.0),
        ("mz_Nmm", "N·mm", 8.0),
        ("ry_rad", "rad", 1.0),
    ):
        plain = SensorDrift().at(column)
        it = sized(SensorDrift(), scale).at(column) if sized_first else sized(plain, scale)  # type: ignore[attr-defined]
        old, new = plain.parameters[0], it.parameters[0]
        assert new.unit == unit and new.typical == pytest.approx(factor * old.typical)
        assert new.high == pytest.approx(factor * old.high)
        assert old.typical == pytest.approx(10.0 * RESOLVED[column.split("_")[1]])
        assert sized(it, scale).parameters == it.parameters
