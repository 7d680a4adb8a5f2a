"""The right of the studio: where it fails, and what the tests can show."""

from __future__ import annotations

from typing import Any

from trame.widgets import html, plotly
from trame.widgets import vuetify3 as v3
from trame_pyvista.widgets import PyVistaLocalView

from pipeline.studio.look import FIELD, Actions

WIDE: dict[str, Any] = {"display_mode_bar": False, "responsive": True}
SIZES = (
    ("effect, parameter", "name", ""),
    ("typical", "typical", "n"),
    ("detected", "detected", "n"),
    ("told apart", "apart", "n"),
    ("unit", "unit", ""),
    ("hardest rival", "rival", ""),
    ("\u03c1", "rho", "n"),
)
"""Columns of the table of sizes: title, key, class."""
WEAK = {"detected": "it.hidden", "apart": "it.alike"}


def right(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    """Both panes, one of them seen; what is not seen keeps its width, so that its plots keep theirs."""
    with v3.VTabs(v_model=("tab",), density="compact", color="#0072B2", height=30, id="tabs"):
        v3.VTab("Measured and predicted", value="data", id="tab_data")
        v3.VTab("What these tests can show", value="plan", id="tab_plan")
    with html.Div(raw_attrs=[":class=\"{ away: tab !== 'data' }\""]):
        html.Div(
            "Nothing is measured yet that a model predicts; Plan says what these tests can show.",
            v_if=("!measured",),
            classes="mt-2",
        )
        _data(actions, plotter, views)
    with html.Div(raw_attrs=[":class=\"{ away: tab !== 'plan' }\""]):
        _plan(views)


def _data(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    with html.Div(style="display: flex; gap: 8px;"):
        with html.Div(style="flex: 1 1 58%; min-width: 0;", v_if=("measured",)):
            html.H2("Where it fails: misfit in sigmas; a click shows the curve", classes="mt-1")
            views["map"] = plotly.Figure(
                **WIDE,
                style="height: 290px; width: 100%;",
                click=(actions["pick"], "[$event.points[0].customdata]"),
            )
        with html.Div(style="flex: 1 1 42%; min-width: 0;"):
            _scene(plotter, views)
    with html.Div(style="display: flex; gap: 8px; align-items: center; max-width: 560px;", classes="mt-2"):
        v3.VSelect(v_model=("test",), items=("tests",), label="test", id="test", **FIELD)
        v3.VSelect(
            v_model=("channel",),
            items=("channels",),
            label="channel",
            id="channel",
            v_if=("measured",),
            **FIELD,
        )
    with html.Div(v_if=("measured",)):
        views["curve"] = plotly.Figure(**WIDE, style="height: 330px; width: 100%;")


def _scene(plotter: Any, views: dict[str, Any]) -> None:
    html.H2("The linkage", classes="mt-1")
    with html.Div(style="height: 200px; border: 1px solid #d9dee3;", id="scene"):
        views["scene"] = PyVistaLocalView(plotter)
    v3.VSlider(
        v_model=("step",),
        min=0,
        max=("steps",),
        step=1,
        density="compact",
        hide_details=True,
        label="step",
        color="#0072B2",
        id="step",
    )
    html.Div("{{ seen }}", classes="small", id="seen")
    with html.Div(classes="small", style="display: flex; gap: 8px; align-items: center;"):
        html.Span("1")
        html.Div(classes="shade")
        html.Span("100 sigma; grey: unloaded")


def _plan(views: dict[str, Any]) -> None:
    html.Div(
        "Plan looks at which effects these tests can show and tell apart, measured or not, and which test comes next.",
        v_if=("!planned",),
        classes="mt-2",
    )
    with html.Div(v_if=("planned",), id="planned"):
        with html.Div(classes="lead mt-2", id="next_test"):
            html.Div("{{ said }}", v_for="said in following")
        html.Div("{{ about }}", classes="small mt-1", id="about")
        html.Div("{{ said }}", v_for="said in apart_from", classes="small")
        html.H2(
            "Isolability: correlation of an effect (row) with the best of another (column), in hundredths"
        )
        views["alike"] = plotly.Figure(**WIDE, style="height: 400px; width: 100%;")
        html.H2("Smallest sizes that these tests show, from null")
        _sizes()


def _sizes() -> None:
    html.Div(
        "detected in 90 % of cases, told from the rival in 95 %; bold with !: a typical size is not enough",
        classes="small",
    )
    with html.Table(classes="sizes", id="sizes"):
        with html.Thead(), html.Tr():
            for title, _, kind in SIZES:
                html.Th(title, classes=kind)
        with html.Tbody(), html.Tr(v_for="it in sizes", key="it.effect + it.name"):
            with html.Td():
                html.B("{{ it.effect }}", v_if=("it.first",))
                html.Div("{{ it.name }}", classes="ml-3")
            for _, key, kind in SIZES[1:]:
                weak = f':class="{{ weak: {WEAK[key]} }}"' if key in WEAK else ""
                html.Td(f"{{{{ it.{key} }}}}", classes=kind, raw_attrs=[weak] if weak else [])
