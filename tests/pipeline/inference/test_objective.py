"""What a fit makes least is a function: the same parameters, the same value, wherever an evaluation begins."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.assessment.coverage.cases import BASE, typical
from pipeline.assessment.coverage.trial import campaign
from pipeline.inference.contact_branches import begun
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.settings import INPUTS
from tests.pipeline.inference import manipulators
from tests.pipeline.inference.test_contact_branches import cases, model
from vjm.effects import catalogue


def off(there: Evaluation) -> float:
    """Sigmas from the inputs that fit best to those near which it was linearised, at most."""
    sigma = there.objective.load_cases.input_sigma
    return float(
        np.max(np.abs(there.residual.shift - there.prediction.shift)[sigma > 0.0] / sigma[sigma > 0.0])
    )


def total(there: Evaluation) -> float:
    return float(there.residuals @ there.residuals)


@pytest.mark.parametrize(
    "names",
    [
        ("modulus_error",),
        pytest.param(("thermal_expansion",), marks=pytest.mark.long),
        pytest.param(("base_compliance",), marks=pytest.mark.long),
        pytest.param(("joint_friction",), marks=pytest.mark.long),
        pytest.param(("joint_clearance",), marks=pytest.mark.long),
        pytest.param(("joint_clearance", "joint_friction"), marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("size", [0.03, pytest.param(1.0, marks=pytest.mark.long)])
def test_the_same_parameters_give_the_same_value_wherever_it_begins(
    names: tuple[str, ...], size: float
) -> None:
    """From nowhere, from the model without the effects, from sizes far larger, and from itself: at sizes like the noise
    and at typical ones; after friction too, and with rows that choose their sides."""
    hidden = typical(names)
    tests = load_cases(campaign(tuple(hidden.items()), 3, 8))
    it = Model().with_effects([catalogue()[name] for name in (BASE, *names)])
    aim = Objective(it, tests)
    null = np.array([each.parameter.null for each in it.free])
    way = np.array([hidden[each.name] for each in it.free]) - null
    values = null + size * way
    plain = fit(Model().with_effects([catalogue()[BASE]]), tests)
    larger = aim.at(np.clip(null + 1.7 * way, *np.array([each.bounds for each in it.free]).T))
    first = aim.at(values)
    assert first.settled
    for near in (plain.prediction, larger.prediction, first.prediction):
        again = aim.at(values, near)
        assert abs(total(again) - total(first)) < 2.0 * INPUTS.same * max(
            1.0, total(first) / first.residuals.size
        )


def test_an_evaluation_ends_near_the_inputs_that_fit_best() -> None:
    """Slopes at the measured temperatures are small by the noise in them: 0.8 standard errors of 0.4 %."""
    tests = cases("thermal_expansion", 1)
    began = Model().with_effects([catalogue()[each] for each in (BASE, "thermal_expansion")])
    found = fit(began, tests)
    there = Objective(found.model, tests).at(found.model.values, found.prediction)
    assert there.settled and off(there) <= INPUTS.near and there.rounds == 1
    sigma = np.where(tests.input_sigma > 0.0, tests.input_sigma, np.inf)
    assert np.max(np.abs(found.residual.shift - found.prediction.shift) / sigma) <= INPUTS.near
    # At the measured inputs themselves, where one without a start begins, noise alone is several sigmas off.
    rough = Objective(found.model, tests).at(found.model.values, within=np.inf)
    assert off(rough) > 1.0 and rough.rounds == 1 and not rough.settled
    assert off(rough.settle()) <= INPUTS.near


def test_a_value_that_may_be_off_costs_no_more_than_it_must() -> None:
    tests = cases("thermal_expansion", 1)
    aim = Objective(model("thermal_expansion"), tests)
    rough, exact = (aim.at(aim.model.values, within=within) for within in (np.inf, 0.0))
    assert rough.rounds < exact.rounds
    assert rough.with_slopes is rough and exact.with_slopes.jacobian.shape == (exact.residuals.size, 1)
    quick = aim.at(aim.model.values, slopes=False)
    assert quick.prediction.by_free.shape[-1] == 0
    np.testing.assert_allclose(
        quick.jacobian, exact.jacobian, rtol=1e-4, atol=1e-6 * np.abs(exact.jacobian).max()
    )


def test_derivatives_are_those_of_the_value() -> None:
    """Of chi-square, with the true inputs found again at both ends: the envelope theorem."""
    tests = cases("thermal_expansion", 1)
    aim = Objective(model("thermal_expansion"), tests)
    value, step = aim.model.values[0], 0.02 * aim.model.values[0]
    there = aim.at(np.array([value]))
    ends = [total(aim.at(np.array([value + way * step]), there.prediction)) for way in (-1.0, 1.0)]
    slope = 2.0 * float((there.jacobian.T @ there.residuals)[0])
    curvature = 2.0 * float((there.jacobian.T @ there.jacobian)[0, 0])
    assert (ends[1] - ends[0]) / (2.0 * step) == pytest.approx(slope, abs=0.02 * curvature * step)


def test_where_fits_begin() -> None:
    """At the inputs of their start, but at the measured ones where laws begin to remember."""
    tests = cases("thermal_expansion", 1)
    plain, friction = (fit(Model().with_effects([catalogue()[n]]), tests) for n in (BASE, "joint_friction"))
    assert begun(plain.model, tests, None) is None
    assert begun(model("modulus_error"), tests, plain.prediction) is plain.prediction.shift
    assert begun(model("joint_friction"), tests, plain.prediction) is None
    both = Model().with_effects([catalogue()[n] for n in (BASE, "joint_friction", "joint_clearance")])
    assert begun(both, tests, friction.prediction) is friction.prediction.shift


def test_with_friction_a_manipulator_begins_at_the_measured_inputs() -> None:
    tests = load_cases(manipulators.campaign())
    plain = fit(Model(), tests)
    friction = Model().with_effects([catalogue()["joint_friction"]])
    assert begun(Model(), tests, plain.prediction) is plain.prediction.shift
    assert begun(friction, tests, plain.prediction) is None
