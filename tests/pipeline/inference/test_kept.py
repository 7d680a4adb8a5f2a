"""Answers that are kept: as long as what they are about, by all that was asked; mechanisms by what they are made of."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from pipeline.inference.kept import kept
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.suitable import named_effects
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue
from vjm.effects.base import Effect, Parameter, Rig, Values


class About:
    """Something that is asked about."""


def test_an_answer_is_found_once_and_goes_with_what_it_is_about() -> None:
    asked: list[int] = []

    @kept
    def twice(about: About, number: int) -> int:
        asked.append(number)
        return 2 * number

    one, other = About(), About()
    assert [twice(one, 3), twice(one, 3), twice(one, 4), twice(other, 3)] == [6, 6, 8, 6]
    assert asked == [3, 4, 3]
    seen = weakref.ref(one)
    del one
    gc.collect()
    assert seen() is None


def test_a_mechanism_is_built_once_for_the_same_values() -> None:
    cases = load_cases(bench())
    it, group = Model().with_effects(named_effects(["modulus_error"], catalogue())), cases.groups[0]
    gauges = cases.campaign.gauges
    first = it.mechanism(group, gauges)
    assert it.at(it.values).mechanism(cases.only(np.arange(4)).groups[0], gauges) is first
    assert it.at(1.01 * it.values).mechanism(group, gauges) is not first
    assert it.mechanism(group, gauges[:0]) is not first


class Own(Effect):
    """An effect of a user."""

    kinds = ("parallelogram", "bar")
    title = equation = signature = limits = source = "of a test"
    name = "own"
    parameters = (Parameter("load", "N/mm", 0.0, 1e-2, -1.0, 1.0, "line load along z"),)


class InPlace(Own):
    """One that writes to what it is given."""

    def change(self, rig: Rig, values: Values) -> Rig:
        load = rig.line_load
        load[2] -= values["load"]
        return replace(rig, line_load=load)


@dataclass
class OfNumbers(Own):
    """One that compares by its numbers, which may change."""

    factor: float = 1.0

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(
            rig, line_load=rig.line_load - self.factor * values["load"] * np.array([0.0, 0.0, 1.0])
        )


@pytest.mark.parametrize("kind", [InPlace, OfNumbers])
def test_effects_of_others_are_applied_anew(kind: Callable[[], Own]) -> None:
    cases, effect = load_cases(bench()), kind()
    it = Model().with_effects([effect]).at(np.array([1e-2]))
    values = [predict(it, cases, slopes=False).values for _ in range(3)]
    np.testing.assert_array_equal(values[1], values[0])
    np.testing.assert_array_equal(values[2], values[0])
    if isinstance(effect, OfNumbers):
        effect.factor = 2.0
        assert np.any(predict(it, cases, slopes=False).values != values[0])
