"""A faulty sensor is named as one where nothing of the mechanism explains what is read, and only then."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits, diagnose
from pipeline.selection.faulty_sensor import faults_of, has_one_fault, with_promising_faults
from pipeline.selection.rivals import with_rivals
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import MIXED, bench, creeping_gauge, growing_gain, with_fault
from vjm.effects import catalogue
from vjm.effects.base import Effect

ALWAYS = "bar_geometric_nonlinearity"
QUICK = "sensor_drift@fz_N"
SOME = (ALWAYS, "modulus_error", "load_misalignment", "self_weight", "mounting_tilt", "dimension_error")
"""Effects that could do some of what a sensor does; the whole catalogue is that of the challenge."""
HIDDEN = {
    "sensor_gain@fx_N": {"share": 0.02},
    QUICK: {"size": 15.0},
    "sensor_settling@fy_N": {"size": 8.0, "steps": 2.5},
    "sensor_lag@x_mm": {"keeps": 0.1},
    "sensor_backlash@x_mm": {"gap": 0.02, "start": 0.7},
}


def some(among: tuple[str, ...] = SOME) -> dict[str, Effect]:
    return {key: it for key, it in catalogue().items() if key in among or key.startswith("sensor_")}


def doubted(campaign: Campaign) -> Campaign:
    """Whose length is known to a tolerance: nobody vouches for all of it, and so not for its sensors."""
    return replace(campaign, tolerance={"length_mm": 0.05})


def read(hidden: dict[str, float]) -> Campaign:
    plan = [test for test in bench_plan(12) if test.id in MIXED]
    return doubted(measure("faulty", bench_rig(), plan, SENSORS, hidden, 5, GAUGES))


def knocked(it: Campaign, sigmas: float = 40.0, steps: int | slice = 3) -> Campaign:
    """With one reading of a moment, or some, off by so many of its sigmas."""
    test = it.tests[1]
    wrench = test.data.wrench.copy()
    wrench[steps, 5] += sigmas * it.noise.wrench[5]
    tests = (it.tests[0], replace(test, data=replace(test.data, wrench=wrench)), *it.tests[2:])
    return replace(it, tests=tests)


def measured(name: str) -> Campaign:
    """With a softer bar as well."""
    return read(
        {f"{name}.{key}": value for key, value in HIDDEN[name].items()} | {"modulus_error.scale": 0.93}
    )


@pytest.mark.parametrize(
    ("name", "among"),
    [(QUICK, (ALWAYS, "modulus_error")), *(pytest.param(it, SOME, marks=pytest.mark.long) for it in HIDDEN)],
)
def test_the_sensor_is_named_beside_the_effect(name: str, among: tuple[str, ...]) -> None:
    found = diagnose(measured(name), Model(), some(among))
    assert found.verdict == "identified" and found.decision.sets[0] == {ALWAYS, "modulus_error", name}
    assert all(name in each for each in found.decision.sets)


@pytest.mark.parametrize("work", [120.0, pytest.param(300.0, marks=pytest.mark.long)])
def test_the_sensor_is_named_where_no_work_is_left_for_a_search(work: float) -> None:
    few = replace(CRITERIA, search_work=work)
    found = diagnose(
        read({f"{QUICK}.size": 15.0}), Model(), some((ALWAYS, "load_misalignment")), criteria=few
    )
    assert found.cache.worn_out
    assert found.verdict == "identified" and found.sets == ((ALWAYS, QUICK),)


@pytest.mark.long
def test_a_fault_beside_what_is_not_explained_is_certain() -> None:
    """Two readings side by side are off: a step of a sensor, which is no single bad one, and no pattern of all rows."""
    it = knocked(read({f"{QUICK}.size": 100.0}), 5.0, slice(3, 5))
    found = diagnose(it, Model(), some())
    assert found.verdict == "unknown" and found.sets == ((ALWAYS, QUICK),)
    assert found.certain == (QUICK,)


@pytest.mark.long
@pytest.mark.parametrize("fault", [growing_gain, creeping_gauge])
def test_a_fault_of_another_form_is_not_named_as_one_of_these(fault: object) -> None:
    campaign = doubted(with_fault(bench("modulus_error.scale", 0.93), fault))  # type: ignore[arg-type]
    assert diagnose(campaign, Model(), catalogue()).verdict == "unknown"


@pytest.mark.long
def test_two_sensors_at_fault_at_once_are_no_name() -> None:
    hidden = {"sensor_drift@fz_N.size": 15.0, "sensor_gain@fx_N.share": 0.02}
    found = diagnose(read(hidden), Model(), catalogue())
    assert found.verdict == "unknown"


@pytest.mark.parametrize("sigmas", [15.0, 40.0, -60.0])
def test_one_bad_reading_promises_no_fault(sigmas: float) -> None:
    known, base = some(), Model().with_effects([catalogue()[ALWAYS]])
    cache = cached_fits(knocked(read({}), sigmas), base, known)
    assert with_promising_faults(cache, known.values(), (frozenset(),)) is None
    faulty = cached_fits(knocked(read({f"{QUICK}.size": 15.0}), sigmas), base, known)
    there = with_promising_faults(faulty, known.values(), (frozenset(),))
    assert there is not None and QUICK in there.candidates


def test_faults_of_one_sensor_are_rivals_whatever_they_promise() -> None:
    faults = {
        name: catalogue()[name].at("fz_N") for name in ("sensor_drift", "sensor_settling", "sensor_lag")
    }  # type: ignore[attr-defined]
    base = Model().with_effects([catalogue()[ALWAYS]])
    cache = cached_fits(read({f"{QUICK}.size": 100.0}), base, {}).with_candidates(
        {it.name: it for it in faults.values()}
    )
    found = with_rivals(cache, frozenset({QUICK}))
    assert found.best == {QUICK} and not found.rivals
    assert all(frozenset({it.name}) in cache.fits for it in faults.values())


def test_only_one_fault_of_a_sensor_may_be_named() -> None:
    cache = cached_fits(bench(), Model(), catalogue())
    drift, gain = (catalogue()[kind].at("fz_N") for kind in ("sensor_drift", "sensor_gain"))  # type: ignore[attr-defined]
    it = cache.with_candidates({**cache.candidates, drift.name: drift, gain.name: gain})
    assert has_one_fault(it, frozenset({drift.name, "modulus_error"}))
    assert not has_one_fault(it, frozenset({drift.name, gain.name}))
    assert not has_one_fault(it, frozenset({"modulus_error"}))


@pytest.mark.parametrize(
    ("column", "named"),
    [
        ("fy_N<fx_N", "load_misalignment"),
        pytest.param("fz_N<fx_N", "sensor_cross_talk@fz_N<fx_N", marks=pytest.mark.long),
    ],
)
def test_cross_talk_is_no_turn_of_the_cell(column: str, named: str) -> None:
    """Into fy it is one with a turn of the cell about z, where no side force is large: then both are told, with their
    numbers."""
    fault = f"sensor_cross_talk@{column}"
    found = diagnose(read({f"{fault}.share": 0.005}), Model(), some())
    assert found.sets[0] == (ALWAYS, named) and not found.instead
    if named == "load_misalignment":
        assert found.verdict == "ambiguous" and found.sets[1:] == ((ALWAYS, fault),)
        (share,) = found.about(found.sets[1]).fit.model.values
        assert share == pytest.approx(0.005, rel=0.1)
    else:
        assert found.verdict == "identified" and found.sets == ((ALWAYS, fault),)


def test_a_pattern_that_is_no_fault_of_the_catalogue_stays_in_words() -> None:
    known = {name: it for name, it in some().items() if name != "sensor_cross_talk"}
    found = diagnose(read({"sensor_cross_talk@fy_N<fx_N.share": 0.005}), Model(), known)
    assert found.verdict == "ambiguous" and found.sets == ((ALWAYS, "load_misalignment"),)
    assert [it.words for it in found.instead] == ["fy answers to fx"]


@pytest.mark.long
def test_a_faulty_sensor_is_named_though_a_reading_was_knocked() -> None:
    it = knocked(read({"sensor_lag@fx_N.keeps": 0.1}))
    test = it.tests[1]
    found = diagnose(it, Model(), some())
    assert found.verdict == "identified" and found.sets == ((ALWAYS, "sensor_lag@fx_N"),)
    assert [bad.cell for bad in found.readings.bad] == [(test.id, 3, "mz_Nmm")]
    assert found.with_all == "unknown"


@pytest.mark.long
def test_a_sensor_that_is_vouched_for_is_not_at_fault() -> None:
    exact = replace(read({"sensor_cross_talk@fz_N<fx_N.share": 0.005}), tolerance={})
    assert exact.vouched and diagnose(exact, Model(), catalogue()).verdict == "unknown"


def test_every_sensor_that_was_read_may_have_every_fault() -> None:
    every = faults_of(catalogue().values(), bench(), CRITERIA)
    # Five faults of thirteen columns, and cross-talk of every two of a load cell and of a tracker.
    assert len(every) == 5 * 13 + 2 * 6 * 5
    assert all(it.name == name and it.column for name, it in every.items())
