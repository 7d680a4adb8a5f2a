"""What is off at the greatest loads of test after test is a law, and neither a bad reading nor noise."""

from __future__ import annotations

import numpy as np

from pipeline.inference.driving import driving
from pipeline.inference.load_cases import load_cases
from pipeline.selection.adequacy.bad_readings import bad_readings
from pipeline.selection.adequacy.greatest_loads import at_greatest_loads, of_a_law, off_at_greatest_loads
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.reading_noise import Readings
from tests.pipeline.selection.adequacy.test_bad_readings import Cell, campaign, fitted, knocked

SIGMAS = 25.0


def turns() -> list[Cell]:
    """The x of the first row of each fitted test in which its load is greatest, of either sign."""
    it = campaign()
    out = list[Cell]()
    for test in (test for test in it.tests if test.role == "fit"):
        _, values = driving(test, it.gauges)
        out += [(test.id, int(test.data.steps[k]), "x_mm") for k in (np.argmax(values), np.argmin(values))]
    return out


def test_rows_of_the_greatest_loads_are_those_before_a_load_turns_back() -> None:
    whole = load_cases(campaign())
    peaks = at_greatest_loads(whole)
    for number, test in enumerate(whole.campaign.tests):
        _, values = driving(test, whole.campaign.gauges)
        own = peaks[whole.test == number]
        assert own[np.argmax(np.abs(values))] and not own[np.argmin(np.abs(values))]
        assert 0.0 < own.mean() < 0.5


def test_what_is_off_wherever_the_load_is_greatest_is_no_bad_reading() -> None:
    """As a law does that stiffens fast: the signs of its loads, nothing beside."""
    off = {cell: SIGMAS * (-1.0) ** k for k, cell in enumerate(turns())}
    it = fitted(knocked(campaign(), off))
    assert len(off) == 6 and not bad_readings(it, CRITERIA)
    assert off_at_greatest_loads(it, CRITERIA.false_alarm)
    assert not Readings.may_be_asked(it, CRITERIA)


def test_as_many_bad_readings_elsewhere_are_bad_ones() -> None:
    """One of them where the load is greatest, as by chance."""
    elsewhere = {(name, step + 3, column): SIGMAS for name, step, column in turns()[2::2]}
    off = {turns()[0]: SIGMAS, **elsewhere}
    it = fitted(knocked(campaign(), off))
    assert {each.cell for each in bad_readings(it, CRITERIA)} == set(off)
    assert not off_at_greatest_loads(it, CRITERIA.false_alarm)


def test_noise_is_not_off_there() -> None:
    for seed in range(1, 9):
        it = fitted(campaign(seed=seed))
        assert not off_at_greatest_loads(it, CRITERIA.false_alarm)


def test_the_chance_is_that_of_drawing_so_many_of_few() -> None:
    """Three of three where a sixth of the rows is: 1 in 216; two of three more often than five in a thousand."""
    whole = load_cases(campaign())
    peaks = np.flatnonzero(at_greatest_loads(whole))
    there = np.ones((len(whole.test), 13), dtype=bool)
    share = float(at_greatest_loads(whole).mean())
    all_there = [(int(row), 0) for row in peaks[:3]]
    assert (share**3 < CRITERIA.false_alarm) == bool(of_a_law(all_there, there, whole, CRITERIA.false_alarm))
    elsewhere = int(np.flatnonzero(~at_greatest_loads(whole))[0])
    assert not of_a_law([*all_there[:2], (elsewhere, 0)], there, whole, CRITERIA.false_alarm)
    # Another column has nothing to do with it.
    assert of_a_law([*all_there, (elsewhere, 1)], there, whole, 2.0 * share**3) == frozenset(all_there)
