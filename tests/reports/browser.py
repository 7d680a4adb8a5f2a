"""A browser that has no network and tells what went wrong in a page."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
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

YARDSTICK = """(() => {
  const kept = new Map();
  let found = 0;
  for (let k = 0; k < 400000; k++) {
    const name = "n" + (k * 7919) % 65536;
    kept.set(name, { k, name });
    found += kept.get(name).k % 7;
  }
  const sorted = Array.from({ length: 300000 }, (_, k) => Math.sin(k)).sort((a, b) => a - b);
  return found + sorted[5];
})()"""
"""Work of a page that no report changes: names, a map and a sort."""
REFERENCE = 0.2
"""Seconds of the yardstick on the machine for which seconds are promised."""


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

    Seconds of the page's own thread, which takes nearly all of them, so that other tests on the same cores do not
    count; and of a machine on which the yardstick takes `REFERENCE` seconds, so that a slow machine fails no page.
    """
    opened, measured, said = float("inf"), float("inf"), list[str]()
    for _ in range(tries):
        context = found.new_context(viewport={"width": 1280, "height": 800}, offline=True)
        bare = context.new_page()
        seconds = thread_seconds(bare)
        bare.goto("about:blank")
        before = seconds()
        bare.evaluate(YARDSTICK)
        measured = min(measured, seconds() - before)
        page = watched(context, said)
        seconds = thread_seconds(page)
        page.add_init_script(OPENED)
        page.goto(path.as_uri())
        page.wait_for_function("window.opened !== undefined")
        opened = min(opened, seconds())
        context.close()
        assert said == []
        if opened * REFERENCE / measured < enough:
            break
    return opened * REFERENCE / measured


def thread_seconds(page: Any) -> Callable[[], float]:
    """The clock of a page's own thread, which runs while the page works [s]."""
    meter = page.context.new_cdp_session(page)
    meter.send("Performance.enable", {"timeDomain": "threadTicks"})

    def seconds() -> float:
        metrics = meter.send("Performance.getMetrics")["metrics"]
        return next(float(it["value"]) for it in metrics if it["name"] == "ThreadTime")

    return seconds


def _bad(message: Any) -> bool:
    return message.type in ("error", "warning") and not any(r in message.text for r in REMARKS)
