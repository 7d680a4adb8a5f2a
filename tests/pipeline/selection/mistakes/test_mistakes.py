"""Each mistake that may be looked for is undone by what mends it, and none is offered that cannot be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.mistakes import possible
from pipeline.selection.mistakes.base import Mistake, times
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import bench
from tests.pipeline.selection.mistakes import made

WRONG = {
    "all forces are in kgf": made.over(9.80665, *made.FORCES),
    "all forces are in lbf": made.over(4.4482216, *made.FORCES),
    "fx_N is in kN": made.over(1000.0, "fx_N"),
    "all moments are in N·m": made.over(1000.0, *made.MOMENTS),
    "x_mm is in inches": made.over(25.4, "x_mm"),
    "all displacements are in m": made.over(1000.0, "x_mm", "y_mm", "z_mm"),
    "rz_rad is in degrees": made.over(np.pi / 180.0, "rz_rad"),
    "x_mm was converted to inches the wrong way round or twice": made.over(1.0 / 25.4, "x_mm"),
    "fz_N has the wrong sign": made.over(-1.0, "fz_N"),
    "all forces and moments have the wrong sign": made.over(-1.0, *made.FORCES, *made.MOMENTS),
    "fy_N and fz_N are exchanged": made.exchanged("fy_N", "fz_N"),
    "x_mm and y_mm are exchanged": made.exchanged("x_mm", "y_mm"),
    "the steps of every test stand backwards": made.backwards,
}


def readings(campaign: Campaign) -> np.ndarray:
    return np.vstack([np.hstack([t.data.displacement, t.data.wrench]) for t in campaign.tests])


def named(campaign: Campaign, words: str) -> Mistake:
    found = [it for it in possible(campaign, CRITERIA) if it.words == words]
    assert len(found) == 1, sorted(it.words for it in possible(campaign, CRITERIA))
    return found[0]


@pytest.mark.parametrize("words", WRONG)
def test_what_mends_a_mistake_undoes_it(words: str) -> None:
    right = bench()
    wrong = WRONG[words](right)
    assert not np.allclose(readings(wrong), readings(right), rtol=1e-6, atol=0.0, equal_nan=True)
    mended = named(wrong, words).mended(wrong)
    np.testing.assert_allclose(readings(mended), readings(right), rtol=1e-12)
    assert [t.q_deg for t in mended.tests] == [t.q_deg for t in right.tests]


def test_a_sensor_that_counts_as_exact_stays_so_in_another_unit() -> None:
    """A sigma of zero is that of a load that was prescribed in steps: RuntimeWarnings are errors here."""
    right = bench()
    sigmas = right.noise.sigmas
    sigmas[8] = 0.0
    exact = replace(right, noise=right.noise.of(sigmas))
    tests = [replace(t, data=replace(t.data, wrench=t.data.wrench.copy())) for t in exact.tests]
    rng = np.random.default_rng(1)
    for test in tests:
        test.data.wrench[:, 8 - 6] = rng.normal(size=test.data.steps.size)
    found = times(replace(exact, tests=tuple(tests)), ("fz_N", "fy_N"), 1000.0)
    assert found.noise.sigmas[8] == 0.0
    np.testing.assert_allclose(found.tests[0].data.wrench[:, 2], 1000.0 * tests[0].data.wrench[:, 2])


@pytest.mark.parametrize("power", [10.0, 100.0])
def test_a_decimal_point_that_slipped_is_put_back(power: float) -> None:
    right = bench()
    test = right.tests[0]
    wrench = test.data.wrench.copy()
    step = int(np.argmax(np.abs(wrench[:, 0])))
    wrench[step, 0] *= power
    wrong = replace(right, tests=(replace(test, data=replace(test.data, wrench=wrench)), *right.tests[1:]))
    words = f"fx_N of test {test.id}, step {step}, is {power:g} times too large: its decimal point slipped"
    np.testing.assert_allclose(readings(named(wrong, words).mended(wrong)), readings(right), rtol=1e-12)
    assert not any(it.kind == "digit" for it in possible(right, CRITERIA))


def test_a_knocked_reading_of_a_column_of_noise_is_no_slipped_point() -> None:
    """Ten times what is noise is thirty sigmas, which a knock is as well."""
    right = bench()
    test = right.tests[0]
    wrench, sigma = test.data.wrench.copy(), right.noise.sigmas[10]
    assert np.abs(wrench[:, 4]).max() < 10.0 * sigma
    wrench[2, 4] = 40.0 * sigma
    knocked = replace(right, tests=(replace(test, data=replace(test.data, wrench=wrench)), *right.tests[1:]))
    assert not any(it.kind == "digit" for it in possible(knocked, CRITERIA))


def test_angles_in_radians() -> None:
    right = bench()
    wrong = made.angles_in_radians(right)
    mended = named(wrong, "q_deg is in radians").mended(wrong)
    assert [t.q_deg for t in mended.tests] == pytest.approx([t.q_deg for t in right.tests])
    assert not [it for it in possible(right, CRITERIA) if it.columns == ("q_deg",)]


def test_a_column_that_begins_far_from_zero() -> None:
    right = bench()
    assert not [it for it in possible(right, CRITERIA) if it.kind == "zero"]
    wrong = made.shifted(30.0, "x_mm")(right)
    it = named(wrong, "x_mm was not zeroed: absolute positions or loads")
    first = readings(it.mended(wrong))[0]
    assert first[0] == 0.0 and first[1] == readings(wrong)[0, 1]
    # The reading that is taken off has noise of its own.
    assert it.mended(wrong).noise.sigmas[0] == pytest.approx(np.sqrt(2.0) * wrong.noise.sigmas[0])


@pytest.mark.parametrize("sigma_too", [False, True])
def test_a_sigma_goes_with_the_column_where_it_is_in_the_same_unit(sigma_too: bool) -> None:
    """The scatter of many readings tells in which unit a sigma was written."""
    plan = [test for test in bench_plan(60) if test.id == "axial_held_q+0"]
    right = measure("many", bench_rig(), plan, SENSORS, {}, 1, GAUGES)
    wrong = made.over(25.4, "x_mm")(right)
    if sigma_too:
        sigmas = wrong.noise.sigmas
        sigmas[0] /= 25.4
        wrong = replace(wrong, noise=wrong.noise.of(sigmas))
    mended = named(wrong, "x_mm is in inches").mended(wrong)
    np.testing.assert_allclose(mended.noise.sigmas, right.noise.sigmas, rtol=1e-12)


def test_steps_that_were_sorted_are_offered_as_loops() -> None:
    right = bench(ids=("axial_held_q+0",))
    order = np.argsort(readings(right)[:, 6])

    def by_load(campaign: Campaign) -> Campaign:
        return made.changed(campaign, lambda values: values[order])

    words = {it.words for it in possible(by_load(right), CRITERIA) if it.kind == "order"}
    said = "the steps of every test are sorted by the load; they were done"
    assert words == {"the steps of every test stand backwards", f"{said} up and down", f"{said} down and up"}
    assert len([it for it in possible(right, CRITERIA) if it.kind == "order"]) == 1


def test_every_mistake_says_what_to_do() -> None:
    every = list(possible(made.shifted(30.0, "x_mm")(bench()), CRITERIA))
    assert len({it.words for it in every}) == len(every) > 100
    assert {it.kind for it in every} == {"unit", "sign", "exchanged", "zero", "order", "section", "modulus"}
    for it in every:
        assert it.mend and it.columns and it.words[0].islower(), it.words
