"""One channel of one test: measured against predicted, and under it what each model leaves.

Plots are plain dicts as plotly.js reads them: a page has hundreds, and plotly's own objects take 0.1 s each.
"""

import json
from collections.abc import Sequence
from functools import cache
from html import escape
from typing import Any

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from reports.campaign.names import AFTER, BEFORE, axis_label, standing
from reports.formats import number
from reports.load import Json
from reports.plots import style
from reports.style import FAINT, INK

COLOURS = {"before": "#D55E00", "after": "#0072B2"}
WIDTHS = {"before": 1.0, "after": 2.4}
"""Dashes of a line that goes back over itself, as load and relief do, are no dashes."""
SYMBOLS = {"before": "diamond-open", "after": "circle-open"}
NAMES = {"before": BEFORE, "after": AFTER}
HEIGHT = 500
BAND = 2.0
"""Sigmas that noise seldom leaves."""


def thinned(test: Json, curve: Json, stride: int) -> tuple[Json, Json]:
    """Every so many steps of both, the first one among them."""
    if stride == 1:
        return test, curve
    steps = {key: test[key][::stride] for key in ("loads", "steps")}
    kept = {key: value[::stride] if isinstance(value, list) else value for key, value in curve.items()}
    return {**test, **steps}, kept


def figure(
    test: Json, curve: Json, height: int = HEIGHT, stages: Sequence[str] = ("before", "after")
) -> dict[str, Any]:
    """Lines join the steps in the order in which they were done, so that a loop is a loop. stages: before alone where
    the model is the plain one."""
    traces = [_predicted(test, curve, key) for key in stages]
    traces.append(_measured(test, curve))
    traces += [_left(test, curve, key, str(axis)) for axis, key in enumerate(stages, 2)]
    layout = json.loads(_layout(height, tuple(stages)))
    channel = axis_label(curve["channel"], curve["unit"])
    layout["title"]["text"] = f"{escape(standing(test))}: {channel}"
    layout[f"xaxis{len(stages) + 1}"]["title"]["text"] = (
        f"{axis_label(test['load'], test['load_unit'])} (drives the test)"
    )
    layout["yaxis"]["title"]["text"] = axis_label(curve["channel"], curve["unit"])
    return {"data": traces, "layout": layout}


def _predicted(test: Json, curve: Json, key: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{NAMES[key]}, {_rms(curve[f'rms_{key}'])}",
        "x": test["loads"],
        "y": curve[key],
        "text": _steps(test),
        "line": {"color": COLOURS[key], "width": WIDTHS[key]},
        "legendgroup": key,
        "xaxis": "x",
        "yaxis": "y",
    }


def _measured(test: Json, curve: Json) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "measured, ± 1 sigma",
        "x": test["loads"],
        "y": curve["measured"],
        "error_y": {"type": "data", "array": curve["sigma"], "thickness": 1.2, "width": 3, "color": INK},
        "text": _steps(test),
        "marker": {"color": INK, "size": 5},
        "xaxis": "x",
        "yaxis": "y",
    }


def _left(test: Json, curve: Json, key: str, axis: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": f"left by {NAMES[key]}",
        "x": test["loads"],
        "y": curve[f"left_{key}"],
        "text": _steps(test),
        "line": {"color": COLOURS[key], "width": 1},
        "marker": {"color": COLOURS[key], "size": 5, "symbol": SYMBOLS[key]},
        "legendgroup": key,
        "showlegend": False,
        "xaxis": f"x{axis}",
        "yaxis": f"y{axis}",
    }


@cache
def _layout(height: int, stages: tuple[str, ...]) -> str:
    """What all curves share, as JSON."""
    heights = [0.52, 0.22, 0.26] if len(stages) > 1 else [0.62, 0.38]
    plot: go.Figure = make_subplots(
        rows=len(heights), cols=1, shared_xaxes=True, vertical_spacing=0.045, row_heights=heights
    )
    legend = {"orientation": "h", "y": 1.01, "yanchor": "bottom", "x": 0, "xanchor": "left"}
    title = {"text": "", "x": 0, "xref": "paper", "font": {"size": 14}}
    style(plot, height, title=title, margin={"l": 80, "r": 20, "t": 64, "b": 46}, legend=legend)
    plot.update_xaxes(title_text="")
    unit, size = ("sigma", 13) if height >= HEIGHT else ("σ", 11)
    names = [f"{key}, {unit}" if len(stages) > 1 else f"left, {unit}" for key in stages]
    for row, said in enumerate(("", *names), 1):
        plot.update_yaxes(title_text=said, title_font_size=size, row=row, col=1)
        if row > 1:
            if height < HEIGHT:
                plot.update_yaxes(nticks=4, row=row, col=1)
            band = {"fillcolor": FAINT, "opacity": 0.18, "line_width": 0, "layer": "below"}
            plot.add_hrect(-BAND, BAND, row=row, col=1, exclude_empty_subplots=False, **band)
    return json.dumps(plot.to_plotly_json()["layout"])


def _steps(test: Json) -> list[str]:
    return [f"step {step}" for step in test["steps"]]


def _rms(value: float | None) -> str:
    return "no prediction" if value is None else f"{number(value, 3)} sigma"
