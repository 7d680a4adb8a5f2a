"""Pictures of results by matplotlib: a curve beside models, errors, sizes, a heat map of a matrix, sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from reports.campaign.names import channel_label, unit_label
from reports.charts import dress
from reports.first_screen.drawn import Picture
from reports.first_screen.laws import HIGH as LAW_HIGH
from reports.first_screen.laws import WIDE as LAW_WIDE
from reports.first_screen.laws import Json, shown, side_by_side
from reports.quantities import short, sigma
from reports.style import ACCENT, CYCLE, FAINT, INK

Numbers = Sequence[float | None]
WIDE, ROW, LETTERS, MOST, BESIDE = 8.0, 0.32, 34, 40, 12
"""Inches of a picture and of a row of bars; letters of a label; rows at most, and beside a curve."""
FEW = 3
"""Readings of a curve up to which its points are marked."""
DASHES = ("--", "-", "-.", ":")
COLOURS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7")


@dataclass(frozen=True)
class Line:
    """What one model predicts, in the unit of the channel; rms: of what it leaves, in sigmas."""

    name: str
    values: Numbers
    rms: float | None


@dataclass(frozen=True)
class Measured:
    """One channel of a test over what drives it; sigma: standard deviation of each reading, in `unit`."""

    title: str
    load: str
    load_unit: str
    channel: str
    unit: str
    loads: Numbers
    measured: Numbers
    sigma: Numbers
    lines: tuple[Line, ...]


@dataclass(frozen=True)
class Bars:
    """Rows of bars. values: one row a label, one bar a name; None where there is none. marks: of each row, or none."""

    labels: tuple[str, ...]
    names: tuple[str, ...]
    values: tuple[Numbers, ...]
    axis: str
    title: str = ""


def curve(it: Measured | None, bars: Bars | None = None, found: Sequence[Json] = ()) -> Picture:
    """Errors at the left where there are some, one channel measured and predicted at the right; laws that were found,
    as records, below."""
    drawn = shown(found)
    if it is None and bars is not None and not drawn:
        return errors(bars)
    rows = 0 if bars is None else min(len(bars.labels), BESIDE)
    wide, high = WIDE if bars is None else 1.35 * WIDE, max(3.8, 1.0 + ROW * rows)
    if not drawn:
        figure = Picture(figsize=(wide, high))
        _beside(figure, it, bars)
        return figure
    figure = Picture(figsize=(max(wide, LAW_WIDE * len(drawn)), high + LAW_HIGH))
    above, below = figure.subfigures(2, 1, squeeze=False, height_ratios=[high, LAW_HIGH])[:, 0]
    _beside(above, it, bars)
    side_by_side(below, drawn)
    return figure


def errors(it: Bars) -> Picture:
    """Errors in sigmas on a logarithmic axis, noise marked."""
    rows = min(len(it.labels), MOST)
    figure = Picture(figsize=(WIDE, 1.5 + ROW * max(rows, 2) * max(1.0, 0.6 * len(it.names))))
    if not it.labels:
        return _said(figure, "there is nothing to draw")
    _bars(figure.subplots(), it)
    return figure


def matrix(
    values: Sequence[Sequence[float]], rows: Sequence[str], labels: Sequence[str], title: str
) -> Picture:
    """Size of the entries of a matrix on a logarithmic scale, each with its number."""
    grid = np.array(values, dtype=float)
    figure = Picture(figsize=(1.0 + 0.95 * len(labels), 0.8 + 0.62 * len(labels)))
    ax = figure.subplots()
    size = np.abs(grid)
    least = size.max() * 1e-9
    shade = np.log10(np.where(size > least, size, np.nan))
    ax.imshow(shade, cmap="Blues", aspect="auto", vmin=np.nanmin(shade) - 2.0, vmax=np.nanmax(shade) + 5.0)
    for (row, column), value in np.ndenumerate(grid):
        if size[row, column] > least:
            ax.text(column, row, short(float(value)), ha="center", va="center", fontsize=8, color=INK)
    ax.set_xticks(range(len(labels)), labels)
    ax.set_yticks(range(len(rows)), rows)
    ax.set_title(title, fontsize=10, loc="left", color=INK)
    return figure


def outline(patches: Sequence[Sequence[tuple[float, float]]], title: str) -> Picture:
    """A cross-section, its patches filled; y to the right, z up, mm."""
    figure = Picture(figsize=(4.2, 4.2))
    ax = figure.subplots()
    for patch in patches:
        ys, zs = zip(*patch, strict=True)
        ax.fill(ys, zs, color=ACCENT, alpha=0.35, lw=0)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("y, mm")
    ax.set_ylabel("z, mm")
    ax.set_title(title, fontsize=10, loc="left", color=INK)
    dress(ax)
    return figure


def _beside(figure: FigureBase, it: Measured | None, bars: Bars | None) -> None:
    """Errors, a channel, or both side by side."""
    if it is None and bars is None:
        figure.text(
            0.5, 0.5, "nothing is measured yet that a model predicts", ha="center", va="center", color=INK
        )
    elif bars is None or it is None:
        ax = figure.subplots()
        if it is not None:
            _curve(ax, it)
        elif bars is not None:
            _bars(ax, bars, BESIDE)
    else:
        left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.25], "wspace": 0.28})
        _bars(left, bars, BESIDE)
        _curve(right, it)


def _curve(ax: Axes, it: Measured) -> None:
    loads = _floats(it.loads)
    for line, dash, colour in zip(it.lines, DASHES, COLOURS, strict=False):
        label = f"{_cut(line.name)}: {sigma(line.rms)} sigma"
        # A few load cases are no path.
        mark, dash = ("D", "") if loads.size <= FEW else (None, dash)
        values = _floats(line.values)
        ax.plot(loads, values, marker=mark, ls=dash, lw=1.7, ms=6, mfc="none", color=colour, label=label)
    ax.errorbar(
        loads,
        _floats(it.measured),
        _floats(it.sigma),
        fmt="o",
        ms=3.2,
        capsize=2,
        lw=0.9,
        color=INK,
        label="measured, ± 1 sigma",
    )
    ax.set_xlabel(f"{channel_label(it.load)}, {unit_label(it.load_unit)}")
    ax.set_ylabel(f"{channel_label(it.channel)}, {unit_label(it.unit)}")
    ax.set_title(f"{_cut(it.title)}: {channel_label(it.channel)}", fontsize=10, loc="left", color=INK)
    dress(ax)
    ax.legend(frameon=False, fontsize=8, loc="best")


def _bars(ax: Axes, it: Bars, most: int = MOST) -> None:
    there = [k for k in range(len(it.names)) if any(row[k] is not None for row in it.values)] or [0]
    names = [it.names[k] for k in there]
    labels, values = it.labels[:most], [[row[k] for k in there] for row in it.values[:most]]
    height = min(0.7, 0.1 + 0.12 * len(labels)) / len(names)
    every = [v for row in values for v in row if v is not None and np.isfinite(v) and v > 0.0]
    low, high = min([0.5, *every]), max([2.0, *every])
    for k, (name, colour) in enumerate(zip(names, CYCLE, strict=False)):
        sizes = [max(row[k] or 0.0, 0.5 * low) if row[k] is not None else np.nan for row in values]
        places = np.arange(len(labels)) + (k - 0.5 * (len(names) - 1)) * height
        ax.barh(places, sizes, height=0.9 * height, color=colour, label=name, left=0.0)
        for place, value in zip(places, [row[k] for row in values], strict=True):
            if value is not None:
                at = max(value, 0.5 * low) * 1.08
                ax.text(at, place, short(value), va="center", fontsize=8, color=INK)
    ax.set_xscale("log")
    ax.set_xlim(0.5 * low, 4.0 * high)
    ax.axvline(1.0, color=FAINT, ls="--", lw=1)
    ax.set_yticks(range(len(labels)), [_cut(each) for each in labels], fontsize=8)
    ax.set_ylim(len(labels) - 0.4, -0.6)
    ax.set_xlabel(it.axis)
    rest = f", {len(it.labels) - most} more not drawn" if len(it.labels) > most else ""
    ax.set_title(f"{it.title}{rest}", fontsize=10, loc="left", color=INK)
    dress(ax)
    if len(names) > 1:
        # Above the bars, where it hides none.
        ax.legend(
            frameon=False,
            fontsize=8,
            ncols=len(names),
            handlelength=1.0,
            loc="lower right",
            bbox_to_anchor=(1.02, 0.99),
        )


def _said(figure: Picture, words: str) -> Picture:
    figure.text(0.5, 0.5, words, ha="center", va="center", color=INK)
    return figure


def _cut(text: str) -> str:
    return text if len(text) <= LETTERS else f"{text[: LETTERS - 4]} ..."


def _floats(values: Numbers) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], dtype=float)
