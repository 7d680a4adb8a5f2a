"""How alike effects look in the tests of a campaign, as maps that can be hovered over."""

from collections.abc import Sequence
from html import escape

import plotly.graph_objects as go

from reports.campaign.plots import numbers
from reports.load import Json
from reports.plots import style
from reports.shading import LIKENESS, inks, scale

CLOSE = 0.3
"""A correlation below which a cell stays without a number."""

CELLS = {"colorscale": scale(LIKENESS), "zmin": 0.0, "zmax": 1.0, "xgap": 1, "ygap": 1}


def isolability(found: Json) -> go.Figure:
    """How alike effects look: rows explained by columns."""
    names = [escape(name) for name in found["effects"]]
    plot = go.Figure()
    plot.add_heatmap(
        z=found["correlation"],
        x=names,
        y=names,
        hovertemplate="%{y} as %{x}: %{z:.4f}<extra></extra>",
        **CELLS,
        colorbar={"title": {"text": "correlation"}, "thickness": 12},
    )
    said = [
        ["" if v is None or v < CLOSE else f"{v:.3f}"[1:] if v < 0.9995 else "1" for v in row]
        for row in found["correlation"]
    ]
    numbers(plot, names, names, said, [inks(LIKENESS, row) for row in found["correlation"]], 10)
    plot.update_xaxes(
        title_text="could be taken for this effect", tickangle=-50, automargin=True, showgrid=False
    )
    plot.update_yaxes(
        title_text="this effect", title_standoff=12, autorange="reversed", automargin=True, showgrid=False
    )
    return style(plot, 260 + 26 * len(names), margin={"l": 20, "r": 20, "t": 20, "b": 20})


def numbered(names: Sequence[str], alike: Sequence[Sequence[float]], height: int) -> go.Figure:
    """The same for a narrow place: columns are the numbers of the rows, cells in hundredths, rounded down so that 100
    is for what cannot be told apart at all."""
    rows = [f"{escape(name)}  {k}" for k, name in enumerate(names, 1)]
    plot = go.Figure()
    columns = [str(k) for k in range(1, len(names) + 1)]
    plot.add_heatmap(
        z=alike,
        x=columns,
        y=rows,
        customdata=[[escape(name) for name in names]] * len(names),
        hovertemplate="%{y} as %{customdata}: %{z:.4f}<extra></extra>",
        **CELLS,
        showscale=False,
    )
    said = [
        ["" if j == k or v < CLOSE else str(int(100 * min(v, 1.0) + 1e-6)) for j, v in enumerate(row)]
        for k, row in enumerate(alike)
    ]
    numbers(plot, columns, rows, said, [inks(LIKENESS, row) for row in alike])
    plot.update_xaxes(title_text="could be taken for", showgrid=False, type="category", tickangle=0, dtick=1)
    plot.update_yaxes(autorange="reversed", automargin=True, showgrid=False, type="category", dtick=1)
    return style(plot, height, margin={"l": 10, "r": 10, "t": 4, "b": 40}, font={"size": 11})
