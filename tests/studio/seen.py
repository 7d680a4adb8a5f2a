"""What can be measured of the studio in a browser: how full a window is, what keeps from reading it, work spent."""

from __future__ import annotations

import subprocess
from typing import Any

from tests.reports import axe

EMPTY_SHARE = """() => {
  const size = 12, reach = 30, wide = Math.ceil(innerWidth / size), high = Math.ceil(innerHeight / size);
  const filled = new Uint8Array(wide * high);
  const mark = ({ left, top, right, bottom }) => {
    if (right <= left || bottom <= top) return;
    const [x0, x1] = [left - reach, right + reach].map((x) => Math.min(Math.max(Math.round(x / size), 0), wide));
    const [y0, y1] = [top - reach, bottom + reach].map((y) => Math.min(Math.max(Math.round(y / size), 0), high));
    for (let y = y0; y < y1; y++) filled.fill(1, y * wide + x0, y * wide + x1);
  };
  const shown = (it) => !it.closest(".away") && getComputedStyle(it).visibility !== "hidden";
  const words = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (words.nextNode()) {
    const { parentElement: holder } = words.currentNode;
    if (!words.currentNode.data.trim() || ["SCRIPT", "STYLE"].includes(holder.tagName) || !shown(holder)) continue;
    const range = document.createRange();
    range.selectNodeContents(words.currentNode);
    [...range.getClientRects()].forEach(mark);
  }
  const drawn = "canvas, svg.main-svg .nsewdrag, button, input, .v-field, .bars span[style*='absolute']";
  [...document.querySelectorAll(drawn)].filter(shown).forEach((it) => mark(it.getBoundingClientRect()));
  return 1 - filled.reduce((sum, it) => sum + it, 0) / filled.length;
}"""
"""Share of the window that is farther than 30 pixels, the usual gutter, from any word, plot, picture or control."""
EMPTY_AT_MOST = 0.15
FIRST_PAGE, VERDICT = 2.0, 20.0
"""Seconds that are promised."""


def empty_share(page: Any) -> float:
    """Of the window."""
    return float(page.evaluate(EMPTY_SHARE))


def shows(page: Any) -> None:
    """Nothing on the page keeps somebody from reading or working it, as far as axe sees; where it is installed."""
    if axe.SPEC is not None:
        # What fades in has less contrast on its way.
        page.wait_for_function("document.getAnimations().every((it) => it.playState !== 'running')")
        found = axe.findings(page)
        assert not found, "\n".join(found)


def worked(root: int) -> float:
    """Seconds of processor time of all processes below one."""
    table = subprocess.run(
        ["ps", "-eo", "pid=,ppid=,cputimes=,comm="], capture_output=True, text=True, check=True
    )
    rows = [line.split(None, 3) for line in table.stdout.splitlines()]
    below, seconds = {root}, 0.0
    for _ in range(5):
        below |= {int(row[0]) for row in rows if int(row[1]) in below}
    for pid, _, spent, name in rows:
        if int(pid) in below and "python" in name:
            seconds += float(spent)
    return seconds
