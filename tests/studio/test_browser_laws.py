"""Laws in a browser: looked for, read and put in the model by keys alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from pipeline.campaign import write
from tests.pipeline.bench import bench
from tests.reports.browser import NEEDS_BROWSER, browser
from tests.studio.seen import shows
from tests.studio.test_browser import PATIENCE, focused, opened, sigma, studio

pytestmark = NEEDS_BROWSER


@pytest.mark.long
@pytest.mark.parametrize("size", [(1280, 900), (1920, 1080)], ids=["1280", "1920"])
def test_laws_are_looked_for_and_added_without_a_mouse(tmp_path: Path, size: tuple[int, int]) -> None:
    write(tmp_path / "rig", bench("joint_friction.torque_Nmm", 600.0))
    with studio(tmp_path, "rig") as url, browser() as found:
        page = opened(found, url, size=size)
        page.locator("#tab_laws").press("Enter")
        assert "discover" in focused(page)
        page.locator("#discover:enabled").press("Enter")
        page.locator("#progress", has_text="looking for laws: ").wait_for()
        page.locator("#cancel").press("Enter")
        page.locator("#remark", has_text="looking for laws: cancelled").wait_for()
        assert page.locator("#laws").count() == 0
        page.locator("#discover:enabled").press("Enter")
        page.locator("#laws_said", has_text="What is left sits here").wait_for(timeout=10 * PATIENCE)
        card = page.locator("#laws .rival")
        assert card.count() == 1 and "sigma are left in the fitted tests" in card.inner_text()
        assert card.locator("img").evaluate(
            "it => it.naturalWidth > 300 && it.width <= it.parentNode.clientWidth"
        )
        shows(page)
        page.locator("#add_laws").press("Enter")
        page.locator("#remark", has_text="written: rig/laws.py").wait_for()
        page.get_by_role("button", name="Remove hinge_torque").wait_for()
        assert sigma(page) < 1.1 and page.locator("#add_laws").count() == 0
        page.locator("#save:enabled").press("Enter")
        page.locator("#remark", has_text="saved: rig/model.toml").wait_for()
    assert 'effects_from = ["laws.py"]' in (tmp_path / "rig" / "model.toml").read_text(encoding="utf-8")
