"""The picture of a signature: small multiples, one test each, in the look of the reports."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from docs.made.signatures import Panel
from reports.campaign.names import channel_label, unit_label
from reports.charts import dress, picture
from reports.formats import number
from reports.style import ACCENT, FAINT, INK

COLUMNS = 3
_SMALL = {"mm": ("µm", 1e3), "rad": ("µrad", 1e6)}


def drawn(panels: Sequence[Panel]) -> bytes:
    """PNG of the panels."""
    lines = -(-len(panels) // COLUMNS)
    figure = Figure(figsize=(9.6, 2.6 * lines + 0.2))
    grid = figure.subplots(lines, COLUMNS, squeeze=False, gridspec_kw={"wspace": 0.36, "hspace": 0.5})
    for ax, panel in zip(grid.flat, panels, strict=False):
        _draw(ax, panel)
    for ax in list(grid.flat)[len(panels) :]:
        ax.set_visible(False)
    return picture(figure)


def _draw(ax: Axes, it: Panel) -> None:
    unit, factor = _SMALL.get(it.name[1], (unit_label(it.name[1]), 1.0))
    change, sigma = factor * it.change, factor * it.sigma
    ax.axhspan(-sigma, sigma, color=FAINT, alpha=0.25, lw=0)
    ax.plot(it.load, change, color=ACCENT, lw=1.4, marker="o", ms=2.5)
    # The step from which a history begins tells a loop's direction.
    ax.plot(it.load[:1], change[:1], color=INK, marker="o", ms=4.5, ls="")
    ax.set_title(f"{_test(it.test)}: {number(it.size, 3)} σ", fontsize=9, loc="left", color=INK)
    ax.set_xlabel(f"{channel_label(it.load_name[0])}, {unit_label(it.load_name[1])}", fontsize=8)
    ax.set_ylabel(f"change of {channel_label(it.name[0])}, {unit}", fontsize=8)
    ax.tick_params(labelsize=7.5)
    top = max(2.5 * sigma, 1.12 * float(np.nanmax(np.abs(change), initial=0.0)))
    low, high = float(np.nanmin(change, initial=0.0)), float(np.nanmax(change, initial=0.0))
    ax.set_ylim(-top if low < -0.1 * top else -2.5 * sigma, top if high > 0.1 * top else 2.5 * sigma)
    dress(ax)


def _test(name: str) -> str:
    """lateral_pushed_q+30 as lateral pushed, q = +30°; fx_p2 as fx, posture 2."""
    name = re.sub(r"_p(\d+)$", r", posture \1", name)
    return re.sub(r" q([+-]\d+)$", r", q = \1°", name.replace("_", " "))
