"""Several models beside what was measured: one channel of one test, and under it what each of them leaves."""

from collections.abc import Sequence
from typing import Any

from plotly.subplots import make_subplots

from reports.campaign.curve import BAND
from reports.campaign.names import axis_label
from reports.load import Json
from reports.plots import style
from reports.style import CYCLE, FAINT, INK

DASHES = ("solid", "dash", "dot", "dashdot")
SYMBOLS = ("circle", "diamond", "square", "x")


def figure(names: Sequence[str], test: Json, curves: Sequence[Json]) -> dict[str, Any]:
    """names: of the models; curves: the channel as each of them has it, of one test."""
    plot = make_subplots(rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.06, row_heights=[0.55, 0.45])
    first = curves[0]
    for k, (name, it) in enumerate(zip(names, curves, strict=True)):
        look = {"color": CYCLE[k % len(CYCLE)], "dash": DASHES[k % len(DASHES)], "width": 2}
        plot.add_scatter(x=test["loads"], y=it["after"], mode="lines", name=name, line=look, row=1, col=1)
        marker = {"symbol": SYMBOLS[k % len(SYMBOLS)], "size": 6, "color": look["color"]}
        plot.add_scatter(
            x=test["loads"],
            y=it["left_after"],
            mode="lines+markers",
            line={**look, "width": 1},
            marker=marker,
            showlegend=False,
            name=name,
            row=2,
            col=1,
        )
    error = {"type": "data", "array": first["sigma"], "thickness": 1.2, "width": 3, "color": INK}
    plot.add_scatter(
        x=test["loads"],
        y=first["measured"],
        mode="markers",
        name="measured, ± 1 sigma",
        marker={"color": INK, "size": 5},
        error_y=error,
        row=1,
        col=1,
    )
    plot.add_hrect(-BAND, BAND, row=2, col=1, fillcolor=FAINT, opacity=0.18, line_width=0, layer="below")
    legend = {"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0, "xanchor": "left"}
    style(plot, 440, margin={"l": 80, "r": 20, "t": 40, "b": 46}, legend=legend)
    plot.update_yaxes(title_text=axis_label(first["channel"], first["unit"]), row=1, col=1)
    plot.update_yaxes(title_text="left, sigma", row=2, col=1)
    plot.update_xaxes(title_text=axis_label(test["load"], test["load_unit"]), row=2, col=1)
    found: dict[str, Any] = plot.to_plotly_json()
    return found
