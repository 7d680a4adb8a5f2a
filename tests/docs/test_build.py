"""The documentation is built without a network and without a warning, and works from disk: pages, formulas, search."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT
from tests.reports.browser import NEEDS_BROWSER, browser, watched
from vjm.effects import catalogue

NO_NETWORK = """
import socket

def refused(*arguments, **named):
    raise OSError("there is no network")

socket.socket.connect = socket.socket.connect_ex = refused
socket.getaddrinfo = socket.create_connection = refused
"""
OUTSIDE = re.compile(
    r"<(?:script|link|img|iframe|source)\b[^>]*?(?:src|href)=[\"'](?:https?:)?//", re.IGNORECASE
)

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages, built by a process that reaches nothing."""
    folder = tmp_path_factory.mktemp("docs")
    guard, out = folder / "guard", folder / "html"
    guard.mkdir()
    (guard / "sitecustomize.py").write_text(NO_NETWORK, encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(guard), str(ROOT)])}
    refused = subprocess.run(
        [sys.executable, "-c", "import urllib.request as r; r.urlopen('http://127.0.0.1')"],
        env=environment,
        capture_output=True,
        text=True,
    )
    assert "there is no network" in refused.stderr
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-q", "-E", "-W", "--keep-going", str(ROOT / "docs"), str(out)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=900,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return out


def test_nothing_of_a_page_comes_from_outside(built: Path) -> None:
    pages = sorted(built.rglob("*.html"))
    assert len(pages) > 15
    assert not [str(page) for page in pages if OUTSIDE.search(page.read_text(encoding="utf-8"))]
    sheets = [path.read_text(encoding="utf-8") for path in built.rglob("*.css")]
    assert sheets and not [
        text for text in sheets if re.search(r"(@import|url\()\s*[\"']?(https?:)?//", text)
    ]


def test_every_picture_is_there(built: Path) -> None:
    text = (built / "reference" / "effects.html").read_text(encoding="utf-8")
    sources = re.findall(r'<img src="(\.\./_static/signatures/[^"]+)"', text)
    assert len(sources) == len(catalogue())
    assert all((built / "reference" / source).stat().st_size > 5_000 for source in sources)


def test_the_search_finds_a_term(built: Path) -> None:
    text = (built / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(re.fullmatch(r"Search\.setIndex\((.*)\)", text, re.DOTALL)[1])  # type: ignore[index]
    places = index["terms"]["presliding_rad"]
    found = [index["docnames"][k] for k in ([places] if isinstance(places, int) else places)]
    assert "reference/effects" in found


def test_the_wheel_has_no_documentation() -> None:
    from hatch_build import laid_out

    names = [name for name, _ in laid_out(ROOT)]
    assert len(names) > 300 and not [
        name for name in names if name.startswith("docs") or name.endswith(".md")
    ]


@NEEDS_BROWSER
def test_search_and_formulas_work_in_a_browser_from_disk(built: Path) -> None:
    said: list[str] = []
    with browser() as found:
        page = watched(found.new_context(viewport={"width": 1280, "height": 800}, offline=True), said)
        page.goto((built / "search.html").as_uri() + "?q=presliding")
        page.wait_for_selector("#search-results li a")
        links = [it.get_attribute("href") for it in page.query_selector_all("#search-results li a")]
        assert any(str(link).startswith("reference/effects.html") for link in links)
        page.goto((built / "verdict.html").as_uri())
        page.wait_for_selector("mjx-container svg")
        formulas = page.evaluate("document.querySelectorAll('.math').length")
        assert formulas > 20
        page.wait_for_function(f"document.querySelectorAll('mjx-container').length >= {formulas}")
        assert page.evaluate("document.querySelectorAll('[data-mjx-error], mjx-merror').length") == 0
        page.goto((built / "reference" / "effects.html").as_uri())
        page.evaluate("document.querySelectorAll('img').forEach(it => { it.loading = 'eager' })")
        page.wait_for_function("[...document.images].every(it => it.complete && it.naturalWidth > 300)")
        # At 1280 nothing of a page is wider than the window.
        for name in ("index", "reference/campaign", "reference/effects", "tutorials/own_table", "verdict"):
            page.goto((built / f"{name}.html").as_uri())
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), name
    assert said == []
