"""Every public result: what it says, its first screen in a notebook, pickle and equality, table and files."""

from __future__ import annotations

import inspect
import pickle
import re
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

import parastiff
from parastiff import InputError, UndecidedError
from pipeline.face.shown import LARGEST, Drawn, Shown
from tests.pipeline.face.results import ONE_STEP, RESULTS, TEST, ambiguous, answer, bench, many_tests

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
    assert public == {type(make()) for make in RESULTS.values()} and len(public) == 11


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


def test_a_bench_to_a_verdict_and_a_picture_in_five_lines(tmp_path: Path) -> None:
    lines = f"""import parastiff
found = parastiff.open({str(ONE_STEP)!r}).diagnose()
print(found)
found.plot()
found.save({str(tmp_path / "verdict.html")!r})"""
    assert len(lines.splitlines()) == 5
    space: dict[str, object] = {}
    exec(lines, space)
    assert space["found"].verdict == "nothing_tested"  # type: ignore[attr-defined]
    assert re.search(r"<title>.*nothing_tested", (tmp_path / "verdict.html").read_text())


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
