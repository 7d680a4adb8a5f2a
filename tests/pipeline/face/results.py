"""One small result of each kind: a bench of one load step, records by hand where a search would take long."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
from pandas import DataFrame

import parastiff
from parastiff import Addition, BarStiffness, Diagnosis, Discovery, Prediction
from pipeline.answer.law import Curve, Grouped, LawFound
from pipeline.answer.record import Answer, ModelError, TestChange, TestNoise
from pipeline.answer.value import Value
from pipeline.discover.record import Discovered
from pipeline.discover.recording import where
from pipeline.face.shown import Shown
from pipeline.inference.model import Model
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


def law(**keys: object) -> LawFound:
    """A bushing that stiffens, y = k1 x + k3 x³, with noisy load steps of which one is far off."""
    x = np.linspace(-0.8, 0.8, 41)
    y = 40.0 * x + 90.0 * x**3
    own = y + np.random.default_rng(1).normal(0.0, 4.0, x.size)
    own[3] = 4000.0
    curve = Curve(
        x_unit="mm",
        y_unit="N",
        x=tuple(x),
        y=tuple(y),
        free_x=tuple(x),
        free=tuple(y + 2.0 * np.sin(6.0 * x)),
        low=tuple(y - 6.0),
        high=tuple(y + 6.0),
        own_x=tuple(x),
        own_y=tuple(own),
    )
    given: dict[str, object] = {
        "site": "along@base",
        "where": where("along@base"),
        "group": (Grouped(site="along@base.1", evidence=-0.8),),
        "form": "cubic",
        "equation": "y = k1 x + k3 x^3",
        "parameters": {"k1": value(40.0), "k3": value(90.0)},
        "evidence": 180.0,
        "margin": 22.0,
        "left_out": 90.0,
        "ties": (),
        "range": (-0.8, 0.8),
        "fit": 1.02,
        "holdout": 1.1,
        "shape": "odd, and steeper with the coordinate",
        "curve": curve,
    }
    return LawFound.model_validate({**given, **keys})


@cache
def by_law() -> Diagnosis:
    """Nothing known explains it, a law at one place does."""
    found = answer(
        verdict="unknown",
        effects=(),
        added=(),
        alternatives=(),
        parameters={},
        error=(error(17.5),),
        laws=(law(),),
        sentences=("unknown: no effect of the catalogue explains what is left.",),
    )
    return Diagnosis(bench().subject, found, ((),), (Model(),))


def law_discovered() -> Discovery:
    record = nothing_discovered().record.model_copy(
        update={"laws": (law(),), "error": (error(17.5), error(1.02)), "sentences": ("It sits here.",)}
    )
    return Discovery(bench().subject, record, ("along_base_law",), "# an effect file")


@cache
def asked() -> Prediction:
    return bench().predict(at=DataFrame({"fy_N": [1.0, 2.0], "fz_N": [0.0, 3.0]}))


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
    "prediction": cache(lambda: bench().predict()),
    "prediction of load cases": asked,
    "discovery": nothing_discovered,
    "discovery of a law": law_discovered,
    "diagnosis with a law": by_law,
    "catalogue": parastiff.catalogue,
    "bar": bar,
    "stiffness": stiffness,
    "linkage": linkage,
    "virtual bench": lambda: parastiff.VirtualBench(bench().subject, {"effects": ["joint_friction"]}),
}
