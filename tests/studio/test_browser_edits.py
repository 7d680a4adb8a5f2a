"""What is written in campaign.toml from a browser, and taken back, by keys alone."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.cases.test_small_tables import DATA
from tests.reports.browser import NEEDS_BROWSER, browser
from tests.studio.seen import shows
from tests.studio.test_browser import PATIENCE, focused, opened, sigma, studio

pytestmark = NEEDS_BROWSER


@pytest.mark.long
@pytest.mark.parametrize("size", [(1280, 900), (1920, 1080)], ids=["1280", "1920"])
def test_a_mistake_of_the_table_is_mended_and_taken_back(tmp_path: Path, size: tuple[int, int]) -> None:
    shutil.copytree(DATA / "t08_offset_identified_as_dimension", tmp_path / "rig")
    file = tmp_path / "rig" / "campaign.toml"
    before = file.read_bytes()
    with studio(tmp_path, "rig") as url, browser() as found:
        page = opened(found, url, size=size)
        page.locator("#diagnose:enabled").press("Enter")
        button = page.get_by_role("button", name="Write it: x starts at 2.95 mm")
        button.wait_for(timeout=10 * PATIENCE)
        assert page.locator(".warn", has_text='[[tests]] t0: zero = "fitted"').count() == 1
        shows(page)
        assert file.read_bytes() == before
        button.press("Enter")
        page.locator("#undo").wait_for()
        assert button.count() == 0 and b'zero = "fitted"' in file.read_bytes()
        # Once around from where the button was, then from the beginning.
        focused(page)
        assert "undo" in focused(page)
        shows(page)
        page.locator("#undo").press("Enter")
        page.locator("#remark", has_text="taken back in campaign.toml").wait_for()
        page.locator("#undo").wait_for(state="detached")
    assert file.read_bytes() == before


@pytest.mark.long
@pytest.mark.parametrize("size", [(1280, 900), (1920, 1080)], ids=["1280", "1920"])
def test_the_reading_that_is_seen_is_set_aside_and_put_back(tmp_path: Path, size: tuple[int, int]) -> None:
    """And a tolerance is typed, saved and taken back; by keys alone."""
    shutil.copytree(DATA / "n_i_outlier_f", tmp_path / "rig")
    file = tmp_path / "rig" / "campaign.toml"
    before = file.read_bytes()
    with studio(tmp_path, "rig") as url, browser() as found:
        page = opened(found, url, size=size)
        # The worst reading is the one that is seen at first.
        page.locator("#seen", has_text="step 5, ").wait_for()
        left = sigma(page)
        page.locator("#aside:enabled").press("Enter")
        page.locator("#remark", has_text="x_mm of axial, step 5: set aside").wait_for()
        page.locator("#undo").wait_for()
        assert b"set_aside = {x_mm = [5]}" in file.read_bytes() and sigma(page) < left
        page.locator("#tab_rig").press("Enter")
        shows(page)
        page.get_by_role("button", name="Put back: x_mm of axial, step 5").press("Enter")
        page.locator("#set_aside").wait_for(state="detached")
        page.locator("#diagnose:enabled").wait_for()
        assert file.read_bytes() == before and sigma(page) == left
        place = page.get_by_label("tolerance of axial stiffness EA of the bars")
        place.fill("0.013")
        place.press("Tab")
        page.locator("#tolerate:enabled").press("Enter")
        page.locator("#save_tolerances:enabled").press("Enter")
        page.locator("#remark", has_text="written in campaign.toml: [tolerance]").wait_for()
        page.locator("#undo").wait_for()
        assert b"EA = 0.013" in file.read_bytes() and place.input_value() == "0.013"
        page.locator("#undo").press("Enter")
        page.locator("#remark", has_text="taken back").wait_for()
        page.locator("#diagnose:enabled").wait_for()
        assert place.input_value() == "0.02"
    assert file.read_bytes() == before
