"""Numbers of effects that change what sensors read, and nothing that bears load."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.coverage.trial import campaign
from pipeline.inference.model import Free, Model
from pipeline.inference.prediction import predict
from pipeline.inference.program import program
from pipeline.simulate import bench_rig
from vjm.effects import catalogue
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


def every() -> Model:
    """All effects of the catalogue that go together, and one that is both."""
    left_out = {"material_yield", "joint_friction", "joint_clearance"}
    known = [effect for name, effect in catalogue().items() if name not in left_out]
    return Model().with_effects([*known, HeavyHinge()])


def reads_alone(model: Model, free: Free) -> bool:
    value = free.parameter.null + free.parameter.typical
    return model.reads_alone(free, value, bench_rig(), ())


def test_what_is_known_to_act_at_the_sensors_does() -> None:
    model = every()
    found = {each.name for each in model.free if reads_alone(model, each)}
    expected = {each.name for each in model.free if each.effect in AT_SENSORS}
    assert found == expected | {f"self_weight.platform_{n}_N" for n in "xyz"}


def test_derivatives_are_those_of_linkages_built_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """To the rounding of differences of the residual, in sigmas of what is read."""
    cases = program(campaign((("modulus_error.scale", 0.9),), 1, 6))
    found = predict(every(), cases).by_free
    monkeypatch.setattr(Model, "reads_alone", lambda *_: False)
    expected = predict(every(), cases).by_free
    size = np.abs(expected).max(axis=(0, 1))
    assert np.all(size > 0.0)
    np.testing.assert_allclose(found / size, expected / size, rtol=0, atol=1e-7)
