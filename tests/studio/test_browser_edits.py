"""What the doctor found is mended in a browser, and taken back, by keys alone."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.cases.test_small_tables import DATA
from tests.reports.browser import NEEDS_BROWSER, browser
from tests.studio.seen import shows
from tests.studio.test_browser import PATIENCE, focused, opened, studio

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
