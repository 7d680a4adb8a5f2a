"""Laws over their coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import FigureBase

from reports.first_screen.drawn import Picture
from reports.laws import draw
from reports.style import INK

Json = Mapping[str, Any]
MOST, LETTERS = 3, 48
"""Laws that are drawn side by side, the first ones; letters of a title."""
WIDE, HIGH = 5.2, 4.4
"""Inches of each."""


def laws(found: Sequence[Json], name: str) -> Picture:
    """The first laws that have a curve, side by side; in words where there is none. found: records of laws."""
    drawn = shown(found)
    figure = Picture(figsize=(max(6.4, WIDE * len(drawn)), HIGH))
    if not drawn:
        figure.text(0.5, 0.5, f"{name}: no law to draw", ha="center", va="center", color=INK)
        return figure
    side_by_side(figure, drawn)
    return figure


def shown(found: Sequence[Json]) -> list[Json]:
    """Those that are drawn."""
    return [law for law in found if law["curve"] is not None][:MOST]


def side_by_side(figure: FigureBase, drawn: Sequence[Json]) -> None:
    """Laws that have curves into a figure or a part of one."""
    places = figure.subplots(1, len(drawn), squeeze=False, gridspec_kw={"wspace": 0.32, "bottom": 0.32})[0]
    for ax, law in zip(places, drawn, strict=True):
        draw(ax, law)
        title = f"{law['site']}: {law['where']}"
        cut = title if len(title) <= LETTERS else f"{title[: LETTERS - 4]} ..."
        ax.set_title(cut, fontsize=10, loc="left", color=INK)
        # Below the axes, where it hides no curve.
        ax.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(-0.02, -0.15))
