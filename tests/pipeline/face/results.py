"""One small result of each kind: a bench of one load step, records by hand where a search would take long."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

import parastiff
from parastiff import Addition, BarStiffness, Diagnosis, Discovery
from pipeline.answer import Answer, ModelError, TestChange, TestNoise
from pipeline.discover.record import Discovered
from pipeline.face.shown import Shown
from pipeline.inference.model import Model
from pipeline.value import Value
from tests.conftest import ROOT
from vjm import paper

CASES = ROOT / "tests" / "cases" / "data"
ONE_STEP = CASES / "t01_next_test_lstsq"
TEST = "q = 30°, moved along z, there and back to ±4.69 mm"


@cache
def bench() -> parastiff.Bench:
    return parastiff.open(ONE_STEP)


def error(fit: float, *effects: str) -> ModelError:
    return ModelError(
        effects=effects, fit=fit, holdout=None, chi_square=9.0, degrees=9, chi_square_p=None, lag_one_p=None
    )


def value(number: float) -> Value:
    return Value(
        value=number,
        std=0.1,
        low95=number - 0.2,
        high95=number + 0.2,
        interval="wald",
        unit="1",
        meaning="size",
    )


def answer(**keys: object) -> Answer:
    given: dict[str, object] = {
        "campaign": "by hand",
        "verdict": "ambiguous",
        "effects": ("modulus_error",),
        "added": ("modulus_error",),
        "alternatives": (("self_weight",),),
        "parameters": {"modulus_error.scale": value(0.9)},
        "error": (error(17.5), error(0.98, "modulus_error")),
        "next_test": {"why": TEST},
        "sentences": ("ambiguous: modulus_error or self_weight; these tests cannot tell.",),
    }
    return Answer.model_validate({**given, **keys})


@cache
def ambiguous() -> Diagnosis:
    known = bench().subject.known.effects
    models = tuple(Model().with_effects([known[name]]) for name in ("modulus_error", "self_weight"))
    return Diagnosis(bench().subject, answer(), (("modulus_error",), ("self_weight",)), models)


@cache
def added() -> Addition:
    return bench().add("modulus_error")


def many_tests() -> Addition:
    """Forty tests with long names."""
    noise = TestNoise(rms=3.2, chi_square_p=0.0, lag_one_p=0.0, lost=0)
    tests = tuple(
        TestChange(
            test=f"posture {k} {'of a long name ' * 6}",
            q_deg=0.0,
            role="fit",
            rows=3,
            before=noise,
            after=noise,
        )
        for k in range(40)
    )
    parameters = {f"an_effect_{k}.of_a_long_name_{'x' * 40}": value(1.0) for k in range(60)}
    found = answer(
        campaign="a campaign " * 20, tests=tests, parameters=parameters, sentences=("word " * 2000,) * 40
    )
    return replace(added(), answer=found)


def nothing_discovered() -> Discovery:
    record = Discovered(
        campaign="by hand",
        laws=(),
        geometry=False,
        entered=(),
        error=(error(3.0),),
        whole=True,
        next_site=None,
        next_evidence=0.0,
        sentences=("No law is found.",),
    )
    return Discovery(bench().subject, record, (), "")


def bar() -> parastiff.OwnBar:
    return parastiff.bar(parastiff.sections.Rectangle(10.0, 16.0), 250.0, 70e3, 0.33, lug=(15.0, 14.0, 20.0))


def stiffness() -> BarStiffness:
    return BarStiffness(
        np.array(paper.BAR_STIFFNESS), 310.0, 0.01, np.array(paper.BAR_STIFFNESS) * 0.9, "a bar"
    )


def linkage() -> parastiff.Linkage:
    rig = parastiff.rigs.parallelogram(length_mm=310.0, width_mm=80.0, bar_stiffness=paper.BAR_STIFFNESS)
    return parastiff.linkage(rig, 30.0)


RESULTS: dict[str, Callable[[], Shown]] = {
    "bench": bench,
    "ambiguous": ambiguous,
    "addition": added,
    "addition of many tests": many_tests,
    "comparison": cache(lambda: bench().compare()),
    "plan": cache(lambda: bench().plan()),
    "discovery": nothing_discovered,
    "catalogue": parastiff.catalogue,
    "bar": bar,
    "stiffness": stiffness,
    "linkage": linkage,
    "virtual bench": lambda: parastiff.VirtualBench(bench().subject, {"effects": ["joint_friction"]}),
}
