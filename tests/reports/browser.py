"""A browser that has no network and tells what went wrong in a page."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
NEEDS_BROWSER = pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
# Remarks on speed come from plotly's own canvas and from a browser without a graphics card.
REMARKS = ("GL Driver Message", "Canvas2D: Multiple readback", "Automatic fallback to software WebGL")


OPENED = """(() => {
  const seen = (it) => {
    const { top, bottom } = it.getBoundingClientRect();
    return top < innerHeight && bottom > 0;
  };
  const look = () => {
    const plots = [...document.querySelectorAll(".plot")].filter(seen);
    if (document.readyState === "complete" && plots.every((it) => it.querySelector(".main-svg")))
      requestAnimationFrame(() => { window.opened = performance.now(); });
    else requestAnimationFrame(look);
  };
  look();
})()"""


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


def seconds_to_open(found: Any, path: Path, enough: float, tries: int = 5) -> float:
    """From the call for a page on disk, without a network, to its load with all plots in sight drawn and a frame more;
    the best of some tries, or the first that is good enough. The console must stay silent.

    Seconds of the page's own thread, which takes nearly all of them: other tests on the same cores do not count.
    """
    best, said = float("inf"), list[str]()
    for _ in range(tries):
        context = found.new_context(viewport={"width": 1280, "height": 800}, offline=True)
        page = watched(context, said)
        meter = context.new_cdp_session(page)
        meter.send("Performance.enable", {"timeDomain": "threadTicks"})
        page.add_init_script(OPENED)
        page.goto(path.as_uri())
        page.wait_for_function("window.opened !== undefined")
        told = {it["name"]: it["value"] for it in meter.send("Performance.getMetrics")["metrics"]}
        best = min(best, told["ThreadTime"])
        context.close()
        assert said == []
        if best < enough:
            break
    return best


def _bad(message: Any) -> bool:
    return message.type in ("error", "warning") and not any(r in message.text for r in REMARKS)
