"""Where a fit ends that is linearised anew again and again."""

from __future__ import annotations

import numpy as np

from pipeline.coverage.trial import campaign
from pipeline.inference.ground import CIRCLES, Ground
from pipeline.inference.model import Model
from pipeline.inference.objective import Objective
from pipeline.inference.program import program
from vjm.effects import catalogue


def test_a_fit_that_finds_nothing_less_ends_where_it_found_the_least() -> None:
    """The sums of squares that are met are read from a list, as a climb has them."""
    tests = program(campaign((), 1, 8))
    aim = Objective(Model().with_effects([catalogue()["modulus_error"]]), tests)
    values = [np.array([1.0 + 0.01 * k]) for k in range(CIRCLES + 2)]
    heights = iter([5.0, 4.0, *(6.0 + k for k in range(CIRCLES))])
    ground = Ground(aim, lambda _: next(heights))
    for each in values:
        assert not ground.circling
        aim.at(each)
        ground.note(each)
    assert ground.circling and ground.least == 4.0
    count, end = aim.count, ground.end(aim.place, values[-1])
    assert end is values[1]
    aim.at(end)
    assert aim.count == count, "it stands there"


def test_at_the_measured_inputs_a_sum_of_squares_is_no_ground() -> None:
    tests = program(campaign((), 1, 8))
    aim = Objective(Model().with_effects([catalogue()["modulus_error"]]), tests)
    prediction, _ = aim.at(np.array([1.0]))
    assert aim.fresh
    aim.again(np.array([1.0]))
    assert not aim.fresh
    begun = Objective(aim.model, tests, prediction)
    begun.at(np.array([1.0]))
    assert not begun.fresh
