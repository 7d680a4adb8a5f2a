"""Numbers of effects that change what sensors read, and nothing that bears load."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.coverage.trial import campaign
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Free, Model
from pipeline.inference.prediction import predict
from pipeline.simulate import bench_rig
from vjm.effects import catalogue, for_kind
from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.laws import Polynomial
from vjm.sensors import DeadWeight

AT_SENSORS = {"base_compliance", "load_misalignment", "load_offset"}


class HeavyHinge(Effect):
    """A weight and a spring in one number."""

    name, title, equation, signature = "heavy_hinge", "heavy hinge", "W = c, M = c angle", "both"
    limits, source = "none", "none"
    parameters = (Parameter("c", "N", 0.0, 1.0, 0.0, 10.0, "weight and stiffness"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        c = values["c"]
        sensors = (*rig.sensors, DeadWeight(np.array([0.0, 0.0, -c])))
        return replace(rig, sensors=sensors, hinges=(*rig.hinges, Polynomial((100.0 * c,))))


class Counterweight(Effect):
    """Hangs on the bars what hangs on the platform: a load that follows from the sensors."""

    name, title, equation, signature = "counterweight", "counterweight", "w = share W / L", "a line load"
    limits, source = "none", "none"
    parameters = (Parameter("share", "", 0.0, 0.5, 0.0, 1.0, "of the platform's weight"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        weights = [sensor.force for sensor in rig.sensors if isinstance(sensor, DeadWeight)]
        return replace(rig, line_load=rig.line_load + values["share"] * np.sum(weights, axis=0) / rig.length)


def every() -> Model:
    """One that is both, and all effects of the catalogue that go together."""
    left_out = {"material_yield", "joint_friction", "joint_clearance"}
    known = [effect for name, effect in for_kind("parallelogram").items() if name not in left_out]
    return Model().with_effects([HeavyHinge(), *known])


def reads_alone(model: Model, free: Free) -> bool:
    value = free.parameter.null + 0.7 * free.parameter.typical
    return model.reads_alone(free, value, bench_rig(), ())


def test_what_is_known_to_act_at_the_sensors_does() -> None:
    model = every()
    found = {each.name for each in model.free if reads_alone(model, each)}
    expected = {each.name for each in model.free if each.effect in AT_SENSORS}
    assert found == expected | {f"self_weight.platform_{n}_N" for n in "xyz"}


def test_before_an_effect_that_looks_at_the_sensors_they_are_not_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    cases = load_cases(campaign((("modulus_error.scale", 0.9),), 1, 6))
    model = Model().with_effects([catalogue()["self_weight"], Counterweight()])
    model = model.at(np.array([each.parameter.null + each.parameter.typical for each in model.free]))
    assert not any(reads_alone(model, each) for each in model.free)
    found = predict(model, cases).by_free
    monkeypatch.setattr(Model, "reads_alone", lambda *_: False)
    np.testing.assert_array_equal(found, predict(model, cases).by_free)


@pytest.mark.long
def test_derivatives_are_those_of_linkages_built_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """To the rounding of differences of the residual, in sigmas of what is read."""
    cases = load_cases(campaign((("modulus_error.scale", 0.9),), 1, 6))
    found = predict(every(), cases).by_free
    monkeypatch.setattr(Model, "reads_alone", lambda *_: False)
    expected = predict(every(), cases).by_free
    size = np.abs(expected).max(axis=(0, 1))
    assert np.all(size > 0.0)
    np.testing.assert_allclose(found / size, expected / size, rtol=0, atol=1e-7)
