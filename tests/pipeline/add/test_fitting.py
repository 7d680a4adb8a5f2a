"""Adding effects: hidden errors of a finite-element bench come back, and what cannot be had is refused."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from rich.console import Console

from pipeline.add.fitting import Added, add
from pipeline.answer.record import Answer
from pipeline.answer.tables.added import bar, show
from pipeline.campaign import Campaign
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.terminal import WIDTH
from tests.pipeline.bench import bench
from vjm.effects import catalogue

EFFECTS = catalogue()
HIDDEN = {
    "modulus_error.scale": 0.95,
    "bar_length_mismatch.mismatch_mm": 0.05,
    "thermal_expansion.alpha_per_K": 2.3e-5,
}


def added(campaign: Campaign, *names: str, before: tuple[str, ...] = ()) -> Added:
    model = Model().with_effects([EFFECTS[name] for name in before])
    return add(campaign, model, [EFFECTS[name] for name in names])


@cache
def found(parameter: str) -> Answer:
    effect = parameter.partition(".")[0]
    return added(bench(parameter, HIDDEN[parameter]), "bar_geometric_nonlinearity", effect).answer


@pytest.mark.parametrize(
    "parameter",
    [
        pytest.param(it, marks=pytest.mark.long if it == "thermal_expansion.alpha_per_K" else [])
        for it in HIDDEN
    ],
)
def test_a_hidden_error_comes_back_and_what_is_left_is_noise(parameter: str) -> None:
    """One seed each: within four standard errors, which noise exceeds once in 16000."""
    answer, truth = found(parameter), HIDDEN[parameter]
    value = answer.parameters[parameter]
    assert value.std is not None and value.low95 is not None and value.high95 is not None
    assert abs(value.value - truth) < 4.0 * value.std
    assert value.low95 < value.value < value.high95
    assert answer.verdict == "within_noise" and answer.sentences[0].startswith("within_noise: ")
    before, after = answer.error
    assert before.effects == () and after.effects == answer.effects == answer.added
    assert before.fit > 2.0 > 1.2 > after.fit
    assert after.holdout is not None and before.holdout is not None and after.holdout < 1.3


def test_the_wrong_effect_does_not_make_noise_of_it() -> None:
    campaign = bench("self_weight.platform_y_N", 4.0)
    answer = added(campaign, "modulus_error", before=("bar_geometric_nonlinearity",)).answer
    assert answer.verdict == "unknown" and "what is left is no noise" in answer.sentences[0]
    assert any("too narrow" in sentence for sentence in answer.sentences)
    assert answer.error[0].effects == ("bar_geometric_nonlinearity",) and answer.added == ("modulus_error",)


def test_held_out_tests_are_never_fitted() -> None:
    """Nonsense in a held-out test moves its own error and not a digit of anything else."""
    campaign = bench("modulus_error.scale", 0.95)
    tests = []
    for test in campaign.tests:
        data = test.data
        if test.role == "holdout":
            data = replace(data, displacement=data.displacement + 0.05 * (np.array(test.control) == "force"))
        tests.append(replace(test, data=data))
    spoilt = added(replace(campaign, tests=tuple(tests)), "modulus_error").answer
    clean = added(campaign, "modulus_error").answer
    assert spoilt.parameters == clean.parameters
    assert spoilt.error[-1].fit == clean.error[-1].fit and spoilt.verdict == clean.verdict
    assert (spoilt.error[-1].holdout or 0.0) > 2.0 * (clean.error[-1].holdout or np.inf)


def test_an_absent_effect_has_an_interval_that_begins_at_null() -> None:
    answer = added(bench(), "joint_torsional_stiffness", before=("bar_geometric_nonlinearity",)).answer
    (value,) = answer.parameters.values()
    assert answer.verdict == "within_noise" and value.low95 == 0.0
    # A hinge spring of its typical size would be seen at once.
    assert value.high95 is not None and 0.0 < value.high95 < 0.2 * 2e4
    assert value.interval == "profile"


def test_what_cannot_be_told_apart_is_said() -> None:
    """Along the bars alone a soft bar is a soft axis, physics.md's first row."""
    campaign = bench("modulus_error.scale", 0.95, gauges=False)
    axial = tuple(test for test in campaign.tests if test.id == "axial_held_q+0")
    answer = added(replace(campaign, tests=axial), "modulus_error", "axis_flexibility").answer
    names = {"modulus_error.scale", "axis_flexibility.radial_mm_per_N"}
    together = any(names <= set(group) for group in answer.undetermined)
    paired = any({pair.first, pair.second} == names for pair in answer.correlations)
    assert together or paired
    assert "axis_flexibility.tilt_rad_per_Nmm" in {name for group in answer.undetermined for name in group}
    assert any("axis_flexibility" in s and ("told apart" in s or "determined" in s) for s in answer.sentences)


REFUSED = {
    "there already": (("modulus_error",), ("modulus_error",), "modulus_error is in the model already"),
    "no temperature": (("thermal_expansion",), (), "thermal_expansion needs temperatures, none was measured"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_an_effect_that_cannot_be_had_is_refused(case: str) -> None:
    names, before, said = REFUSED[case]
    campaign = bench()
    cold = tuple(replace(test, data=replace(test.data, temperature=None)) for test in campaign.tests)
    with pytest.raises(InputError, match=said):
        added(replace(campaign, tests=cold), *names, before=before)


def test_the_answer_is_json_with_the_keys_of_every_answer() -> None:
    answer = found("modulus_error.scale")
    raw = json.loads(answer.text())
    assert {"campaign", "verdict", "effects", "alternatives", "parameters", "error", "candidates"} <= set(raw)
    assert {"confusable", "next_test", "seconds", "versions", "tests", "correlations"} <= set(raw)
    assert set(raw["parameters"]["modulus_error.scale"]) >= {"value", "std", "low95", "high95"}
    assert {"effects", "fit", "holdout"} <= set(raw["error"][0])
    assert raw["candidates"] == [] and raw["next_test"] is None
    assert Answer.model_validate_json(answer.text()) == answer


@pytest.mark.parametrize("quiet", [False, True])
def test_the_table_fits_its_columns(quiet: bool) -> None:
    answer = found("bar_length_mismatch.mismatch_mm")
    out = io.StringIO()
    show(
        answer, "bench/model.toml", ["python -m pipeline compare bench"], quiet, Console(file=out, width=200)
    )
    text = out.getvalue()
    assert max(map(len, text.splitlines())) <= WIDTH
    assert "mismatch_mm" in text and "within_noise: " in text
    assert ("axial_held_q+15" in text and "next: python" in text) is not quiet


def test_bars_are_to_scale() -> None:
    assert bar(8.0, 2.0, 8.0, 24).plain == "█" * 6 + "░" * 18
    assert bar(4.0, 1.0, 8.0, 24).plain == "█" * 3 + "░" * 9
    assert bar(1.0, 9.0, 8.0, 24).plain == "█" * 24
    assert bar(None, 1.0, 8.0, 24).plain == ""
    # Decades from 0.1 to 100: an error of 10 is two thirds of the way, noise one third.
    assert bar(10.0, 1.0, 100.0, 24).plain == "█" * 8 + "░" * 8
    assert bar(0.01, 0.01, 100.0, 24).plain == ""


@pytest.mark.long
def test_a_model_without_any_prediction_is_no_answer() -> None:
    """1 MN of compression is thirty times what the straight bars carry; lumped springs do not mind."""
    campaign = bench()
    test = next(test for test in campaign.tests if test.id == "axial_held_q+0")
    wrench = test.data.wrench.copy()
    wrench[:, 0] = -1e6
    pushed = replace(campaign, tests=(replace(test, data=replace(test.data, wrench=wrench)),))
    found = added(pushed, "bar_geometric_nonlinearity")
    assert found.answer.verdict == "unknown" and found.keep
    assert "The model is not saved: it has no prediction for any fitted row." in found.answer.sentences
    assert any("no prediction" in said for said in found.answer.error[-1].lost)
