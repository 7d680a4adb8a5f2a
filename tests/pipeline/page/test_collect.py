"""What a page shows is what the other commands say, and nothing is written where it must not be."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.add.fitting import add
from pipeline.answer.record import Answer, Candidate
from pipeline.campaign import write
from pipeline.compare.error import Discrepancy
from pipeline.errors import InputError
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.suitable import known_effects
from pipeline.page.collect import Subject, collect, proposed
from pipeline.page.command import report_campaign, write_page
from pipeline.page.isolability import isolability, isolability_anew
from pipeline.page.record import Page
from pipeline.page.words import why
from pipeline.selection.diagnosis import diagnose
from reports import markdown
from reports.blocks import Details, Section, Table
from reports.campaign import dossier
from reports.campaign.sections import build
from tests.conftest import Done
from tests.pipeline.bench import bench
from tests.pipeline.inference import manipulators
from tests.pipeline.selection.bench import bench as small_bench
from tests.studio.ahead import unmeasured

EFFECTS = ("bar_geometric_nonlinearity", "modulus_error")


@cache
def softened() -> tuple[Answer, Model]:
    known = known_effects().effects
    found = add(bench("modulus_error.scale", 0.95), Model(), [known[name] for name in EFFECTS])
    return found.answer, found.model


@cache
def page() -> Page:
    _, model = softened()
    return collect(Subject(bench("modulus_error.scale", 0.95), model, known_effects(), {}))


def test_the_stages_end_at_the_errors_that_add_says() -> None:
    """Apart from inputs that are linearised once more here, which moves chi-square by a part in a thousand."""
    answer, _ = softened()
    first, middle, last = page().error
    assert first.effects == () and middle.effects == EFFECTS[:1] and last.effects == EFFECTS
    assert first.fit > middle.fit > last.fit
    assert last.fit == pytest.approx(answer.error[-1].fit, rel=1e-3)
    assert last.holdout == pytest.approx(answer.error[-1].holdout, rel=1e-2)
    assert first.fit == pytest.approx(answer.error[0].fit, rel=1e-2)


def test_curves_hold_what_was_measured_and_what_is_left() -> None:
    campaign = bench("modulus_error.scale", 0.95)
    cases = load_cases(campaign)
    plain = Discrepancy(cases, predict(Model(), cases, slopes=False))
    for test, number in zip(page().tests, range(len(campaign.tests)), strict=True):
        rows = np.flatnonzero(cases.test == number)
        assert test.error_before == pytest.approx(plain.rms(cases.test == number), rel=0.02)
        assert len(test.curves) == cases.predicted[rows].any(axis=0).sum()
        for curve in test.curves:
            left = np.subtract(curve.measured, curve.after) / np.array(curve.sigma)
            # Seven digits of readings that are up to 1e5 sigmas large.
            np.testing.assert_allclose(left, np.array(curve.left_after, dtype=float), atol=0.02)
            assert curve.rms_after == pytest.approx(np.sqrt(np.mean(np.square(curve.left_after))))


def test_the_page_survives_json_and_says_what_was_held_out() -> None:
    text = page().model_dump_json()
    assert Page.model_validate_json(text) == page()
    assert [t.test for t in page().tests if t.role == "holdout"] == ["axial_held_q+15"]
    assert any("axial_held_q+15" in said for said in page().assumptions)
    assert any("modulus_error" in said for said in page().sources)
    assert page().headline.startswith("within_noise: ")


def render(page: dict[str, Any]) -> str:
    """The dossier of a page as Markdown."""
    parts = list(dossier.blocks(page["dossier"]))
    return markdown.render("page", [Section("dossier", "Validation dossier", parts)])


def test_an_answer_brings_its_model_and_its_words() -> None:
    answer, model = softened()
    tried = (
        Candidate(effect="modulus_error", fit=0.98, evidence=0.0),
        Candidate(effect="load_offset", screen=9.0),
    )
    told = answer.model_copy(update={"candidates": tried, "verdict": "identified"})
    assert proposed(Model(), told, known_effects()).values.tolist() == model.values.tolist()
    found = collect(Subject(bench("modulus_error.scale", 0.95), Model(), known_effects(), {}, told))
    assert found.proposed == EFFECTS and found.headline == answer.sentences[0]
    assert found.candidates[0].chosen and found.candidates[0].why == "chosen"
    assert "explains too little: 9.00 sigma" in found.candidates[1].why
    it = found.dossier
    assert it is not None and not found.not_done and it.comparison and it.readings > 0
    assert [each.parameter for each in it.budget] == list(found.parameters)
    text = render(found.model_dump(mode="json"))
    assert "Validation dossier" in text and "u_num" in text and "what limits each parameter" in text


def test_a_saved_answer_is_shown_with_the_matrix_that_the_diagnosis_had() -> None:
    every = known_effects().effects
    few = {name: every[name] for name in (*EFFECTS, "axis_flexibility", "load_offset", "joint_friction")}
    campaign = small_bench("modulus_error.scale", 0.95, ids=("axial_held_q+0", "lateral_q+0"))
    found = diagnose(campaign, Model(), few)
    first, anew = isolability(found), isolability_anew(campaign, Model(), few, found.sets[0], lambda _: None)
    assert first.about == ("bar_geometric_nonlinearity",) and not first.anew and anew.anew
    assert anew.model_copy(update={"anew": False}) == first
    at = first.effects.index("axis_flexibility")
    assert 0.99 < (first.correlation[at][first.effects.index("modulus_error")] or 0.0) < 1.0


def test_a_page_about_a_manipulator_says_where_it_stands() -> None:
    found = collect(Subject(manipulators.campaign(), Model(), known_effects(), {}))
    assert [t.rig.place_mm for t in found.tests[1:]] == [(0.0, 0.0, 0.0), (50.0, -40.0, 60.0)]
    assert found.tests[0].rig.lines and not found.rig.lines
    sections = {s.anchor: s for s in build(found.model_dump(), defaultdict(bytes))}
    (more,) = [block for block in sections["misfit"].blocks if isinstance(block, Details)]
    rows = [row for block in more.blocks[:1] if isinstance(block, Table) for row in block.rows]
    assert [row[1].text for row in rows][-1] == "platform at (50, -40, 60) mm"
    assert "unloaded bars at q" not in " ".join(found.assumptions)


def test_before_anything_is_measured_the_page_says_so(tmp_path: Path) -> None:
    found = collect(Subject(unmeasured(), Model(), known_effects(), {}))
    assert found.headline.startswith("not measured yet") and not any(t.curves for t in found.tests)
    write_page(found, tmp_path)
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "Not measured yet" in text and "![" not in text


@pytest.mark.parametrize(
    ("candidate", "said"),
    [
        (Candidate(effect="load_offset", fit=1.5, evidence=80.0), "BIC 80 behind the best set"),
        (Candidate(effect="load_offset", fit=0.99, evidence=4.0), "BIC 4 behind the best set"),
        (Candidate(effect="base_compliance", fit=0.98, evidence=1.0), "fits as well"),
        (Candidate(effect="load_offset"), "does not show"),
    ],
)
def test_each_loser_has_its_reason(candidate: Candidate, said: str) -> None:
    answer = softened()[0].model_copy(update={"alternatives": (("base_compliance",),)})
    assert said in why(candidate, answer)


def test_a_report_inside_the_campaign_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "bench", bench())
    monkeypatch.chdir(tmp_path)
    for inside in (Path("bench"), Path("bench/report"), Path("bench/../bench/a/b"), tmp_path / "bench"):
        with pytest.raises(InputError, match="is inside the campaign"):
            report_campaign(Path("bench"), inside)
    assert sorted(p.name for p in (tmp_path / "bench").iterdir()) == ["campaign.toml", "measurements.csv"]


@pytest.mark.long
def test_report_from_the_command_line(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    """By the folder, of a campaign, of what was saved, with the same bytes; an answer about another one is refused."""
    folder = tmp_path / "bench"
    write(folder, bench())
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    done = pipeline_command("report", "bench", cwd=tmp_path)
    out = tmp_path / "results" / "bench"
    assert done.code == 0 and done.out == "report: results/bench/index.html\n", done.err
    drawn = {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    assert {p.name for p in drawn} >= {"page.json", "index.html", "report.md", "first.png", "misfit.png"}
    done = pipeline_command("report", "results/bench", "--quiet", cwd=tmp_path)
    assert done.code == 0 and {p: p.read_bytes() for p in drawn} == drawn
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == before
    (tmp_path / "other.json").write_text(softened()[0].model_copy(update={"campaign": "other"}).text())
    done = pipeline_command("report", "bench", "--answer", "other.json", cwd=tmp_path)
    assert done.code == 2 and "is about the campaign 'other', allowed is one about 'small'" in done.err
