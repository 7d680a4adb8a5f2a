"""The report of the default run, as it is kept: it opens at once, and everything on it can be read and turned."""

from __future__ import annotations

from tests.conftest import ROOT
from tests.reports.browser import NEEDS_BROWSER, browser, seconds_to_open, watched

INDEX = ROOT / "reports" / "validation" / "index.html"
OPENS, SIZE = 2.0, 8e6
"""Bytes and, on the machine of reference, seconds that are promised."""
CUT = """[...document.querySelectorAll(".table, .draw")]
  .filter((it) => it.scrollWidth > it.clientWidth + 1).map((it) => it.textContent.slice(0, 40))"""
UNTITLED = """[...document.querySelectorAll(".plot")].filter((it) => {
  const axes = Object.entries(it._fullLayout).filter(([key, value]) => /^[xy]axis/.test(key) && value.visible);
  const scene = it._fullLayout.scene;
  const titles = scene
    ? ["xaxis", "yaxis", "zaxis"].map((key) => scene[key].title.text)
    : ["x", "y"].map((way) => axes.filter(([key]) => key[0] === way).map(([, axis]) => axis.title.text).join(""));
  return titles.some((title) => !title || title.startsWith("Click to enter"));
}).map((it) => it.id)"""


@NEEDS_BROWSER
def test_it_opens_in_two_seconds_and_is_small() -> None:
    assert INDEX.stat().st_size < SIZE
    with browser() as found:
        assert seconds_to_open(found, INDEX, OPENS) < OPENS


@NEEDS_BROWSER
def test_every_plot_is_drawn_and_has_titles_and_every_shape_turns() -> None:
    """What is out of sight is drawn as well, without being scrolled to; categories along an axis need no title."""
    said: list[str] = []
    with browser() as found:
        page = watched(found.new_context(viewport={"width": 1280, "height": 800}, offline=True), said)
        page.set_default_timeout(60_000)
        page.goto(INDEX.as_uri())
        count = page.locator(".plot").count()
        page.wait_for_function(f"document.querySelectorAll('.plot.js-plotly-plot').length === {count}")
        assert count >= 6 and page.evaluate(UNTITLED) in ([], ["plot-critical"])
        assert page.evaluate("document.documentElement.scrollWidth <= 1280") and page.evaluate(CUT) == []
        for name in ("shapes", "stress"):
            turned = f"document.getElementById('plot-{name}')._fullLayout.scene"
            page.wait_for_function(f"{turned}._scene !== undefined")
            assert page.evaluate(f"{turned}.dragmode") == "turntable"
    assert said == []
