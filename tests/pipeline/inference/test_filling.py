"""Tests of unequal numbers of steps in one group: filling changes nothing, and repeats its test's last state."""

from __future__ import annotations

import numpy as np

from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from tests.pipeline.bench import bench
from vjm.effects import catalogue

MODEL = Model().with_effects([catalogue()["modulus_error"]]).at(np.array([0.97]))


def test_filling_is_not_solved_and_changes_nothing() -> None:
    whole = load_cases(bench())
    rows = np.concatenate([np.flatnonzero(whole.test == k)[: 3 + 2 * k] for k in range(4)])
    part = whole.only(rows)
    (group,) = part.groups
    assert group.lengths.tolist() == [3, 5, 7, 9]
    assert group.places.tolist()[0] == [0, 1, 2, 2, 2, 2, 2, 2, 2] and group.places.tolist()[1][:2] == [3, 4]
    found, full = predict(MODEL, part), predict(MODEL, whole)
    for name in ("values", "by_inputs", "by_free"):
        size = np.abs(getattr(full, name)).max()
        np.testing.assert_allclose(getattr(found, name), getattr(full, name)[rows], rtol=0, atol=1e-9 * size)
    (state,) = found.states
    assert state.converged.shape == (4, 9)
    np.testing.assert_array_equal(state.unknowns[0, 3:], state.unknowns[0, [2] * 6])
    again = predict(MODEL, part, start=found)
    assert again.states[0].iterations.max() == 1, "every step begins where it was"
