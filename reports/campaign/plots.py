"""Plots of a campaign's page that can be zoomed: errors, maps of misfit, likeness of effects."""

from collections.abc import Sequence
from html import escape
from math import log10
from typing import Any

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from reports.campaign.curve import COLOURS
from reports.campaign.names import AFTER, BEFORE, by_role, channel_label, channels, stage_labels, test_label
from reports.formats import number
from reports.load import Json
from reports.plots import style, ticks
from reports.style import INK

SHADES = "cividis_r"
"""Light is noise, dark is misfit; the same to colour-blind readers."""
HELD_OUT = "#E69F00"


CELLS: dict[str, Any] = {
    "texttemplate": "%{text}",
    "textfont": {"size": 10},
    "hovertemplate": "%{y}<br>%{x}: %{text} sigma<extra></extra>",
    "hoverongaps": False,
    "xgap": 1,
    "ygap": 1,
    "coloraxis": "coloraxis",
}


def waterfall(page: Json) -> go.Figure:
    """Error of the fitted and of the held-out tests as effects are added."""
    labels = [escape(label) for label in stage_labels(page)]
    plot = go.Figure()
    for key, name, colour, hatch in (
        ("fit", "fitted tests", COLOURS["after"], ""),
        ("holdout", "held-out tests, never used", HELD_OUT, "/"),
    ):
        values = [stage[key] for stage in page["error"]]
        if all(value is None for value in values):
            continue
        plot.add_bar(
            x=values,
            y=labels,
            orientation="h",
            name=name,
            marker={"color": colour, "pattern": {"shape": hatch, "fillmode": "overlay", "fgcolor": "white"}},
            text=["" if value is None else f"  {number(value, 3)}" for value in values],
            textposition="outside",
            cliponaxis=False,
            hovertemplate="%{x:.4g} sigma<extra>%{y}</extra>",
        )
    found = [value for trace in plot.data for value in trace.x if value]
    span = [log10(0.3), log10(max([3.0, *found])) + 0.25]
    plot.add_vline(x=1.0, line={"color": INK, "dash": "dash", "width": 1.2}, layer="below")
    plot.add_annotation(text="noise", x=0.0, xref="x", y=1, yref="paper", yanchor="bottom", showarrow=False)
    plot.update_xaxes(
        type="log",
        title_text="error, sigma (whitened root mean square)",
        range=span,
        **ticks(0.3, 10 ** span[1]),
    )
    plot.update_yaxes(autorange="reversed", automargin=True)
    height = 170 + 52 * len(labels)
    return style(
        plot,
        height,
        bargap=0.3,
        margin={"l": 20, "r": 50, "t": 30, "b": 80},
        legend={"y": -50 / (height - 110)},
    )


def misfit_map(page: Json, stages: Sequence[str] = ("before", "after"), height: int = 0) -> go.Figure:
    """Tests by channels, in the channels' own sigmas, before and after. height: of the plot; default by its rows."""
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
    every = [_grid(tests, names, f"rms_{key}") for key in ("before", "after")]
    # One scale before and after, whichever is shown.
    top = max([1.0, *(log10(v) for grid in every for row in grid for v in row if v)])
    for column, key in enumerate(stages, 1):
        grid = every[0] if key == "before" else every[1]
        plot.add_heatmap(
            z=[[None if v is None else log10(max(v, 1e-3)) for v in row] for row in grid],
            x=[channel_label(name) for name in names],
            y=labels,
            text=[["" if v is None else _short(v) for v in row] for row in grid],
            # Labels are escaped for plotly; the curves are chosen by the names themselves.
            customdata=[[[test_label(test), channel_label(name)] for name in names] for test in tests],
            row=1,
            col=column,
            **CELLS,
        )
    height = height or 130 + 24 * len(labels)
    style(
        plot,
        height,
        margin={"l": 20, "r": 20, "t": 50 if len(stages) > 1 else 10, "b": 50},
        coloraxis=_shades(top),
    )
    plot.update_xaxes(title_text="channel", showgrid=False, type="category")
    plot.update_yaxes(autorange="reversed", automargin=True, showgrid=False, type="category")
    held_out = sum(test["role"] == "holdout" for test in tests)
    if held_out:
        plot.add_hline(y=len(tests) - held_out - 0.5, line={"color": INK, "width": 2})
    return plot


def _shades(top: float) -> dict[str, Any]:
    """From noise to so many decades of sigmas."""
    whole = range(int(top) + 1)
    bar = {"title": {"text": "misfit,<br>sigma"}, "thickness": 12}
    bar |= {"tickvals": list(whole), "ticktext": [f"{10**k:g}" for k in whole]}
    return {"colorscale": SHADES, "cmin": 0.0, "cmax": top, "colorbar": bar}


def _grid(tests: list[Json], names: list[str], key: str) -> list[list[float | None]]:
    by_channel = [{curve["channel"]: curve[key] for curve in test["curves"]} for test in tests]
    return [[found.get(name) for name in names] for found in by_channel]


def _short(value: float) -> str:
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}" if value < 9999.5 else f"{value:.0e}"
