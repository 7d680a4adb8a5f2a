"""The prior of sizes is one: what a fit makes least is what the costs of sets compare; first-order estimates have it in
`tests/pipeline/selection/test_first_order.py`."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.inference.model import Model
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.prior import implausibility
from pipeline.inference.solvers import Pulled
from vjm.effects import catalogue

PLAUSIBLE = 7.0


def model() -> Model:
    """Four parameters at 3, -4, 12 and 0 typical sizes from where their effects are absent."""
    known = catalogue()
    made = Model().with_effects([known["modulus_error"], known["load_misalignment"]])
    sizes = np.array([3.0, -4.0, 12.0, 0.0])
    values = [f.parameter.null + k * f.parameter.typical for f, k in zip(made.free, sizes, strict=True)]
    return made.at(np.array(values))


def test_fit_and_cost_have_the_same_prior() -> None:
    it = model()
    expected = (9.0 + 16.0 + 144.0) / PLAUSIBLE**2
    assert implausibility(it.free, it.values, PLAUSIBLE) == pytest.approx(expected, rel=1e-12)
    # What the solvers make least, of a campaign without readings.
    aim = cast(Objective, SimpleNamespace(model=it))
    there = cast(Evaluation, SimpleNamespace(residuals=np.zeros(0), values=it.values))
    pulled = Pulled.of(aim, PLAUSIBLE).residuals(there)
    assert float(pulled @ pulled) == pytest.approx(expected, rel=1e-12)
