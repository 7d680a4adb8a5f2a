"""The report of a diagnosed bench: its story on a few screens, the first of which says what matters; it can be read."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.page.collect import Subject, collect
from pipeline.page.command import report_campaign
from reports.campaign import draw, first_screen
from tests.conftest import ROOT
from tests.pipeline.bench import bench
from tests.reports.axe import NEEDS_AXE, findings
from tests.reports.browser import NEEDS_BROWSER, browser

WIDE, HIGH, SCREENS = 1280, 900, 6
OPEN = "document.querySelectorAll('details').forEach((it) => { it.open = true; })"
BELOW = """(names) => names.filter((name) => {
  const it = [...document.querySelectorAll("#verdict .lead, #verdict h3, #verdict svg, #verdict pre")]
    .find((it) => it.textContent.startsWith(name) || it.tagName.toLowerCase() === name);
  return !it || it.getBoundingClientRect().top > innerHeight - 40;
})"""


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a model that nobody diagnosed."""
    folder = tmp_path_factory.mktemp("plain")
    page = collect(Subject(bench(), Model(), known_effects(), {}), ("python -m pipeline report bench",))
    (folder / "page.json").write_text(page.model_dump_json(), encoding="utf-8")
    draw(folder)
    return folder


@pytest.fixture(scope="module")
def diagnosed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("diagnosed")
    report_campaign(ROOT / "examples" / "bench", folder, diagnosing=True, quiet=True)
    return folder


def shown(folder: Path) -> Iterator[Any]:
    with browser() as found:
        page = found.new_context(viewport={"width": WIDE, "height": HIGH}, offline=True).new_page()
        page.goto((folder / "index.html").as_uri())
        count = page.locator(".plot").count()
        page.wait_for_function(f"document.querySelectorAll('.plot.js-plotly-plot').length === {count}")
        yield page


@NEEDS_AXE
@NEEDS_BROWSER
@pytest.mark.parametrize("folder", ["plain", pytest.param("diagnosed", marks=pytest.mark.long)])
def test_nothing_keeps_from_reading_it(folder: str, request: pytest.FixtureRequest) -> None:
    for page in shown(request.getfixturevalue(folder)):
        assert findings(page) == []
        page.evaluate(OPEN)
        assert findings(page) == []


@NEEDS_AXE
@NEEDS_BROWSER
@pytest.mark.long
def test_nothing_keeps_from_reading_the_kept_report() -> None:
    for page in shown(ROOT / "reports" / "validation"):
        page.evaluate(OPEN)
        assert findings(page) == []


def test_what_nobody_diagnosed_is_no_verdict(plain: Path) -> None:
    text = (plain / "report.md").read_text(encoding="utf-8")
    assert "## Where the model stands" in text and "Verdict" not in text and "What is certain" not in text


@NEEDS_BROWSER
@pytest.mark.long
def test_the_story_of_the_bench_takes_six_screens_and_the_first_says_it(diagnosed: Path) -> None:
    for page in shown(diagnosed):
        assert page.evaluate("document.documentElement.scrollHeight") <= SCREENS * HIGH
        assert (
            page.evaluate(BELOW, ["Identified: ", "What is certain", "Next step", "svg", "python -m"]) == []
        )
        assert "_" not in page.locator("#verdict .lead").inner_text()
        page.evaluate("window.scrollTo(0, 2000)")
        assert page.evaluate("document.querySelector('nav').getBoundingClientRect().top") == 0
        # Every link leads to a section that is seen below the bar.
        for link in page.locator("nav a").all():
            link.press("Enter")
            page.wait_for_function("scrollY > 0 || location.hash === '#verdict'")
            top = "document.querySelector(location.hash).getBoundingClientRect().top"
            last = "innerHeight + scrollY >= document.documentElement.scrollHeight - 2"
            assert 30 <= page.evaluate(top) <= 60 or page.evaluate(last), link.inner_text()
    assert (diagnosed / "index.html").stat().st_size < 8e6


def test_the_first_screen_stands_alone(plain: Path) -> None:
    """For a notebook: no script, nothing from outside, the same bytes, and small."""
    record = json.loads((plain / "page.json").read_text(encoding="utf-8"))
    html = first_screen(record)
    assert html == first_screen(record) and len(html.encode()) < 300_000
    assert "<script" not in html and "http" not in html.replace("http://www.w3.org", "")
    assert "Plain virtual springs leave" in html and "<svg" in html
