"""Plots of a campaign's page that can be zoomed: errors, maps of misfit, likeness of effects."""

from collections.abc import Sequence
from html import escape
from typing import Any

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from reports.campaign.names import AFTER, BEFORE, by_role, channel_label, channels, test_label
from reports.formats import number
from reports.load import Json
from reports.plots import style
from reports.shading import ATTENTION, MISFIT, TOP, inks, scale, share_of
from reports.style import INK

CHOSEN = "#0072B2"
FEW_TESTS = 5
"""Tests for which a map has room at least: its scale needs it."""
CELL = 11
"""Pixels of a number in a cell."""
CELLS: dict[str, Any] = {
    "hovertemplate": "%{y}<br>%{x}: %{hovertext} sigma<extra></extra>",
    "hoverongaps": False,
    "xgap": 1,
    "ygap": 1,
    "coloraxis": "coloraxis",
}


def misfit_map(
    page: Json, stages: Sequence[str] = ("before", "after"), chosen: tuple[str, str] | None = None
) -> go.Figure:
    """Tests by channels, in the channels' own sigmas, before and after. chosen: the cell that is framed, by the labels
    of its test and its channel."""
    names, tests = channels(page), by_role(page)
    labels = [escape(test_label(test)) for test in tests]
    titles = {"before": f"before: {BEFORE}", "after": f"after: {AFTER}"}
    plot = make_subplots(
        rows=1,
        cols=len(stages),
        shared_yaxes=True,
        horizontal_spacing=0.02,
        subplot_titles=[titles[key] for key in stages] if len(stages) > 1 else None,
    )
    for column, key in enumerate(stages, 1):
        grid = _grid(tests, names, f"rms_{key}")
        columns = [channel_label(name) for name in names]
        plot.add_heatmap(
            z=[[None if v is None else share_of(v) for v in row] for row in grid],
            x=columns,
            y=labels,
            hovertext=[["" if v is None else number(v, 3) for v in row] for row in grid],
            # Labels are escaped for plotly; the curves are chosen by the names themselves.
            customdata=[[[test_label(test), channel_label(name)] for name in names] for test in tests],
            row=1,
            col=column,
            **CELLS,
        )
        shares = [[None if v is None else share_of(v) for v in row] for row in grid]
        said = [["" if v is None else short(v) for v in row] for row in grid]
        numbers(plot, columns, labels, said, [inks(MISFIT, row) for row in shares], row=1, col=column)
    height = 130 + 24 * max(len(labels), FEW_TESTS)
    style(
        plot,
        height,
        margin={"l": 20, "r": 20, "t": 50 if len(stages) > 1 else 40, "b": 50},
        coloraxis=_shades(),
    )
    plot.update_xaxes(title_text="channel", showgrid=False, type="category")
    plot.update_yaxes(autorange="reversed", automargin=True, showgrid=False, type="category")
    held_out = sum(test["role"] == "holdout" for test in tests)
    if held_out:
        plot.add_hline(y=len(tests) - held_out - 0.5, line={"color": INK, "width": 2})
    rows, columns = [test_label(test) for test in tests], [channel_label(name) for name in names]
    if chosen is not None and chosen[0] in rows and chosen[1] in columns:
        at, over = rows.index(chosen[0]), columns.index(chosen[1])
        frame = {"x0": over - 0.5, "x1": over + 0.5, "y0": at - 0.5, "y1": at + 0.5}
        for place in range(1, len(stages) + 1):
            plot.add_shape(type="rect", **frame, line={"color": CHOSEN, "width": 3}, row=1, col=place)
    return plot


def numbers(
    plot: go.Figure,
    columns: Sequence[str],
    rows: Sequence[str],
    said: Sequence[Sequence[str]],
    colours: Sequence[Sequence[str]],
    size: int = CELL,
    **where: int,
) -> None:
    """What each cell of a map says, each in an ink that can be read on its colour."""
    cells = [
        (x, y, said[i][j], colours[i][j])
        for i, y in enumerate(rows)
        for j, x in enumerate(columns)
        if said[i][j]
    ]
    x, y, text, ink = (list(each) for each in zip(*cells, strict=True)) if cells else ([], [], [], [])
    plot.add_scatter(
        x=x,
        y=y,
        text=text,
        mode="text",
        textfont={"size": size, "color": ink},
        hoverinfo="skip",
        showlegend=False,
        cliponaxis=False,
        **where,
    )


def _shades() -> dict[str, Any]:
    """From noise to a thousand sigmas, the same for every campaign."""
    shown = [1.0, ATTENTION, 10.0, 100.0, TOP]
    bar = {
        "title": {"text": "misfit,<br>sigma<br> "},
        "thickness": 12,
        "outlinewidth": 1,
        "outlinecolor": "#8a949e",
    }
    bar |= {"tickvals": [share_of(v) for v in shown], "ticktext": [f"{v:g}" for v in shown]}
    return {"colorscale": scale(MISFIT), "cmin": 0.0, "cmax": 1.0, "colorbar": bar}


def _grid(tests: list[Json], names: list[str], key: str) -> list[list[float | None]]:
    by_channel = [{curve["channel"]: curve[key] for curve in test["curves"]} for test in tests]
    return [[found.get(name) for name in names] for found in by_channel]


def short(value: float) -> str:
    """As narrow as a cell: 0.8, 31, 849, 1.7k."""
    if value < 999.5:
        return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"
    thousands = value / 1e3
    return f"{thousands:.1f}k" if thousands < 9.95 else f"{thousands:.0f}k" if thousands < 999.5 else ">1M"
