"""Where a sensor begins far from nothing though nothing loads the rig, it is said; where it begins at zero, nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.beginnings import beginnings
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.selection.bench import bench


def plain(campaign: Campaign) -> Fit:
    return unfitted(Model(), load_cases(campaign))


def test_a_channel_that_is_off_in_one_test_is_told_with_its_test() -> None:
    given = bench(ids=("axial_held_q+30", "lateral_q+0"))
    assert not beginnings(plain(given), CRITERIA)
    test = next(it for it in given.tests if it.id == "lateral_q+0")
    data = replace(test.data, displacement=test.data.displacement + np.array([0.4, 0.0, 0.0, 0.0, 0.0, 0.0]))
    off = replace(given, tests=tuple(replace(it, data=data) if it is test else it for it in given.tests))
    (found,) = beginnings(plain(off), CRITERIA)
    assert (found.channel, found.tests) == (0, ("lateral_q+0",))
    assert found.value == pytest.approx(0.4, abs=0.02)
    assert found.sigmas == pytest.approx(0.4 / given.noise.sigmas[0], rel=0.05)
    # What is asked for by the test is no news.
    asked = tuple(replace(it, zero="fitted") if it.id == test.id else it for it in off.tests)
    assert not beginnings(plain(replace(off, tests=asked)), CRITERIA)
