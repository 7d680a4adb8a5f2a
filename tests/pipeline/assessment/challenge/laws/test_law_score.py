"""Outcomes of benches with laws are judged and counted as they should be."""

import json
from pathlib import Path
from typing import Any

import pytest

from pipeline.assessment.challenge.laws import outcome as outcomes
from pipeline.assessment.challenge.laws.__main__ import STUDY
from pipeline.assessment.challenge.laws.names import FORMS, same_physics
from pipeline.assessment.challenge.laws.outcome import HiddenLaw, LawOutcome, Place, law_outcome
from pipeline.assessment.challenge.laws.page import law_page
from pipeline.assessment.challenge.laws.score import law_scored
from pipeline.assessment.challenge.laws.shapes import GRAMMAR
from pipeline.provenance import code_digest
from vjm.effects import catalogue
from vjm.forms import forms

CUBIC = HiddenLaw(site="along@tip", law="Cubic", mu=40.0, told=20.0, forms=("cubic", "linear+cubic"))


def made(number: int, **more: Any) -> LawOutcome:
    plain: dict[str, Any] = {"number": number, "kind": "law", "poor": False, "dirt": {}, "hidden": (CUBIC,)}
    return LawOutcome.model_validate({**plain, "commit": "abc", "code": "x", **more})


def place(*group: str, forms: tuple[str, ...] = ("linear+cubic",)) -> Place:
    return Place(site=group[0], group=group, forms=forms, evidence=80.0)


def test_every_law_of_the_grammar_has_a_form_that_exists() -> None:
    assert set(FORMS) == set(GRAMMAR)
    assert {name for names in FORMS.values() for name in names} <= set(forms())


def test_effects_that_are_the_same_physics_are_in_the_catalogue() -> None:
    assert same_physics("Coulomb", "hinge_torque@tip") == ("joint_friction",)
    assert same_physics("Linear", "base_rz") == ("base_compliance",)
    assert same_physics("Cubic", "hinge_torque") == ()
    named = {
        name
        for law in FORMS
        for site in ("hinge_torque", "along", "base_x")
        for name in same_physics(law, site)
    }
    assert named <= set(catalogue()) and len(named) > 4


def test_a_score_counts_what_it_says() -> None:
    every = [
        made(0, found=(place("along", "along@tip"),), held_out=(1.0, 1.2), excess=0.1, excess_of_process=1.0),
        made(1, found=(place("tilt_x"),), verdict="identified", wrong_names=("base_compliance",)),
        made(
            2,
            hidden=(CUBIC.model_copy(update={"mu": 20.0, "told": 3.0}),),
            found=(place("along@tip", forms=("power",)),),
        ),
        made(3, kind="pair", hidden=(CUBIC, CUBIC), found=(place("along@tip"), place("base_x"))),
        made(4, kind="clean", hidden=()),
        made(5, kind="clean", hidden=(), found=(place("base_x"),)),
        made(6, poor=True, error="bench: no state"),
    ]
    goals = {goal.name: (goal.share.count, goal.share.of) for goal in law_scored(every).goals}
    assert goals["place or its group right, from 30 sigmas"] == (1, 2)
    assert goals["place or its group right, 15 to 30 sigmas"] == (1, 1)
    assert goals["place or its group right, 15 sigmas beside tolerances"] == (1, 2)
    assert goals["form among the ties, place right"] == (1, 2)
    assert goals["held out at most 1.15, form known"] == (1, 2)
    assert goals["wrong names of the catalogue"] == (1, 1)
    assert goals["two laws: both places"] == (1, 1) and goals["two laws: a false place"] == (1, 1)
    assert goals["clean benches with a law"] == (1, 2)
    assert goals["no answer at all"] == (1, 7)
    result = law_scored(every)
    assert result.excess == pytest.approx(0.1)
    text = law_page(result)
    assert "| law 0 | Cubic along@tip 40 (20) | along (+1) linear+cubic | right | 1.10 |" in text
    assert "| law 1 | Cubic along@tip 40 (20) | tilt_x linear+cubic | other | – | identified" in text
    assert "clean 4" not in text and "| clean 5 |" in text


def test_a_bench_that_finds_no_state_has_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise RuntimeError("no state")

    monkeypatch.setattr(outcomes, "measured", fails)
    it = law_outcome("law", 0, "", "")
    assert it.error == "bench: no state" and not it.found and it.right == ()


def test_a_stored_run_is_scored_again(tmp_path: Path) -> None:
    store, code = tmp_path / "laws.jsonl", code_digest()
    wanted = STUDY.tasks(1)
    assert wanted == [("law", 0), ("pair", 0), *(("clean", k) for k in range(5))]
    kept = [made(k, kind=kind, hidden=(), code=code) for kind, k in wanted]
    store.write_text("".join(each.model_dump_json() + "\n" for each in kept))
    STUDY.run(1, 1, store, tmp_path, quiet=True)
    assert json.loads((tmp_path / "laws.json").read_text())["cases"] == len(wanted) == 7
    assert (tmp_path / "laws.md").read_text().startswith("# Laws beyond the catalogue on virtual benches")
