"""Every public result: what it says, its first screen in a notebook, pickle and equality, table and files."""

from __future__ import annotations

import inspect
import pickle
import re
import shutil
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from textwrap import dedent

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import parastiff
from parastiff import InputError, UndecidedError
from pipeline.face.shown import LARGEST, Drawn, Shown
from tests.conftest import ROOT
from tests.pipeline.face.results import (
    ONE_STEP,
    RESULTS,
    TEST,
    added,
    ambiguous,
    answer,
    asked,
    bench,
    by_law,
    law,
    law_discovered,
    many_tests,
)

HTML = 300_000
VOID = {"img", "meta", "br", "hr"}


class Balanced(HTMLParser):
    """Tags that are open, and what is loaded from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.sources: list[str] = []
        self.seen: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.add(tag)
        self.sources += [value or "" for key, value in attrs if key in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_every_result_type_that_is_public_is_looked_at() -> None:
    public = {
        it
        for name in parastiff.__all__
        if inspect.isclass(it := getattr(parastiff, name)) and issubclass(it, Shown)
    }
    assert public == {type(make()) for make in RESULTS.values()} and len(public) == 12


@pytest.mark.parametrize("name", RESULTS)
def test_it_says_itself_in_a_headline_and_a_table(name: str) -> None:
    it = RESULTS[name]()
    said = repr(it)
    assert len(said) < LARGEST
    first, *rest = said.splitlines()
    assert first == it.headline and len(first) <= 80
    assert bool(rest) is bool(it.tables()) and all(len(line) <= 80 for line in rest)
    assert "[bold]" not in it.text() and all(len(line) <= 80 for line in it.text().splitlines())
    # What is left out is said, and is there.
    if said.endswith("for all"):
        assert len(it.text()) > len(said)


@pytest.mark.parametrize("name", RESULTS)
def test_its_first_screen_needs_nothing_from_outside(name: str) -> None:
    it = RESULTS[name]()
    page = it._repr_html_()
    assert len(page) < HTML
    found = Balanced()
    found.feed(page)
    assert not found.open
    assert all(source.startswith("data:image/png;base64,") for source in found.sources)
    assert not found.seen & {"script", "link", "iframe", "object"}
    assert ("img" in found.seen) is isinstance(it, Drawn)


@pytest.mark.parametrize("name", RESULTS)
def test_it_is_the_same_after_a_pickle_and_no_other(name: str) -> None:
    it = RESULTS[name]()
    again = pickle.loads(pickle.dumps(it))
    assert again == it and repr(again) == repr(it)
    others = [other() for key, other in RESULTS.items() if key != name]
    assert all(other != it for other in others)


@pytest.mark.parametrize("name", RESULTS)
def test_it_is_tabled_and_saved(name: str, tmp_path: Path) -> None:
    it = RESULTS[name]()
    frame = it.to_frame()
    assert isinstance(frame, pd.DataFrame) and (len(frame) or name == "discovery")
    for ending in (".json", ".csv"):
        assert it.save(str(tmp_path / f"it{ending}")).stat().st_size > 1
    with pytest.raises(
        InputError, match=r"ends with '.docx', allowed are .json, .csv, .html, .png, .svg, .pdf"
    ):
        it.save(tmp_path / "it.docx")


def test_pictures_are_saved_too(tmp_path: Path) -> None:
    it = RESULTS["linkage"]()
    begins = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF", ".html": b"<!doctype html>"}
    for ending, begin in begins.items():
        assert it.save(tmp_path / f"it{ending}").read_bytes().startswith(begin)
    with pytest.raises(InputError, match="Catalogue has no picture"):
        parastiff.catalogue().save(tmp_path / "it.png")


def test_a_picture_is_drawn_without_a_window_and_is_the_same_again() -> None:
    figures = [RESULTS["stiffness"]().plot() for _ in range(2)]  # type: ignore[attr-defined]
    one, other = (figure.png() for figure in figures)
    assert isinstance(figures[0], Figure) and one == other and one.startswith(b"\x89PNG")
    assert "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()


def test_equality_looks_at_every_number() -> None:
    it = ambiguous()
    assert it != replace(it, answer=answer(parameters={}))
    assert it != replace(it, models=it.models[::-1])
    other = replace(it.subject.campaign, tolerance={"bar": 0.5})
    assert it != replace(it, subject=replace(it.subject, campaign=other))


def test_ambiguous_gives_no_model_without_a_choice() -> None:
    it = ambiguous()
    with pytest.raises(UndecidedError) as said:
        it.model  # noqa: B018
    for part in ("ambiguous", "model_of('modulus_error')", "model_of('self_weight')", TEST):
        assert part in str(said.value)
    assert it.model_of("self_weight").names == ("self_weight",)
    assert it.model_of("modulus_error") == it.models[0]
    assert bench().with_model(it.model_of("self_weight")).model.names == ("self_weight",)
    with pytest.raises(UndecidedError, match="joint_friction is no choice"):
        it.model_of("joint_friction")
    shared = replace(it, choices=(("modulus_error", "self_weight"), ("modulus_error", "load_offset")))
    with pytest.raises(UndecidedError, match="modulus_error is in several choices"):
        shared.model_of("modulus_error")
    assert shared.model_of("load_offset") == it.models[1]


@pytest.mark.parametrize("verdict", ["unknown", "nothing_tested"])
def test_a_verdict_that_names_nothing_gives_no_model_either(verdict: str) -> None:
    it = replace(ambiguous(), answer=answer(verdict=verdict))
    with pytest.raises(UndecidedError, match=verdict):
        it.model  # noqa: B018


def test_what_is_identified_or_noise_has_its_model() -> None:
    for verdict in ("identified", "within_noise"):
        it = replace(ambiguous(), answer=answer(verdict=verdict))
        assert it.model == it.models[0]


def test_a_first_screen_names_what_is_certain_and_what_comes_next(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Drawn, "_picture", lambda _: "")
    page = ambiguous()._repr_html_()
    assert "ambiguous" in page and f"Next test: {TEST}" in page and "model_of" in page
    known = replace(ambiguous(), answer=answer(verdict="identified"))._repr_html_()
    assert "What is certain" in known and "scale = 0.90" in known
    # Long words of a user are shortened, not dropped without a word.
    page = many_tests()._repr_html_()
    assert "and 20 more rows" in page and " ..." in page


FENCED = re.findall(r"```py\n(.*?)```", (ROOT / "docs" / "reference" / "python.md").read_text(), re.DOTALL)
DOCSTRING = dedent(re.findall(r"((?:^ {4}.*\n|^\n)+)", parastiff.__doc__ or "", re.MULTILINE)[0])


@pytest.mark.parametrize("shown", [FENCED[0], DOCSTRING], ids=["reference", "docstring"])
def test_a_bench_to_a_verdict_and_a_picture_in_five_lines(
    shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As the documentation shows it, in a folder that has a bench."""
    assert 4 <= len([line for line in shown.splitlines() if line.strip()]) <= 5
    shutil.copytree(ONE_STEP, tmp_path / "bench")
    monkeypatch.chdir(tmp_path)
    space: dict[str, object] = {}
    exec(shown, space)
    it = space.get("found")
    assert isinstance(it, parastiff.Diagnosis) and it.verdict == "nothing_tested"
    assert capsys.readouterr().out.startswith(it.headline)
    assert (tmp_path / "found.png").read_bytes().startswith(b"\x89PNG")
    if "found.html" in shown:
        assert re.search(r"<title>.*nothing_tested", (tmp_path / "found.html").read_text())


def test_a_law_is_told_in_words_and_drawn() -> None:
    it = by_law()
    assert it.laws == it.answer.laws and it.laws[0].site == "along@base"
    assert "a law at along@base" in it.headline and "give along the bars" in repr(it)
    page = it._repr_html_()
    for part in (
        "Laws beyond the catalogue",
        "y = k1 x + k3 x^3",
        "do not tell it from along@base.1",
        "law.py",
    ):
        assert part in page
    assert it.to_frame()["value"].tolist() == [40.0, 90.0] and set(it.to_frame()["effect"]) == {"along@base"}
    assert "Laws beyond" not in ambiguous()._repr_html_()
    *_, axes = _axes(it)
    assert axes.get_title(loc="left").startswith("along@base: give along the bars")
    assert len(_axes(it)) == len(_axes(ambiguous())) + 1
    also = answer(laws=(law(),))
    assert "modulus_error or self_weight or a law at along@base" in replace(ambiguous(), answer=also).headline


def test_a_law_is_drawn_without_load_steps_that_are_far_off() -> None:
    (axes,) = _axes(law_discovered())
    assert max(map(abs, axes.get_ylim())) < 120.0 and axes.get_xlabel() == "displacement / mm"
    names = axes.get_legend_handles_labels()[1]
    assert names[-1] == "cubic: y = k1 x + k3 x^3" and len(names) == 4
    bare = replace(
        law_discovered(), record=law_discovered().record.model_copy(update={"laws": (law(curve=None),)})
    )
    assert not _axes(bare) and "no law to draw" in bare.plot().texts[0].get_text()


def _axes(it: Drawn) -> list[Axes]:
    return it.plot().axes


def test_a_prediction_is_that_of_the_command_at_its_rows_and_at_others() -> None:
    own = bench().predict()
    (row,) = own.record.rows
    assert row.role == "fit" and [it.column for it in row.readings] == ["rz_rad"]
    assert own.to_frame()["measured"].tolist() == [row.readings[0].measured]
    assert "bench.diagnose() says what the model lacks" in own._repr_html_()
    there = asked()
    frame = there.to_frame()
    assert list(frame["given.fy_N"].unique()) == [1.0, 2.0] and "measured" not in frame
    # Without noise and without parameters that were fitted some intervals have no width.
    half = 0.5 * (frame["high95"] - frame["low95"])
    parts = np.hypot(np.hypot(frame["parameters"], frame["tolerances"]), frame["noise"])
    straight = frame["sampled"] == 0
    assert straight.any() and np.allclose(half[straight], 1.959964 * parts[straight])
    assert half.max() > 1.0
    assert list(there.record.data)[-1] == "the table of load cases"
    with pytest.raises(InputError, match="'no such' is not predicted, allowed are case 1"):
        there.plot("no such")


def test_load_cases_of_a_file_and_of_a_pandas_table_are_the_same(tmp_path: Path) -> None:
    table = pd.DataFrame({"q_deg": [0.0, 10.0], "fy_N": [1.0, 2.0]})
    table.to_csv(tmp_path / "at.csv", index=False)
    one, other = bench().predict(table), parastiff.predict(ONE_STEP, tmp_path / "at.csv")
    assert one.to_frame().equals(other.to_frame())
    assert one.record.data["the table of load cases"] == other.record.data["at.csv"]
    # Histories of one load step are drawn together.
    assert all(len(axes.get_xticks()) == 2 for axes in _axes(one))
    with pytest.raises(InputError, match=r"the table of load cases line 1, column fq_N"):
        bench().predict(pd.DataFrame({"fy_N": [1.0], "fq_N": [1.0]}))
    with pytest.raises(InputError, match="at = 3 is no table, allowed are the path of one"):
        bench().predict(3)  # type: ignore[arg-type]


def test_a_diagnosis_predicts_by_what_it_identified_only() -> None:
    with pytest.raises(UndecidedError, match="ambiguous"):
        ambiguous().predict()
    known = replace(ambiguous(), answer=answer(verdict="identified"))
    assert known.predict().record.effects == ("modulus_error",) == added().predict().record.effects


def test_a_virtual_bench_is_measured_and_written_with_its_answer_beside(tmp_path: Path) -> None:
    it = parastiff.simulate("joint_friction=800", seed=2, out=tmp_path / "bench")
    assert it.answer["parameters"]["joint_friction.torque_Nmm"] == 800  # type: ignore[index]
    assert "800" not in repr(it) and len(it.to_frame()) == 456
    assert (tmp_path / "bench.sealed.json").exists()
    assert parastiff.open(tmp_path / "bench").subject.campaign.digests == it.subject.campaign.digests
    with pytest.raises(InputError, match="exists, allowed is a folder without a campaign"):
        parastiff.simulate(out=tmp_path / "bench")


def test_functions_take_a_bench_a_campaign_a_folder_or_a_result() -> None:
    campaign = parastiff.read(ONE_STEP)
    folder = str(ONE_STEP)
    assert parastiff.plan(campaign).record == parastiff.plan(folder).record == ambiguous().plan().record
    with pytest.raises(InputError, match="3 is no bench, allowed are"):
        parastiff.plan(3)  # type: ignore[arg-type]


def test_a_linkage_is_asked_of_a_rig() -> None:
    with pytest.raises(InputError, match=r"^rig is 310, allowed is one of parastiff\.rigs"):
        parastiff.linkage(310, 80)  # type: ignore[arg-type]
