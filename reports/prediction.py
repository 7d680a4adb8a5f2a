"""Predicted readings as pictures: the band of 95 % and what was read, over the load steps of a history."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from reports.charts import dress, picture
from reports.style import ACCENT, CYCLE, FAINT, INK

Json = Mapping[str, Any]
PANELS = 6
"""Columns of one picture, at most."""
PICTURES = 12
"""Histories that are drawn, at most: held-out ones and those of a table first."""
FEW = 3
"""Load steps of a history up to which each has its own bar."""
DENSE = 200
"""Load steps up to which each is drawn."""


def drawn(record: Json) -> dict[str, bytes]:
    """PNG of each history, by file name."""
    named = list(histories(record).items())[:PICTURES]
    return {
        f"history_{k}.png": history(record["campaign"], name, rows)
        for k, (name, rows) in enumerate(named, start=1)
        if any(row["readings"] for row in rows)
    }


def histories(record: Json) -> dict[str, list[Json]]:
    """Rows by the name of their history; those that were not fitted first."""
    tests: dict[str, list[Json]] = {}
    for row in record["rows"]:
        tests.setdefault(row["test"], []).append(row)
    return dict(sorted(tests.items(), key=lambda each: each[1][0]["role"] == "fit"))


def history(campaign: str, name: str, rows: list[Json]) -> bytes:
    """One history: a panel a column, its band, its prediction and its readings, over the number of the load step."""
    figure = Figure()
    draw(figure, f"{campaign}: {name}", rows)
    return picture(figure)


def draw(figure: Figure, title: str, rows: list[Json], over: str = "load step") -> None:
    """The same into a figure, which gets its size. over: what the numbers of rows count."""
    rows = rows[:: max(1, len(rows) // DENSE)]
    columns = list(dict.fromkeys(each["column"] for row in rows for each in row["readings"]))[:PANELS]
    across = 2 if len(columns) > 1 else 1
    down = -(-len(columns) // across)
    figure.set_size_inches(7.4, 2.3 * down + 0.8)
    axes = np.atleast_1d(figure.subplots(down, across, squeeze=False)).ravel()
    for ax, column in zip(axes, columns, strict=False):
        _panel(ax, rows, column)
        ax.set_xlabel(over)
    for ax in axes[len(columns) :]:
        ax.set_visible(False)
    named = {
        label: handle for ax in axes for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    handles, labels = list(named.values()), list(named)
    figure.legend(handles, labels, frameon=False, fontsize=8, loc="lower center", ncol=4)
    figure.suptitle(title, fontsize=10, color=INK)
    figure.tight_layout(rect=(0.0, 0.06, 1.0, 0.98))


def _panel(ax: Any, rows: list[Json], column: str) -> None:
    steps, readings = [], []
    for row in rows:
        for each in row["readings"]:
            if each["column"] == column:
                steps.append(row["step"])
                readings.append(each)
    value, low, high = (np.array([each[key] for each in readings]) for key in ("value", "low95", "high95"))
    ax.axhline(0.0, color=FAINT, lw=0.8)
    if len(steps) <= FEW:
        # A few load cases are no path.
        ax.vlines(steps, low, high, color=ACCENT, alpha=0.4, lw=5, label="95 % of readings")
        ax.plot(steps, value, "_", color=ACCENT, ms=10, label="predicted")
        ax.set_xticks(steps)
        ax.margins(x=0.3)
    else:
        ax.fill_between(steps, low, high, color=ACCENT, alpha=0.25, lw=0, label="95 % of readings")
        ax.plot(steps, value, color=ACCENT, lw=1.2, label="predicted")
    for inside, color, label in ((True, INK, "read, inside"), (False, CYCLE[1], "read, outside")):
        own = [k for k, each in enumerate(readings) if each["inside"] is inside]
        if not own:
            continue
        ax.plot(
            [steps[k] for k in own],
            [readings[k]["measured"] for k in own],
            ".",
            color=color,
            ms=5,
            label=label,
            zorder=3,
        )
    ax.set_ylabel(column)
    dress(ax)
