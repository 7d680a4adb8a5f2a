"""Laws that were discovered as pictures: each over its coordinate, with its band and what single load steps say."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from reports.charts import dress, picture
from reports.style import ACCENT, CYCLE, FAINT, INK

Json = Mapping[str, Any]
SHARE = 1.6
"""Times the largest value of the curves, up to which single load steps are shown."""


def drawn(record: Json) -> dict[str, bytes]:
    """PNG of every law with a curve, by file name."""
    every = [law for law in record["laws"] if law["curve"] is not None]
    return {f"law_{k}.png": law_picture(record["campaign"], law) for k, law in enumerate(every, start=1)}


def law_picture(campaign: str, law: Json) -> bytes:
    """One law: the band of the curve without a form, the form in it, single load steps behind."""
    figure = Figure(figsize=(7.4, 4.6))
    ax = figure.subplots()
    draw(ax, law)
    ax.set_title(f"{campaign}: {law['site']}, {law['where']}", fontsize=10, color=INK)
    ax.legend(frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=2)
    return picture(figure)


def draw(ax: Any, law: Json) -> None:
    """A law that has a curve into axes, without title and legend."""
    curve = law["curve"]
    ax.axhline(0.0, color=FAINT, lw=0.8)
    ax.axvline(0.0, color=FAINT, lw=0.8)
    height = max(float(np.max(np.abs(curve[name]), initial=0.0)) for name in ("free", "low", "high", "y"))
    own_y = np.asarray(curve["own_y"])
    shown = np.abs(own_y) <= SHARE * height
    own_x = np.asarray(curve["own_x"])[shown]
    steps = "single load steps, each by itself"
    ax.plot(own_x, own_y[shown], ".", color=FAINT, ms=4, label=steps, zorder=1)
    x, band = curve["free_x"], "95 % band, no form"
    ax.fill_between(x, curve["low"], curve["high"], color=ACCENT, alpha=0.18, lw=0, label=band)
    ax.plot(x, curve["free"], color=ACCENT, lw=1.4, label="curve without a form")
    if law["form"] is not None:
        ax.plot(curve["x"], curve["y"], color=CYCLE[1], lw=1.8, label=f"{law['form']}: {law['equation']}")
    ax.set_xlabel(f"{_what(law, load=True)} / {curve['x_unit']}" if curve["x_unit"] else "predicted reading")
    ax.set_ylabel(
        f"{_what(law, load=False)} / {curve['y_unit']}" if curve["y_unit"] else "error of the reading"
    )
    dress(ax)


def _what(law: Json, load: bool) -> str:
    """What stands on an axis: the coordinate of the law, or what it gives."""
    curve = law["curve"]
    turns = "rad" in (curve["x_unit"], curve["y_unit"])
    moved, carried = ("turn", "moment") if turns else ("displacement", "force")
    series = curve["y_unit"] in ("mm", "rad")
    return (carried if load else moved) if series else (moved if load else carried)
