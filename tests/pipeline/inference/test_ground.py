"""Where a fit ends that is linearised anew again and again."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.coverage.cases import BASE
from pipeline.coverage.trial import campaign
from pipeline.inference.fit import fit
from pipeline.inference.ground import CIRCLES, NEAR, Ground
from pipeline.inference.model import Model
from pipeline.inference.objective import Objective
from pipeline.inference.program import program
from vjm.effects import catalogue

EFFECTS = catalogue()


def test_a_fit_that_climbs_ends_where_it_began() -> None:
    """The sums of squares that are met are read from a list, as a climb has them."""
    tests = program(campaign((), 1, 8))
    less = fit(Model().with_effects([EFFECTS[BASE]]), tests)
    aim = Objective(less.model.with_effects([EFFECTS["modulus_error"]]), tests, less.prediction)
    values = [np.array([1.0 + 0.05 * k]) for k in range(CIRCLES + 1)]
    heights = iter([5.0, *(6.0 + k for k in range(CIRCLES)), 9.0])
    ground = Ground(aim, lambda _: next(heights))
    ground.begin(values[0])
    for each in values[1:]:
        assert not ground.circling
        aim.at(each)
        assert ground.anew(aim.place, each)
    assert ground.circling
    assert ground.end(aim.place, values[-1]) is values[0]
    count = aim.count
    aim.at(values[0])
    assert aim.count == count, "it stands there"


@pytest.mark.parametrize(("size", "ground"), [(1e-9, True), (4e-4, False)])
def test_no_way_back_to_what_looks_better_than_the_start_at_once(size: float, ground: bool) -> None:
    """A play comes in at a rung of its ladder: rows choose their sides from inputs that fit best without one."""
    tests = program(campaign((), 1, 8))
    plain = fit(Model().with_effects([EFFECTS[BASE]]), tests)
    aim = Objective(plain.model.with_effects([EFFECTS["joint_clearance"]]), tests, plain.prediction)
    it = Ground(aim, lambda _: 1.0)
    it.begin(np.array([size]))
    assert (it.least == 1.0) == ground


def test_far_above_noise_it_is_linearised_anew_until_that_changes_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Plain bars, that no play makes fit, about inputs that never settle."""
    tests = program(campaign((), 1, 8))
    aim = Objective(Model().with_effects([EFFECTS["joint_clearance"]]), tests)
    values, other = np.array([0.004]), np.array([0.0041])
    aim.at(values)
    ground, place = Ground(aim, lambda _: 1.0), aim.place
    times = 0
    while ground.anew(place, values):
        place, times = aim.place, times + 1
        assert times < 10 and aim.unsettled(values) > NEAR
    assert times >= 1, "at first it is"
    aim.at(other)
    assert ground.anew(aim.place, other), "elsewhere it is"
    monkeypatch.setattr("pipeline.inference.ground.FAR", np.inf)
    near = Ground(aim, lambda _: 1.0)
    assert all(near.anew(aim.place, other) for _ in range(4)), "near noise every change counts"
