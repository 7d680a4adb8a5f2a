"""Samples beside the tangent: the same where the model is straight, wider at the stop of a play, the same by seed."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.predict.bands import Tangent
from pipeline.predict.posterior import Posterior
from pipeline.predict.sampling import bent, sampled
from tests.pipeline.predict.bench import IDS, bench, fitted
from vjm.effects import catalogue


def played() -> Tangent:
    """A play of 5 µm in each base hinge, known to 0.05 µm, on the rows of the bench."""
    clearance = catalogue()["joint_clearance"]
    model = Model((Term(clearance, {"play_mm": 5e-3}),))
    size = abs(clearance.parameters[0].typical)
    slopes = np.array([[size / 5e-5]])
    return Tangent.of(Posterior(model, (), np.zeros(0), slopes), load_cases(bench()))


@pytest.mark.long
def test_samples_of_a_straight_model_are_its_tangent() -> None:
    """Standard deviations of 60 samples scatter by 9 %, ends of intervals by somewhat more."""
    at = Tangent.of(Posterior.of(fitted().fit), load_cases(bench()))
    wanted = at.cases.predicted
    assert not bent(at, wanted, seed=1).any()
    whole = sampled(at, np.ones(len(IDS), dtype=bool), seed=1)
    linear = at.bands()
    half = 0.5 * (linear.high - linear.low)[wanted]
    assert whole.sampled.all() and not linear.sampled.any()
    for mine, its in ((whole.low, linear.low), (whole.high, linear.high), (whole.value, linear.value)):
        assert np.sqrt(np.mean(((mine - its)[wanted] / half) ** 2)) < 0.2
    ratio = 0.5 * (whole.high - whole.low)[wanted] / half
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.03)


def test_a_play_leaves_its_tangent_where_the_load_passes_it() -> None:
    """Along the bars the load passes zero and the play is crossed; moved sideways, the bars stay where they are pulled
    or have no load at all, which is in the play too. What is bent is sampled, the rest is not."""
    at = played()
    tests = bent(at, at.cases.predicted, seed=1)
    assert tests[IDS.index("axial_held_q+0")]
    again = bent(at, at.cases.predicted, seed=1)
    np.testing.assert_array_equal(tests, again)
    some = np.zeros(len(IDS), dtype=bool)
    some[0] = True
    found, linear = sampled(at, some, seed=1, count=12), at.bands()
    np.testing.assert_array_equal(found.sampled, some[at.cases.test])
    kept = ~found.sampled
    np.testing.assert_array_equal(found.low[kept], linear.low[kept])
    assert np.all(found.high[found.sampled][:, 0] > found.low[found.sampled][:, 0])
    assert not np.array_equal(found.low[found.sampled], linear.low[found.sampled])
    same = sampled(at, some, seed=1, count=12)
    np.testing.assert_array_equal(found.high, same.high)
    other = sampled(at, some, seed=2, count=12)
    assert not np.array_equal(found.high[found.sampled], other.high[found.sampled])
