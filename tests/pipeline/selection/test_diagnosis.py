"""Diagnoses of campaigns that the finite elements made: a name, a set, or a refusal, and never a wrong name."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest
from typer.testing import CliRunner

from pipeline.answer.of_diagnosis import answer_of, answered
from pipeline.answer.record import Answer
from pipeline.campaign import Campaign, write
from pipeline.cli import app
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import Diagnosis, diagnose
from tests.pipeline.selection.bench import AXIAL, bench, growing_gain, with_fault
from tests.studio.ahead import unmeasured
from vjm.effects import catalogue

EFFECTS = catalogue()
LARGE = "bar_geometric_nonlinearity"


def found(campaign: Campaign) -> Diagnosis:
    return diagnose(campaign, Model(), EFFECTS)


@cache
def axial() -> Diagnosis:
    return found(bench("axis_flexibility.radial_mm_per_N", 3e-6, AXIAL))


def test_nothing_but_what_every_bench_has() -> None:
    it = found(bench())
    assert it.verdict == "identified"
    assert it.sets == ((LARGE,),)


def test_small_loads_need_nothing() -> None:
    it = found(bench(ids=("axial_held_q+0", "axial_held_q+15")))
    assert it.verdict == "within_noise"
    assert it.sets == ((),)
    assert answered(it).sentences[0].startswith("within_noise: the model explains the measurements")


@pytest.mark.long
def test_held_out_tests_tell_of_physics_that_the_fitted_ones_do_not_show() -> None:
    """6 mm sideways shorten the linkage by 70 µm; under axial loads nothing tells of it."""
    it = found(bench(ids=("axial_held_q+0", "lateral_q-15")))
    assert it.verdict == "identified" and it.sets == ((LARGE,),)
    assert any("those held out need it" in said for said in answered(it).sentences)
    # What has a number is not theirs to choose.
    softer = found(bench("modulus_error.scale", 0.9, ids=("swing_q+0", "axial_held_q+15")))
    assert softer.verdict == "unknown"


@pytest.mark.long
def test_numbers_of_what_explains_little_are_worth_no_solutions() -> None:
    """An offset of the load, of which only a misalignment is known: it helps, and noise is far."""
    tests = bench("load_offset.y_mm", 9.0, ids=("swing_q+0", "lateral_q+0", "axial_guided_q+0"))
    it = diagnose(tests, Model(), {name: EFFECTS[name] for name in (LARGE, "load_misalignment")})
    assert it.verdict == "unknown" and it.sets == ((LARGE, "load_misalignment"),)
    answer = answer_of(it)
    assert answer.evaluations == it.cache.evaluations
    assert [value.interval for value in answer.parameters.values()] == ["wald"] * 3
    assert answer_of(axial()).evaluations > axial().cache.evaluations, "what explains it is"


def test_of_what_is_not_measured_yet_nothing_is_tested() -> None:
    it = diagnose(unmeasured(), Model(), catalogue())
    assert it.verdict == "nothing_tested" and it.sets == ((),)
    assert (
        answered(it).sentences[0].startswith("nothing_tested: not measured yet: no fitted test has a reading")
    )


@pytest.mark.long
def test_friction_is_named() -> None:
    it = found(bench("joint_friction.torque_Nmm", 200.0, ("swing_q+0", "axial_held_q+0", "axial_held_q+15")))
    assert it.verdict == "identified"
    assert "joint_friction" in it.sets[0]
    value = dict(zip([f.name for f in it.model.free], it.model.values, strict=True))[
        "joint_friction.torque_Nmm"
    ]
    std = dict(zip([f.name for f in it.model.free], it.fit.std, strict=True))["joint_friction.torque_Nmm"]
    assert abs(value - 200.0) < 3 * std
    assert any("Only tests at q = 0° show it (swing_q+0):" in said for said in answered(it).sentences)


@pytest.mark.long
def test_what_several_angles_show_is_there_at_all_of_them() -> None:
    everywhere = found(
        bench("joint_friction.torque_Nmm", 200.0, ("swing_q+0", "swing_q+30", "axial_held_q+0"))
    )
    assert "joint_friction" in everywhere.sets[0]
    assert not any("Only tests at q" in said for said in answered(everywhere).sentences)
    # One angle is all that there is: nothing was left out.
    one = found(bench("joint_friction.torque_Nmm", 200.0, ("swing_q+0", "axial_held_q+0")))
    assert "joint_friction" in one.sets[0]
    assert not any("Only tests at q" in said for said in answered(one).sentences)


def test_axial_tests_alone_cannot_tell() -> None:
    """Modulus, axis and base look alike along x: a set with the truth in it, and a test that tells."""
    it = axial()
    assert it.verdict == "ambiguous"
    assert {("modulus_error",), ("axis_flexibility",), ("base_compliance",)} <= set(it.sets)
    assert it.next_test is not None
    control = it.next_test.choices[0].test.control
    assert it.next_test.apart, "lateral loads tell the modulus from a soft hinge"
    assert control[1] == "displacement"
    said = answered(it).sentences
    assert said[0].startswith("ambiguous: ")
    assert any(s.startswith("Next test: ") for s in said)


def test_a_diagnosis_about_another_of_its_sets_is_of_that_set_throughout() -> None:
    it = axial()
    second = it.sets[1]
    about = answered(it.about(second))
    assert about.added == second and about.error[-1].effects[-len(second) :] == second
    assert {name.rpartition(".")[0] for name in about.parameters} == set(second)
    said = about.sentences
    assert said[0].startswith(f"ambiguous: {' + '.join(second)} or ")
    assert any(each.startswith(f"{second[0]}: ") and " Fitted: " in each for each in said)

    def apart(answer: Answer) -> dict[frozenset[tuple[str, ...]], float]:
        test = answer.next_test or {}
        pairs = [frozenset(map(tuple, pair)) for pair in test["tells_apart"]]
        return dict(zip(pairs, test["expected_chi_square"], strict=True))

    # The next test tells the same sets apart, whichever stands first.
    assert apart(about) == apart(answered(it)) != {}


def test_the_record_of_an_ambiguous_case() -> None:
    answer = json.loads(answer_of(axial()).text())
    assert answer["verdict"] == "ambiguous"
    assert [answer["effects"], *answer["alternatives"]] == [list(names) for names in axial().sets]
    assert answer["next_test"]["control"]["y"] == "displacement"
    assert {"effect", "screen", "fit", "crossvalidated", "evidence"} <= set(answer["candidates"][0])
    assert answer["error"][0]["effects"] == []
    assert answer["error"][-1]["fit"] < 1.1


@pytest.mark.long
def test_a_load_cell_whose_gain_grows_is_unknown() -> None:
    it = found(with_fault(bench(ids=("axial_held_q+30", "lateral_q+0")), growing_gain))
    assert it.verdict == "unknown"
    said = " ".join(answered(it).sentences)
    assert "nothing known explains it" in said
    assert "fx has a gain that grows" in said


def test_the_command(tmp_path: Path) -> None:
    """Nothing in the folder is touched, the JSON is the answer, bad input ends with 2."""
    folder, out = tmp_path / "bench", tmp_path / "answer.json"
    write(folder, bench(ids=("axial_held_q+0",)))
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    ran = CliRunner().invoke(app, ["diagnose", str(folder), "--json", str(out)])
    assert ran.exit_code == 0, ran.output
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == before
    assert json.loads(out.read_text())["verdict"] == "within_noise"
    missing = CliRunner().invoke(app, ["diagnose", str(tmp_path / "none")])
    assert missing.exit_code == 2


@pytest.mark.long
@pytest.mark.parametrize(
    "effect",
    [
        "modulus_error.scale",
        "bar_stiffness_asymmetry.ratio",
        "bar_length_mismatch.mismatch_mm",
        "load_offset.y_mm",
    ],
)
def test_single_effects_are_named(effect: str) -> None:
    name, _, parameter = effect.partition(".")
    (p,) = [each for each in EFFECTS[name].parameters if each.name == parameter]
    it = found(bench(effect, p.null + p.typical))
    assert name in it.sets[0]
    assert it.verdict == "identified"
