"""Plots that can be zoomed, by plotly."""

from html import escape
from math import ceil, floor, log10
from typing import Any

import plotly.graph_objects as go

from reports.curves import Panel, panels
from reports.formats import fixed, held_label, number, symbol, trimmed
from reports.load import Json
from reports.style import ACCENT, CYCLE, FAINT, GRID, INK, colour_of, model_label
from reports.tables_linkage import groups

FONT = {"family": "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif", "size": 13, "color": INK}
LABELS = 250
"""Pixels right of the curves, for the labels of the critical loads."""
SYMBOLS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "cross", "x", "star")


def style(figure: go.Figure, height: int, **layout: Any) -> go.Figure:
    """The look that all plots share."""
    figure.update_layout(
        template="none",
        font=FONT,
        height=height,
        paper_bgcolor="rgba(0,0,0,0)",
        plot_bgcolor="white",
        legend={"orientation": "h", "y": -0.2, "yanchor": "top", "x": 0, "xanchor": "left"},
        margin={"l": 70, "r": 20, "t": 30, "b": 60},
        modebar={"bgcolor": "rgba(0,0,0,0)", "color": FAINT, "activecolor": ACCENT},
        hoverlabel={"font": {"family": FONT["family"]}},
    )
    look = {
        "gridcolor": GRID,
        "zerolinecolor": FAINT,
        "linecolor": FAINT,
        "ticks": "outside",
        "title_font_size": 13,
        "tickcolor": FAINT,
    }
    figure.update_xaxes(**look)
    figure.update_yaxes(**look)
    figure.update_layout(**layout)
    return figure


def distances(record: Json) -> dict[str, tuple[list[int], list[float]]]:
    """Dofs and |K / K_extrapolated - 1| of each entry; exact hits have no place on a log axis."""
    found = {}
    for entry, values in record["entries"].items():
        limit = record["extrapolated"][int(entry[1]) - 1][int(entry[2]) - 1]
        points = [
            (n, abs(v / limit - 1.0)) for n, v in zip(record["dofs"], values, strict=True) if v != limit
        ]
        found[entry] = ([n for n, _ in points], [off for _, off in points])
    return found


def convergence(result: Json) -> go.Figure:
    """Distance to the extrapolated value against dofs, log-log, observed orders in the legend."""
    record, working = result["bar"]["convergence"], result["bar"]["dofs"]
    figure = go.Figure()
    for i, (entry, (dofs, off)) in enumerate(distances(record).items()):
        name = f"{symbol(entry)}, order {fixed(record['orders'][entry] or None, 2)}"
        look = {"color": CYCLE[i % 8], "symbol": SYMBOLS[i % 8], "size": 8}
        figure.add_scatter(x=dofs, y=off, name=name, mode="lines+markers", marker=look, line={"width": 1.8})
    figure.add_vline(x=working, line={"color": FAINT, "dash": "dash", "width": 1.2})
    # An annotation on a log axis is placed by the logarithm, a line by the value.
    figure.add_annotation(
        text="working mesh",
        x=log10(working),
        xref="x",
        y=1,
        yref="paper",
        showarrow=False,
        xanchor="left",
        xshift=4,
    )
    figure.update_xaxes(type="log", title="degrees of freedom", **ticks(1, 1e8))
    figure.update_yaxes(type="log", title="|K / K extrapolated − 1|", dtick=1, exponentformat="power")
    return style(figure, 520)


def ticks(low: float, high: float) -> dict[str, list[Any]]:
    """Ticks of a log axis at 1, 2, 5, 10, .., each written in full."""
    decades = range(floor(log10(low)), ceil(log10(high)) + 1)
    values = [step * 10.0**decade for decade in decades for step in (1, 2, 5)]
    return {"tickvals": values, "ticktext": [trimmed(number(value)) for value in values]}


def critical(result: Json) -> go.Figure:
    """Critical loads on a log axis; hatched bars are tension."""
    figure = go.Figure()
    by_set = groups(result["critical"])
    rows = [f"q = {q:g}°<br>held {escape(held_label(held))}" for q, held in by_set]
    names = list(dict.fromkeys(model_label(item) for item in result["critical"]))
    for name in names:
        x, y, hatch, text = [], [], [], []
        for row, by_model in zip(rows, by_set.values(), strict=True):
            loads = [item["load_N"] for item in by_model.get(name, []) if item["load_N"] is not None]
            # Two bars of one model in one row would be stacked: the lowest load is the critical one.
            for load in sorted(loads, key=abs)[:1]:
                x.append(abs(load) / 1e3)
                y.append(row)
                hatch.append("/" if load < 0 else "")
                text.append(f"{number(abs(load) / 1e3, 4)}{' tension' if load < 0 else ''}")
        look = {
            "color": colour_of(name),
            "pattern": {"shape": hatch, "fillmode": "overlay", "fgcolor": "white"},
        }
        figure.add_bar(
            x=x,
            y=y,
            orientation="h",
            name=escape(name),
            marker=look,
            text=text,
            textposition="outside",
            textfont={"size": 11},
            cliponaxis=False,
            hovertemplate="%{x:.4g} kN<extra>%{y}</extra>",
        )
    found = [log10(v) for trace in figure.data for v in trace.x]
    span = [min(found, default=0.0) - 0.3, max(found, default=1.0) + 0.2]
    figure.update_xaxes(
        type="log", title="|critical load|, kN", range=span, **ticks(10 ** span[0], 10 ** span[1])
    )
    figure.update_yaxes(autorange="reversed", automargin=True)
    height = 170 + 24 * len(rows) * max(1, len(names))
    return style(
        figure, height, bargap=0.22, margin={"l": 20, "r": 60, "t": 20, "b": 60}, legend={"y": -70 / height}
    )


def force_deflection(result: Json, q_deg: float) -> go.Figure:
    """Fig. 3 at one angle: VJM, solid, frame and LIN, a drop-down for what is held."""
    found = [panel for panel in panels(result) if panel.q_deg == q_deg]
    figure = go.Figure()
    owners: list[int] = []
    for index, panel in enumerate(found):
        add_panel(figure, panel)
        owners += [index] * (len(figure.data) - len(owners))
    for trace, owner in zip(figure.data, owners, strict=True):
        trace.visible = owner == 0
    buttons = [
        {
            "label": "held: " + escape(held_label(panel.held)),
            "method": "update",
            "args": [
                {"visible": [owner == index for owner in owners]},
                {"xaxis.range": list(panel.x_range), "yaxis.range": list(panel.y_range)},
            ],
        }
        for index, panel in enumerate(found)
    ]
    figure.update_xaxes(title="shortening −x, mm", range=list(found[0].x_range))
    figure.update_yaxes(title="compression −F<sub>x</sub>, kN", range=list(found[0].y_range))
    menu = {"buttons": buttons, "x": 0, "xanchor": "left", "y": 1.02, "yanchor": "bottom", "showactive": True}
    return style(figure, 560, updatemenus=[menu], margin={"l": 70, "r": LABELS, "t": 60, "b": 60})


def add_panel(figure: go.Figure, panel: Panel) -> None:
    """The traces of one held set."""
    for line in panel.lines:
        figure.add_scatter(
            x=line.x,
            y=line.y,
            name=escape(line.label),
            mode="lines",
            line={"color": line.colour, "dash": line.dash, "width": line.width},
            legendgroup=line.label,
            showlegend=line.named,
            hovertemplate="−x %{x:.4g} mm<br>−F<sub>x</sub> %{y:.4g} kN",
        )
    low, high = panel.x_range
    for level in panel.levels:
        figure.add_scatter(
            x=[low, high],
            y=[level.load] * 2,
            mode="lines",
            line={"color": level.colour, "dash": "longdash", "width": 1},
            legendgroup=level.label,
            showlegend=False,
            hovertemplate=f"critical: {escape(level.label)} %{{y:.4g}} kN<extra></extra>",
        )
    labels = panel.level_labels()
    figure.add_scatter(
        x=[high] * len(labels),
        y=[place for place, _ in labels],
        text=[escape(text) for _, text in labels],
        mode="markers+text",
        marker={"size": 3, "opacity": 0},
        textposition="middle right",
        textfont={"size": 11},
        cliponaxis=False,
        showlegend=False,
        hoverinfo="skip",
    )
