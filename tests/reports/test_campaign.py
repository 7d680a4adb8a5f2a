"""The page of a campaign: complete, one file, the same bytes, and it works in a browser without a network."""

from __future__ import annotations

import copy
import json
import re
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.page.collect import Subject, collect
from pipeline.page.record import Isolability
from reports.blocks import Explorer
from reports.campaign import draw, sections
from reports.errors import ReportError
from reports.page import render
from tests.pipeline.bench import bench
from tests.reports.browser import NEEDS_BROWSER, browser, seconds_to_open, watched
from tests.reports.test_validation import Page

TITLES = [
    "Where the model stands",
    "Where it fails",
    "Measured and predicted",
    "What could be missing",
    "What it rests on",
]


OPENS = 2.0
"""Seconds that are promised."""


@pytest.fixture(scope="module")
def record() -> dict[str, Any]:
    alike = Isolability(
        about=(), effects=("a_spring", "<b>bold</b>"), correlation=((1.0, 0.99), (None, None))
    )
    model = Model().with_effects([known_effects().effects["bar_geometric_nonlinearity"]])
    subject = Subject(bench(), model, known_effects(), {}, None, alike)
    found: dict[str, Any] = json.loads(
        collect(subject, ("python -m pipeline report bench",)).model_dump_json()
    )
    found["tests"][0]["test"] = "</script><img src=x onerror=alert(1)>"
    found["next_test"] = {
        "q_deg": 30.0,
        "control": {"x": "force", "y": "displacement"},
        "why": "q = 30°, swung along z",
        "tells_apart": [[["load_offset"], ["self_weight"]]],
        "expected_chi_square": [41.0],
        "together_with": [],
    }
    return found


@pytest.fixture(scope="module")
def drawn(record: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    (folder / "page.json").write_text(json.dumps(record), encoding="utf-8")
    draw(folder)
    return folder


@pytest.fixture(scope="module")
def text(drawn: Path) -> str:
    return (drawn / "index.html").read_text(encoding="utf-8")


def test_sections_are_the_same_in_both_and_the_verdict_is_first(drawn: Path, text: str) -> None:
    assert Page(text).headings == TITLES
    markdown = (drawn / "report.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (.*)$", markdown, re.MULTILINE) == TITLES
    assert "## Where the model stands\n\n**Within noise: " in markdown
    assert not re.search(r"&(?:amp|lt|gt|#?\w+);", markdown)


def test_one_small_file_that_loads_nothing(text: str) -> None:
    page = Page(text)
    assert page.loads == [] and len(text.encode()) < 8e6
    assert sum(script.count("plotly.js v") for script in page.scripts) == 1
    assert len(page.ids) == len(set(page.ids))
    assert {"figure-first", "plot-misfit", "plot-curves", "plot-isolability"} <= set(page.ids)


def test_the_same_record_gives_the_same_bytes(drawn: Path) -> None:
    first = {p: p.read_bytes() for p in drawn.rglob("*") if p.is_file()}
    assert len(first) >= 8
    draw(drawn)
    assert {p: p.read_bytes() for p in first} == first


def test_pictures_of_the_twin_exist(drawn: Path) -> None:
    markdown = (drawn / "report.md").read_text(encoding="utf-8")
    links = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", markdown)
    assert len(links) >= 4 and all((drawn / link).is_file() for link in links)


def test_names_cannot_leave_their_place(drawn: Path, text: str) -> None:
    assert "<b>bold</b>" not in text and "<img" not in re.sub(
        r"<script.*?</script>", "", text, flags=re.DOTALL
    )
    markdown = (drawn / "report.md").read_text(encoding="utf-8")
    assert set(re.findall(r"(.)<(?:img|/script|b>)", markdown)) == {"\\"}


@pytest.mark.parametrize(
    ("content", "said"),
    [(None, "does not exist"), ("{", "is not JSON"), ("[]", "no object"), ("{}", "not laid out")],
)
def test_a_bad_file_is_one_sentence(tmp_path: Path, content: str | None, said: str) -> None:
    if content is not None:
        (tmp_path / "page.json").write_text(content)
    with pytest.raises(ReportError, match=said) as caught:
        draw(tmp_path)
    assert "page.json" in str(caught.value) and not (tmp_path / "index.html").exists()


def test_a_campaign_of_very_many_steps_is_thinned_and_says_so(record: dict[str, Any]) -> None:
    """Ten times what may be drawn, all digits different as noise makes them."""
    noise = np.random.default_rng(5)
    long = copy.deepcopy(record)
    count = 10 * sections.READINGS // sum(len(test["curves"]) for test in long["tests"])
    for test in long["tests"]:
        test["steps"], test["loads"] = list(range(count)), noise.standard_normal(count).round(6).tolist()
        for it in test["curves"]:
            fresh = {
                key: noise.standard_normal(count).round(6).tolist()
                for key, v in it.items()
                if isinstance(v, list)
            }
            it.update(fresh)
    made = sections.build(long, defaultdict(bytes))
    text = render("long", made)
    assert "one in 10 is drawn" in text and len(text.encode()) < 8e6
    (explorer,) = [block for section in made for block in section.blocks if isinstance(block, Explorer)]
    drawn = sum(len(plot["data"][0]["x"]) for plot in explorer.plots.values())
    assert 0.9 * sections.READINGS < drawn < 1.1 * sections.READINGS


@NEEDS_BROWSER
def test_it_opens_in_two_seconds(drawn: Path) -> None:
    with browser() as found:
        assert seconds_to_open(found, drawn / "index.html", OPENS) < OPENS


@NEEDS_BROWSER
def test_it_opens_without_a_network_and_a_click_on_the_map_shows_the_curve(drawn: Path) -> None:
    said: list[str] = []
    with browser() as found:
        page = watched(found.new_context(viewport={"width": 1280, "height": 800}, offline=True), said)
        page.goto((drawn / "index.html").as_uri())
        for name in ("misfit", "curves", "isolability"):
            page.wait_for_selector(f"#plot-{name} .main-svg", state="attached")
        titles = page.locator(".js-plotly-plot .gtitle, .js-plotly-plot .xtitle, .js-plotly-plot .ytitle")
        words = " ".join(titles.all_text_contents())
        for word in ("channel", "could be taken for"):
            assert word in words, words
        assert page.evaluate("document.documentElement.scrollWidth <= 1280")
        chosen = page.locator("#explorer-curves select").first
        chosen.select_option("swing_q+0")
        assert "swing_q+0" in page.locator("#plot-curves .gtitle").text_content()
        page.evaluate(
            "document.getElementById('plot-misfit').emit('plotly_click',"
            "{points: [{customdata: ['lateral_q+0', 'mid']}]})"
        )
        assert chosen.input_value() == "lateral_q+0"
        assert "mid, mm" in page.locator("#plot-curves .gtitle").text_content()
        page.get_by_role("button", name="next").press("Enter")
        assert chosen.input_value() == "swing_q+0"
    assert said == []
