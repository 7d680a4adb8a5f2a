"""Static pictures by matplotlib for the Markdown twin of a campaign's page."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.campaign import first_picture
from reports.campaign.curve import BAND, COLOURS, NAMES, WIDTHS
from reports.campaign.names import (
    BEFORE,
    by_role,
    channel_label,
    channels,
    measured,
    stages_of,
    standing,
    test_label,
    unit_label,
    worst,
)
from reports.campaign.plots import FEW_TESTS, short
from reports.charts import dress, picture
from reports.load import Json
from reports.shading import ATTENTION, LIKENESS, MISFIT, TOP, colormap, colour, ink_on, share_of
from reports.style import FAINT, INK

WORST = 6
"""Curves that are shown as pictures."""


def draw(page: Json) -> dict[str, bytes]:
    """All pictures by name."""
    out = {"misfit": misfit(page), first_picture.NAME: first_picture.drawn(page)[1]} if measured(page) else {}
    out |= {
        f"curve_{k}": curve(test, it, stages_of(page["effects"]))
        for k, (test, it) in enumerate(worst(page, WORST), 1)
    }
    if page["isolability"] is not None:
        out["isolability"] = isolability(page["isolability"])
    return out


def misfit(page: Json) -> bytes:
    """Tests by channels before and after."""
    names, tests = channels(page), by_role(page)
    stages = stages_of(page["effects"])
    figure = Figure(figsize=(2.6 + 0.36 * len(stages) * len(names), 1.6 + 0.27 * max(len(tests), FEW_TESTS)))
    axes = figure.subplots(1, len(stages), sharey=True, squeeze=False, gridspec_kw={"wspace": 0.04})[0]
    grids = [_grid(tests, names, f"rms_{key}") for key in stages]
    shades = colormap(MISFIT)
    titles = [f"{key}: {NAMES[key]}" for key in stages] if len(stages) > 1 else [BEFORE]
    for ax, grid, title in zip(axes, grids, titles, strict=True):
        shares = np.array([[np.nan if np.isnan(v) else share_of(v) for v in row] for row in grid])
        image = ax.imshow(shares, cmap=shades, vmin=0.0, vmax=1.0, aspect="auto")
        ax.set_title(title, fontsize=10, loc="left", color=INK)
        ax.set_xticks(range(len(names)), [channel_label(name) for name in names], fontsize=8)
        for (row, column), value in np.ndenumerate(grid):
            if np.isfinite(value):
                ink = ink_on(colour(MISFIT, share_of(float(value))))
                said = short(float(value))
                ax.text(column, row, said, ha="center", va="center", fontsize=6.5, color=ink)
    axes[0].set_yticks(range(len(tests)), [test_label(test) for test in tests], fontsize=8)
    bar = figure.colorbar(image, ax=list(axes), fraction=0.02, pad=0.015)
    shown = [1.0, ATTENTION, 10.0, 100.0, TOP]
    bar.set_ticks([share_of(v) for v in shown], labels=[f"{v:g}" for v in shown])
    bar.set_label("misfit, sigma")
    return picture(figure)


def curve(test: Json, it: Json, stages: Sequence[str]) -> bytes:
    """One channel of one test. stages: as of `curve.figure`."""
    figure = Figure(figsize=(8.2, 3.6 + 1.2 * len(stages)))
    heights = [2.6, 1.0, 1.2] if len(stages) > 1 else [2.6, 1.2]
    upper, *lower = figure.subplots(
        len(heights), 1, sharex=True, gridspec_kw={"height_ratios": heights, "hspace": 0.12}
    )
    loads = _floats(test["loads"])
    for key in stages:
        upper.plot(loads, _floats(it[key]), color=COLOURS[key], lw=WIDTHS[key], label=NAMES[key])
    upper.errorbar(
        loads,
        _floats(it["measured"]),
        _floats(it["sigma"]),
        fmt="o",
        ms=3.2,
        color=INK,
        capsize=2,
        lw=0.9,
        label="measured, ± 1 sigma",
    )
    upper.set_ylabel(f"{channel_label(it['channel'])}, {unit_label(it['unit'])}")
    upper.set_title(standing(test), fontsize=10, loc="left", color=INK)
    upper.legend(frameon=False, fontsize=8, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=3)
    for ax, key in zip(lower, stages, strict=True):
        ax.axhspan(-BAND, BAND, color=FAINT, alpha=0.18, lw=0)
        ax.plot(loads, _floats(it[f"left_{key}"]), color=COLOURS[key], marker="o", ms=3, lw=0.9)
        ax.set_ylabel(f"left {key},\nsigma" if len(stages) > 1 else "left, sigma", fontsize=9)
    for ax in (upper, *lower):
        dress(ax)
    lower[-1].set_xlabel(
        f"{channel_label(test['load'])}, {unit_label(test['load_unit'])}, what drives the test"
    )
    return picture(figure)


def isolability(found: Json) -> bytes:
    """How alike effects look."""
    names = found["effects"]
    figure = Figure(figsize=(2.6 + 0.42 * len(names), 2.2 + 0.34 * len(names)))
    ax: Axes = figure.subplots()
    grid = np.array([_floats(row) for row in found["correlation"]])
    image = ax.imshow(grid, cmap=colormap(LIKENESS), vmin=0.0, vmax=1.0, aspect="auto")
    for (row, column), value in np.ndenumerate(grid):
        if value >= 0.9 and row != column:
            ax.text(
                column,
                row,
                f"{value:.3f}"[1:] if value < 0.9995 else "1",
                ha="center",
                va="center",
                fontsize=6,
                color=ink_on(colour(LIKENESS, float(value))),
            )
    ax.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=8)
    ax.set_yticks(range(len(names)), names, fontsize=8)
    ax.set_xlabel("could be taken for this effect")
    figure.colorbar(image, ax=ax, fraction=0.03, pad=0.02).set_label("correlation")
    return picture(figure)


def _grid(tests: Sequence[Json], names: Sequence[str], key: str) -> np.ndarray:
    by_channel = [{it["channel"]: it[key] for it in test["curves"]} for test in tests]
    return np.array([_floats([found.get(name) for name in names]) for found in by_channel])


def _floats(values: Sequence[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], dtype=float)
