"""A browser that has no network and tells what went wrong in a page."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
NEEDS_BROWSER = pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
# Remarks on speed come from plotly's own canvas and from a browser without a graphics card.
REMARKS = ("GL Driver Message", "Canvas2D: Multiple readback", "Automatic fallback to software WebGL")


@contextmanager
def browser() -> Iterator[Any]:
    """Debian's chromium, driven by playwright."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        found = driver.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--enable-unsafe-swiftshader"]
        )
        try:
            yield found
        finally:
            found.close()


def watched(context: Any, said: list[str]) -> Any:
    """A page of a context; what it complains about is added to `said`."""
    page = context.new_page()
    page.on("console", lambda m: said.append(m.text) if _bad(m) else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("requestfailed", lambda request: said.append(f"{request.url[:200]} failed"))
    return page


def _bad(message: Any) -> bool:
    return message.type in ("error", "warning") and not any(r in message.text for r in REMARKS)
