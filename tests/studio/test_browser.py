"""The studio in a browser: the whole story, with what a careless user does on the way."""

from __future__ import annotations

import os
import re
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
from tests.pipeline.selection.bench import AXIAL
from tests.pipeline.selection.bench import bench as small_bench
from tests.reports.browser import NEEDS_BROWSER, browser, thread_seconds
from tests.studio.ahead import unmeasured
from tests.studio.seen import EMPTY_AT_MOST, FIRST_PAGE, VERDICT, empty_share, shows, worked

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


def opened(
    found: Any, url: str, requests: list[str] | None = None, size: tuple[int, int] = (1280, 800)
) -> Any:
    page = found.new_context(viewport={"width": size[0], "height": size[1]}).new_page()
    page.set_default_timeout(PATIENCE)
    if requests is not None:
        page.on("request", lambda request: requests.append(request.url))
    page.goto(url)
    return page


def asked(page: Any, folder: str) -> None:
    """Enter opens."""
    home = page.locator("#home")
    if home.count():
        home.press("Enter")
    page.locator("#folder").fill(folder)
    page.locator("#folder").press("Enter")


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
    """The error of the fitted tests that the last bars say."""
    return float(re.findall(r"fitted\s+([\d.]+)", page.locator("#bars").inner_text())[-1])


def outside(requests: list[str]) -> list[str]:
    """Requests that went anywhere but to the studio."""
    return [
        it for it in requests if not it.startswith(("http://127.0.0.1:", "ws://127.0.0.1:", "blob:", "data:"))
    ]


@pytest.mark.long
def test_open_add_and_save_with_a_browser_that_is_killed_on_the_way(tmp_path: Path) -> None:
    """Everything comes from this machine; a complaint is the command line's; a new browser finds what was done."""
    write(tmp_path / "rig", bench("modulus_error.scale", 0.95))
    requests: list[str] = []
    with studio(tmp_path) as url, browser() as first:
        page = opened(first, url, requests)
        refused(page, "nowhere", "nowhere: does not exist, allowed is a folder with")
        asked(page, "rig")
        page.locator("#headline", has_text="Plain virtual springs leave").wait_for()
        assert page.locator("#complaint").count() == 0 and sigma(page) > 5.0
        added(page, "bar_geometric_nonlinearity")
        page.context.close()
        page = opened(first, url, requests)
        page.get_by_role("button", name="Remove bar_geometric_nonlinearity").wait_for()
        added(page, "modulus_error")
        page.locator("#headline", has_text="Within noise").wait_for()
        assert sigma(page) < 1.2
        page.evaluate(
            "document.querySelector('.map .js-plotly-plot').emit('plotly_click',"
            "{points: [{customdata: ['swing_q+30', 'Fz']}]})"
        )
        page.locator(".curve .ytitle", has_text="Fz, N").wait_for()
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
        page.locator("#headline", has_text="Not measured yet").wait_for()
        order = focused(page)
        assert order[:2] == ["home", "export"]
        assert [name for name in order if name in ("plan", "effect", "tab_data", "scene", "slider")] == [
            "plan",
            "effect",
            "tab_data",
            "scene",
            "slider",
        ]
        page.locator("#tab_plan").press("Enter")
        page.locator("div", has_text="measured or not, and which test comes next").last.wait_for()
        assert page.locator("#diagnose").is_disabled() and page.locator("#save").is_disabled()
        page.locator("#plan").press("Space")
        said = following(plan_campaign(tmp_path / "ahead", quiet=True))
        page.locator("#next_test", has_text=said[0]).wait_for()
        assert page.locator("#sizes tbody tr").count() > 20
        assert page.locator("#planned .js-plotly-plot .ytick").count() > 10
        page.locator("#home").press("Enter")
        page.locator("#drop").set_input_files([described, tmp_path / "bad" / "measurements.csv"])
        page.locator("#complaint", has_text="lenght_mm").wait_for()
        with pytest.raises(InputError) as caught:
            report_campaign(tmp_path / "results" / "dropped" / "ahead", tmp_path / "out")
        complaint = page.locator("#complaint").inner_text().strip()
        assert complaint.replace(f"{tmp_path}/", "") == str(caught.value).replace(f"{tmp_path}/", "")
        page.locator("#return").press("Enter")
        page.locator("#home").wait_for()
        assert page.locator("#headline", has_text="Not measured yet").count() == 1
        asked(page, "arms")
        page.locator("#campaign", has_text="arms").wait_for()
        page.locator(".map .js-plotly-plot").wait_for()
        page.get_by_role("slider").press("End")
        page.locator("#seen", has_text="step 3, displacements ×").wait_for()


@pytest.mark.long
@pytest.mark.parametrize("size", [(1280, 900), (1920, 1080)], ids=["1280", "1920"])
def test_the_whole_story_on_the_example_by_keyboard_alone(tmp_path: Path, size: tuple[int, int]) -> None:
    """First page, one key to a diagnosed bench, back and forth, accept, save, the report by its link."""
    with studio(tmp_path) as url, browser() as found:
        page = opened(found, url, size=size)
        page.locator("#example").wait_for()
        page.locator("#example").press("Enter")
        page.locator("#headline", has_text="Plain virtual springs leave 10.0 sigma").wait_for()
        page.locator("#progress", has_text="looking for what is missing: ").wait_for()
        page.locator("#cancel").press("Enter")
        page.locator("#remark", has_text="cancelled; nothing was changed").wait_for()
        page.locator("#diagnose:enabled").press("Enter")
        told = "Identified: geometric nonlinearity of the bars and friction in the hinges"
        page.locator("#headline", has_text=told).wait_for(timeout=10 * PATIENCE)
        # Headline and bars are of one model: what is proposed, and it is said that it is.
        assert sigma(page) < 1.05 and "not accepted yet" in page.locator("#standing").inner_text()
        assert page.locator(".map .annotation-text", has_text="after").count() == 1
        shows(page)
        if size[0] == 1920:
            assert empty_share(page) < EMPTY_AT_MOST
        page.locator("#back").press("Enter")
        page.locator("#headline", has_text="Plain virtual springs leave 10.0 sigma").wait_for()
        assert sigma(page) > 5.0 and page.locator("#save").is_disabled()
        page.locator("#found").press("Enter")
        page.locator("#headline", has_text=told).wait_for()
        page.locator("#tab_candidates").press("Enter")
        assert page.locator("#candidates tbody tr").count() >= 15
        page.locator("#accept").press("Enter")
        page.get_by_role("button", name="Remove joint_friction").wait_for()
        assert sigma(page) < 1.05 and page.locator("#headline", has_text=told).count() == 1
        page.locator("#save:enabled").press("Enter")
        page.locator("#remark", has_text="saved: results/example/model.toml").wait_for()
        page.locator("#export").press("Enter")
        page.locator("#report").wait_for()
        with page.context.expect_page() as opening:
            page.locator("#report").press("Enter")
        opening.value.locator(".lead", has_text=told).wait_for()
    report = (tmp_path / "results" / "bench" / "report.md").read_text(encoding="utf-8")
    assert "explains too little" in report and "isolability.png" in report
    assert read_model_file(tmp_path / "results" / "example" / "model.toml").model.names[1] == "joint_friction"


@pytest.mark.long
def test_sets_that_fit_alike_are_compared_and_one_is_taken(tmp_path: Path) -> None:
    """No single button takes the first of them."""
    write(tmp_path / "axial", small_bench("axis_flexibility.radial_mm_per_N", 3e-6, AXIAL))
    with studio(tmp_path, "axial") as url, browser() as found:
        page = opened(found, url, size=(1280, 900))
        page.locator("#diagnose:enabled").press("Enter")
        page.locator("#headline", has_text="Ambiguous: ").wait_for(timeout=10 * PATIENCE)
        assert page.locator("#accept").count() == 0
        page.locator("#compare_sets").press("Enter")
        sets = page.locator(".rival")
        assert sets.count() >= 3
        page.locator("#rivals").wait_for()
        shows(page)
        page.get_by_role("button", name="Take Hinge axes give").press("Enter")
        page.get_by_role("button", name="Remove axis_flexibility").wait_for()
        assert page.locator("#save").is_enabled()


@pytest.mark.long
def test_a_table_becomes_a_campaign_by_answers(tmp_path: Path) -> None:
    """What is missing is said by the name of its column; axes and signs are seen in N and mm before it is one."""
    table = tmp_path / "own.csv"
    rows = "".join(f"{0.1 * k:.1f};{12 * k + k % 2}\n".replace(".", ",") for k in range(12))
    table.write_text(f"Kraft [kN];Weg [um]\n{rows}", encoding="utf-8")
    with studio(tmp_path) as url, browser() as found:
        page = opened(found, url, size=(1280, 900))
        page.locator("#table").set_input_files(table)
        page.locator("#importing").wait_for()
        shows(page)
        page.locator("#preview").press("Enter")
        page.locator("#complaint", has_text="column Kraft [kN]: what it is was not chosen").wait_for()
        page.get_by_label("what Kraft [kN] is").select_option(label="force along x")
        page.get_by_label("what Weg [um] is").select_option(label="displacement along x")
        page.get_by_label("sign of Kraft [kN]").select_option(label="−")
        numbers = (310, 6.82e6, 1.98e8, 4.51e7, 1.08e7)
        for place, value in zip(page.locator("#rig input").all(), numbers, strict=True):
            place.fill(f"{value:g}")
            place.press("Tab")
        page.locator("#preview").press("Enter")
        page.locator("#previewed").wait_for()
        cells = page.locator("#previewed tbody tr").nth(1).locator("td").all_inner_texts()
        assert cells[2:4] == ["0.01300", "−100.0"]
        page.locator("#make").press("Enter")
        page.locator("#campaign", has_text="results/tables/own").wait_for()
        page.locator("#headline").wait_for()
    assert (tmp_path / "results" / "tables" / "own" / "own.csv").read_bytes() == table.read_bytes()


@pytest.mark.long
def test_the_first_page_is_there_in_two_seconds_and_the_verdict_in_twenty(tmp_path: Path) -> None:
    """Seconds of work of this page's thread and of the studio's processes, as others use the cores as well."""
    with studio(tmp_path) as url, browser() as found:
        page = opened(found, url)
        meter = thread_seconds(page)
        page.goto(url)
        page.locator("#example").wait_for()
        assert meter() < FIRST_PAGE
        before = worked(os.getpid())
        page.locator("#example").press("Enter")
        page.locator("#headline", has_text="Identified").wait_for(timeout=10 * PATIENCE)
        spent = worked(os.getpid()) - before
        # The search uses both processors.
        assert spent < 2 * VERDICT, spent


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
