"""The right of the studio: where it fails, rivals, the rig and its readings, candidates, what the tests can show."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from trame.widgets import html, plotly
from trame.widgets import vuetify3 as v3
from trame_pyvista.widgets import PyVistaLocalView

from pipeline.studio.look import BUTTON, FIELD, WIDE, Actions
from pipeline.studio.sheets import candidates, laws, plan, rig, rivals
from reports.shading import MISFIT

TABS = (
    ("data", "Measured and predicted", ""),
    ("rivals", "Sets that fit alike", "rivals.length"),
    ("laws", "Laws", ""),
    ("rig", "Rig and readings", ""),
    ("candidates", "Candidates", "candidates.length"),
    ("plan", "What these tests can show", ""),
)
"""Name, title, and when it is there."""


def right(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    """All panes, one of them seen; what is not seen keeps its width, so that its plots keep theirs."""
    with v3.VTabs(v_model=("tab",), density="compact", color="#005f94", height=34, id="tabs"):
        for name, title, there in TABS:
            v3.VTab(title, value=name, id=f"tab_{name}", **({"v_if": (there,)} if there else {}))
    made: dict[str, Callable[[], None]] = {
        "data": lambda: _data(actions, plotter, views),
        "rivals": lambda: rivals(actions, views),
        "laws": lambda: laws(actions),
        "rig": lambda: rig(actions),
        "candidates": candidates,
        "plan": lambda: plan(actions, views),
    }
    for name, make in made.items():
        with html.Div(raw_attrs=[f":class=\"{{ away: tab !== '{name}' }}\""]):
            make()


def _data(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    html.Div(
        "Nothing is measured yet that a model predicts; Plan says what these tests can show.",
        v_if=("!measured",),
        classes="mt-2",
    )
    with html.Div(classes="data"):
        with html.Div(v_if=("measured",), classes="map", raw_attrs=[':style="{ minHeight: map_height }"']):
            html.H2("Where it fails: misfit in sigmas, 1 is noise; a click shows the curve", classes="mt-1")
            with html.Div(classes="fill"):
                views["map"] = plotly.Figure(
                    **WIDE,
                    style="height: 100%; width: 100%;",
                    click=(actions["pick"], "[$event.points[0].customdata]"),
                )
        with html.Div(v_if=("measured",), classes="curve"):
            with html.Div(classes="row"):
                v3.VSelect(v_model=("test",), items=("tests",), label="test", id="test", **FIELD)
                v3.VSelect(v_model=("channel",), items=("channels",), label="channel", id="channel", **FIELD)
            with html.Div(classes="fill"):
                views["curve"] = plotly.Figure(**WIDE, style="height: 100%; width: 100%;")
        with html.Div(classes="scene"):
            _scene(actions, plotter, views)


def _scene(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    with html.Div(classes="view", id="scene"):
        views["scene"] = PyVistaLocalView(plotter)
    v3.VSlider(
        v_model=("step",),
        min=0,
        max=("steps",),
        step=1,
        density="compact",
        hide_details=True,
        label="step",
        color="#005f94",
        style="flex: 0 0 auto;",
        id="step",
        raw_attrs=['aria-label="load step"'],
    )
    html.Div("{{ seen }}", classes="small", id="seen")
    v3.VBtn(
        "Set this reading of {{ channel }} aside",
        v_if=("measured && channel",),
        click=actions["aside"],
        disabled=("!!busy",),
        id="aside",
        style="align-self: flex-start;",
        **BUTTON,
    )
    stops = ", ".join(f"{shade} {100 * place:.0f}%" for place, shade in MISFIT)
    with html.Div(classes="small row"):
        html.Span("1")
        html.Div(classes="shade", style=f"background: linear-gradient(90deg, {stops});")
        html.Span("1000 sigma; thin: predicted, grey: unloaded")
