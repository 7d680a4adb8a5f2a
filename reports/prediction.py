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
DENSE = 200
"""Load steps up to which each is drawn."""


def drawn(record: Json) -> dict[str, bytes]:
    """PNG of each history, by file name."""
    tests: dict[str, list[Json]] = {}
    for row in record["rows"]:
        tests.setdefault(row["test"], []).append(row)
    order = sorted(tests, key=lambda name: tests[name][0]["role"] == "fit")
    return {
        f"history_{k}.png": history(record["campaign"], name, tests[name])
        for k, name in enumerate(order[:PICTURES], start=1)
        if any(row["readings"] for row in tests[name])
    }


def history(campaign: str, name: str, rows: list[Json]) -> bytes:
    """One history: a panel a column, its band, its prediction and its readings, over the number of the load step."""
    rows = rows[:: max(1, len(rows) // DENSE)]
    columns = list(dict.fromkeys(each["column"] for row in rows for each in row["readings"]))[:PANELS]
    across = 2 if len(columns) > 1 else 1
    down = -(-len(columns) // across)
    figure = Figure(figsize=(7.4, 2.3 * down + 0.8))
    axes = np.atleast_1d(figure.subplots(down, across, squeeze=False)).ravel()
    for ax, column in zip(axes, columns, strict=False):
        _panel(ax, rows, column)
    for ax in axes[len(columns) :]:
        ax.set_visible(False)
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, fontsize=8, loc="lower center", ncol=4)
    figure.suptitle(f"{campaign}: {name}", fontsize=10, color=INK)
    figure.tight_layout(rect=(0.0, 0.06, 1.0, 0.98))
    return picture(figure)


def _panel(ax: Any, rows: list[Json], column: str) -> None:
    steps, readings = [], []
    for row in rows:
        for each in row["readings"]:
            if each["column"] == column:
                steps.append(row["step"])
                readings.append(each)
    value, low, high = (np.array([each[key] for each in readings]) for key in ("value", "low95", "high95"))
    ax.axhline(0.0, color=FAINT, lw=0.8)
    ax.fill_between(steps, low, high, color=ACCENT, alpha=0.25, lw=0, label="95 % of readings")
    ax.plot(steps, value, color=ACCENT, lw=1.2, label="predicted")
    for inside, color, label in ((True, INK, "read, inside"), (False, CYCLE[1], "read, outside")):
        own = [k for k, each in enumerate(readings) if each["inside"] is inside]
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
    ax.set_xlabel("load step")
    dress(ax)
