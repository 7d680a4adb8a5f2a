"""Fewer steps of a loading: the turns stay, so that what a law remembers at the others is the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign.reading import read
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.settings import LOOK
from pipeline.inference.thinning import thinned
from vjm.effects import catalogue

CASES = load_cases(read(Path(__file__).parents[3] / "examples" / "bench"))


def test_ends_turns_and_every_fourth_row_stay() -> None:
    part, start = thinned(CASES, None)
    assert start is None and part.fitted.all()
    assert LOOK.rows < len(part.test) < 2 * LOOK.rows
    fitted = [t for t in CASES.campaign.tests if t.role == "fit"]
    assert [t.id for t in part.campaign.tests] == [t.id for t in fitted]
    for test in part.campaign.tests:
        # The loading turns at steps 6 and 17.
        assert list(test.data.steps) == [0, 4, 6, 8, 12, 16, 17, 20, 23]
    assert thinned(part, None)[0] is part


@pytest.mark.parametrize("names", [("joint_friction",), ("bar_geometric_nonlinearity", "joint_clearance")])
def test_what_stays_is_predicted_as_among_all(names: tuple[str, ...]) -> None:
    model = Model().with_effects([catalogue()[name] for name in names])
    model = model.at(np.array([f.parameter.null + f.parameter.typical for f in model.free]))
    whole = predict(model, CASES)
    part, start = thinned(CASES, whole)
    assert start is not None
    lines = np.concatenate([t.data.lines for t in CASES.campaign.tests])
    rows = np.flatnonzero(np.isin(lines, np.concatenate([t.data.lines for t in part.campaign.tests])))
    for begin in (start, None):
        alone = predict(model, part, start=begin)
        off = np.abs(alone.values - whole.values[rows]) / CASES.sigma
        assert np.max(off[part.predicted]) < 0.02
    np.testing.assert_array_equal(start.values, whole.values[rows])
