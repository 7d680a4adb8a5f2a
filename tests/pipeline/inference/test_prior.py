"""The prior of sizes is one: what a fit makes least is what the costs of sets compare; first-order estimates have it in
`tests/pipeline/selection/test_first_order.py`."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.inference.model import Model
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.prior import TAIL, held_back, implausibility, residual, slope
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
    assert 12.0 / PLAUSIBLE < TAIL
    assert implausibility(it.free, it.values, PLAUSIBLE) == pytest.approx(expected, rel=1e-12)
    # What the solvers make least, of a campaign without readings.
    aim = cast(Objective, SimpleNamespace(model=it))
    there = cast(Evaluation, SimpleNamespace(residuals=np.zeros(0), values=it.values))
    pulled = Pulled.of(aim, PLAUSIBLE).residuals(there)
    assert float(pulled @ pulled) == pytest.approx(expected, rel=1e-12)


def test_the_tail_is_that_of_a_power_law_and_begins_smoothly() -> None:
    """Twice as far is less likely by a factor of 2^4, however far; value and slope are continuous where it begins."""
    far = np.array([10.0, 1e3, 1e6])
    rise = residual(2.0 * far) ** 2 - residual(far) ** 2
    np.testing.assert_allclose(np.exp(-rise / 2.0), 2.0**-4, rtol=1e-9)
    near = np.array([-TAIL, -0.3, 0.0, 1.0, TAIL])
    np.testing.assert_array_equal(residual(near), near)
    np.testing.assert_array_equal(slope(near), np.ones(5))
    np.testing.assert_allclose(residual(near * (1.0 + 1e-9)), near, atol=1e-8)
    np.testing.assert_allclose(slope(near * (1.0 + 1e-9)), np.ones(5), atol=1e-8)


def test_its_slope_is_its_derivative_on_both_sides() -> None:
    at = np.array([-50.0, -3.0, -1.0, 0.5, 2.5, 400.0])
    step = 1e-6 * np.abs(at)
    np.testing.assert_allclose(
        (residual(at + step) - residual(at - step)) / (2.0 * step), slope(at), rtol=1e-6
    )


@pytest.mark.parametrize(("readings", "held"), [(1e6, 0.0), (1.0, 0.5)])
def test_what_a_number_is_held_back_by(readings: float, held: float) -> None:
    """One number a standard deviation from its nominal value, and one at it: readings that determine it well have it as
    they want it; where they see a deviation as one sigma, the prior and they share the way, and half of it is left."""
    it = model()
    values = np.array([f.parameter.null for f in it.free])
    values[0] += PLAUSIBLE * it.free[0].parameter.typical
    sizes = np.array([f.parameter.typical * PLAUSIBLE for f in it.free])
    jacobian = np.diag(readings / sizes)
    assert held_back(it.free, values, PLAUSIBLE, jacobian) == pytest.approx(held, abs=1e-9)
