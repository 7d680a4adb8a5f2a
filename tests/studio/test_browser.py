"""The studio in a browser: the whole story, with what a careless user does on the way."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import TimeoutError as PlaywrightTimeout

from pipeline.campaign import write
from pipeline.errors import InputError
from pipeline.inference.model_reading import read_model_file
from pipeline.page.command import report_campaign
from pipeline.plan.command import plan_campaign
from pipeline.plan.table import following
from tests.conftest import ROOT
from tests.pipeline.bench import bench
from tests.pipeline.inference import manipulators
from tests.reports.browser import NEEDS_BROWSER, browser
from tests.studio.ahead import unmeasured

FOCUS = """() => {
  const it = document.activeElement, look = getComputedStyle(it);
  const name = it.id || it.getAttribute("role") || it.closest("[id]")?.id || it.tagName;
  return [name, look.outlineStyle !== "none" && parseFloat(look.outlineWidth) >= 2];
}"""
PATIENCE, TRIES = 60_000, 12
"""Milliseconds; two cores are shared."""
pytestmark = NEEDS_BROWSER


@contextmanager
def studio(cwd: Path, *arguments: str) -> Iterator[str]:
    """A studio in a process of its own; its address."""
    command = [sys.executable, "-m", "pipeline", "studio", *arguments, "--no-browser"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(
        command, cwd=cwd, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        found = re.match(r"studio: (http://127\.0\.0\.1:\d+/\S*)", process.stdout.readline())
        assert found, process.communicate(timeout=10)
        yield found[1]
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(30) is not None


def opened(found: Any, url: str, requests: list[str] | None = None) -> Any:
    page = found.new_context(viewport={"width": 1280, "height": 800}).new_page()
    page.set_default_timeout(PATIENCE)
    if requests is not None:
        page.on("request", lambda request: requests.append(request.url))
    page.goto(url)
    return page


def asked(page: Any, folder: str) -> None:
    page.locator("#folder").fill(folder)
    page.locator("#folder").press("Tab")
    page.locator("#open").press("Enter")


def refused(page: Any, folder: str, complaint: str) -> None:
    """Asked again where what was typed went nowhere: the page was still being drawn."""
    found = page.locator("#complaint", has_text=complaint)
    for _ in range(TRIES):
        asked(page, folder)
        try:
            found.wait_for(timeout=PATIENCE / TRIES)
            return
        except PlaywrightTimeout:
            continue
    found.wait_for()


def added(page: Any, effect: str) -> None:
    """Without a mouse."""
    item = page.locator(".v-list-item", has_text=effect).first
    for _ in range(TRIES):
        page.locator("#effect").focus()
        page.keyboard.press("ControlOrMeta+A")
        page.keyboard.type(effect)
        # What is typed while the page is being drawn again goes nowhere, as for a person.
        try:
            item.wait_for(timeout=PATIENCE / TRIES)
            break
        except PlaywrightTimeout:
            continue
    item.wait_for()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    page.locator("#add:enabled").press("Enter")
    page.get_by_role("button", name=f"Remove {effect}").wait_for()


def focused(page: Any) -> list[str]:
    """Names of what the tab key comes to until it is back at the page; each can be seen to have the focus."""
    names: list[str] = []
    while len(names) < 40:
        page.keyboard.press("Tab")
        name, seen = page.evaluate(FOCUS)
        if name == "BODY":
            break
        names.append(name)
        assert seen, names
    return names


def sigma(page: Any) -> float:
    """The error of the model that is shown."""
    found = re.search(r"→ ([\d.]+) sigma", page.locator("#errors").text_content())
    assert found
    return float(found[1])


def outside(requests: list[str]) -> list[str]:
    """Requests that went anywhere but to the studio."""
    return [
        it for it in requests if not it.startswith(("http://127.0.0.1:", "ws://127.0.0.1:", "blob:", "data:"))
    ]


def test_open_add_and_save_with_a_browser_that_is_killed_on_the_way(tmp_path: Path) -> None:
    """Everything comes from this machine; a complaint is the command line's; a new browser finds what was done."""
    write(tmp_path / "rig", bench("modulus_error.scale", 0.95))
    requests: list[str] = []
    with studio(tmp_path) as url, browser() as first:
        page = opened(first, url, requests)
        refused(page, "nowhere", "nowhere: does not exist, allowed is a folder with")
        asked(page, "rig")
        page.locator("#headline", has_text="plain virtual springs leave").wait_for()
        assert page.locator("#complaint").count() == 0 and sigma(page) > 10.0
        added(page, "bar_geometric_nonlinearity")
        page.context.close()
        page = opened(first, url, requests)
        page.get_by_role("button", name="Remove bar_geometric_nonlinearity").wait_for()
        added(page, "modulus_error")
        page.locator("#headline", has_text="within_noise").wait_for()
        assert sigma(page) < 1.2
        title = page.locator(".gtitle").first
        page.evaluate(
            "document.querySelectorAll('.js-plotly-plot')[1].emit('plotly_click',"
            "{points: [{customdata: ['swing_q+30', 'Fz']}]})"
        )
        page.locator(".gtitle", has_text="swing_q+30, q = 30°: Fz, N").wait_for()
        assert title.count() == 1
        page.get_by_role("slider").press("End")
        page.locator("#seen", has_text="step 11, displacements ×").wait_for()
        page.locator("#save").click()
        page.locator("#remark", has_text="saved: rig/model.toml").wait_for()
    saved = read_model_file(tmp_path / "rig" / "model.toml")
    assert saved.model.names == ("bar_geometric_nonlinearity", "modulus_error")
    assert requests and outside(requests) == []


@pytest.mark.long
def test_plan_before_measuring_a_dropped_mistake_and_a_manipulator_without_a_mouse(tmp_path: Path) -> None:
    """What is dropped is complained about as on the command line, and what was open stays."""
    write(tmp_path / "ahead", unmeasured())
    write(tmp_path / "arms", manipulators.campaign())
    write(tmp_path / "bad", unmeasured())
    described = tmp_path / "bad" / "campaign.toml"
    described.write_text(described.read_text().replace("length_mm", "lenght_mm"))
    with studio(tmp_path, "ahead") as url, browser() as found:
        page = opened(found, url)
        page.locator("#headline", has_text="not measured yet").wait_for()
        order = focused(page)
        assert order == [
            "folder",
            "open",
            "drop",
            "export",
            "effect",
            "plan",
            "tab_data",
            "scene",
            "slider",
            "test",
        ]
        page.locator("#tab_data").press("ArrowRight")
        page.keyboard.press("Enter")
        page.locator("div", has_text="measured or not, and which test comes next").last.wait_for()
        assert page.locator("#diagnose").is_disabled() and page.locator("#save").is_disabled()
        page.locator("#plan").press("Space")
        said = following(plan_campaign(tmp_path / "ahead", quiet=True))
        page.locator("#next_test", has_text=said[0]).wait_for()
        assert page.locator("#sizes tbody tr").count() > 20
        assert page.locator("#planned .js-plotly-plot .ytick").count() > 10
        page.locator("#drop").set_input_files([described, tmp_path / "bad" / "measurements.csv"])
        page.locator("#complaint", has_text="lenght_mm").wait_for()
        with pytest.raises(InputError) as caught:
            report_campaign(tmp_path / "results" / "dropped" / "ahead", tmp_path / "out")
        complaint = page.locator("#complaint").inner_text().strip()
        assert complaint.replace(f"{tmp_path}/", "") == str(caught.value).replace(f"{tmp_path}/", "")
        assert page.locator("#headline", has_text="not measured yet").count() == 1
        page.locator("#folder").fill("arms")
        page.locator("#folder").press("Tab")
        page.locator("#open").press("Enter")
        page.locator(".gtitle", has_text="platform at (").wait_for()
        page.locator("#tab_data").press("Enter")
        page.get_by_role("slider").press("End")
        page.locator("#seen", has_text="step 3, displacements ×").wait_for()


@pytest.mark.long
def test_the_whole_story_on_the_shipped_bench(tmp_path: Path) -> None:
    """Open, see the misfit, cancel a diagnosis, diagnose, add what it names, error at noise, save, report."""
    shutil.copytree(ROOT / "examples" / "bench", tmp_path / "bench")
    with studio(tmp_path, "bench") as url, browser() as found:
        page = opened(found, url)
        page.locator("#headline", has_text="leave 289 sigma").wait_for()
        page.locator("#diagnose").click()
        page.locator("#progress", has_text="looking for what is missing: ").wait_for()
        page.locator("#cancel").click()
        page.locator("#remark", has_text="cancelled; nothing was changed").wait_for()
        page.locator("#diagnose").click()
        page.locator(
            "#headline", has_text="identified: bar_geometric_nonlinearity + joint_friction"
        ).wait_for(timeout=10 * PATIENCE)
        assert page.locator("#candidates tbody tr").count() >= 15
        page.locator("#add_named").click()
        page.get_by_role("button", name="Remove joint_friction").wait_for(timeout=10 * PATIENCE)
        page.locator("#headline", has_text="within_noise").wait_for()
        assert sigma(page) < 1.05
        page.locator("#save").click()
        page.locator("#remark", has_text="saved: bench/model.toml").wait_for()
        page.locator("#export").click()
        page.locator("#remark", has_text="report: results/bench/index.html").wait_for()
    report = (tmp_path / "results" / "bench" / "report.md").read_text(encoding="utf-8")
    assert "explains too little" in report and "isolability.png" in report
    assert read_model_file(tmp_path / "bench" / "model.toml").model.names[1] == "joint_friction"


@pytest.mark.long
def test_two_studios_on_a_campaign_that_is_edited_meanwhile(tmp_path: Path) -> None:
    """Neither overwrites the other unsaid; an edit of the files reaches both, with its complaint; nothing is lost."""
    write(tmp_path / "rig", bench("modulus_error.scale", 0.95))
    with studio(tmp_path, "rig") as one, studio(tmp_path, "rig") as two, browser() as found:
        first, second = opened(found, one), opened(found, two)
        for page, effect in ((first, "bar_geometric_nonlinearity"), (second, "load_offset")):
            page.locator("#headline").wait_for()
            added(page, effect)
        first.locator("#save").click()
        first.locator("#remark", has_text="saved: rig/model.toml").wait_for()
        second.locator("#remark", has_text="was edited: read again").wait_for()
        second.locator("#save:enabled").click()
        second.locator("#complaint", has_text="was changed since it was read").wait_for()
        saved = read_model_file(tmp_path / "rig" / "model.toml").model
        assert saved.names == ("bar_geometric_nonlinearity",)
        whole = (tmp_path / "rig" / "measurements.csv").read_text()
        (tmp_path / "rig" / "measurements.csv").write_text(whole.replace("12.", "twelve.", 1) + "nonsense\n")
        for page, effect in ((first, "bar_geometric_nonlinearity"), (second, "load_offset")):
            page.locator("#complaint", has_text="measurements.csv").wait_for()
            assert page.get_by_role("button", name=f"Remove {effect}").count() == 1
        (tmp_path / "rig" / "measurements.csv").write_text(whole)
        for page in (first, second):
            page.locator("#complaint").wait_for(state="detached")
