"""The widgets of the studio: what there is on the left, where it fails on the right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from trame.ui.vuetify3 import VAppLayout
from trame.widgets import client, html, plotly
from trame.widgets import vuetify3 as v3
from trame_pyvista.widgets import PyVistaLocalView

Actions = Mapping[str, Callable[..., Any]]
STYLE = """
html { overflow-y: auto; } .v-application { font-size: 14px; }
.lead { border-left: 4px solid #0072B2; padding-left: 8px; font-weight: 600; line-height: 1.3; }
.cand td, .cand th { padding: 2px 6px 2px 0; text-align: left; vertical-align: top; font-size: 12.5px; }
.num { font-variant-numeric: tabular-nums; white-space: nowrap; }
:focus-visible { outline: 3px solid #E69F00 !important; outline-offset: 1px; }
.shade { height: 9px; width: 150px; background: linear-gradient(90deg, #fee838, #a69d75, #575d6d, #00224e); }
.small, .v-slider .v-label, .v-field__input, .v-label.v-field-label { font-size: 12.5px !important; }
.small { font-size: 12.5px; color: #3d4852; }
h2 { font-size: 14px; line-height: 1.3; margin: 12px 0 4px; }
p { margin: 0 0 4px; }
.value { font-size: 12.5px; }
"""
BUTTON: dict[str, Any] = {
    "density": "compact",
    "variant": "outlined",
    "size": "small",
    "classes": "mr-1 mb-1",
}


def build(server: Any, actions: Actions, plotter: Any) -> dict[str, Any]:
    """The page; returns the widgets that are updated."""
    views: dict[str, Any] = {}
    with VAppLayout(server, full_height=True) as layout:
        layout.root.theme = "light"
        client.Style(STYLE)
        _bar(actions)
        with v3.VMain(), html.Div(style="display: flex; height: calc(100vh - 53px);"):
            with html.Div(
                style="width: 420px; overflow-y: auto; padding: 8px 12px; border-right: 1px solid #d9dee3;"
            ):
                _messages(actions)
                views["waterfall"] = _left(actions)
            with html.Div(
                style="flex: 1; min-width: 0; padding: 6px 10px; overflow-y: auto;", v_if=("ready",)
            ):
                _right(actions, plotter, views)
    return views


def _bar(actions: Actions) -> None:
    with v3.VAppBar(height=52, flat=True, border=True):
        html.H1("parastiff studio", style="font-size: 16px; margin: 0 16px;")
        v3.VCombobox(
            v_model=("folder",),
            items=("campaigns",),
            label="campaign folder",
            density="compact",
            hide_details=True,
            variant="outlined",
            style="max-width: 380px;",
            id="folder",
        )
        v3.VBtn(
            "Open", click=actions["open"], disabled=("!!busy",), id="open", **{**BUTTON, "classes": "ml-2"}
        )
        v3.VFileInput(
            v_model=("dropped",),
            label="or drop campaign.toml and measurements.csv",
            multiple=True,
            density="compact",
            hide_details=True,
            variant="outlined",
            prepend_icon="",
            style="max-width: 350px; margin-left: 12px;",
            id="drop",
        )
        v3.VSpacer()
        v3.VBtn("Save model", click=actions["save"], disabled=("!dirty || !!busy",), id="save", **BUTTON)
        v3.VBtn(
            "Export report", click=actions["export"], disabled=("!ready || !!busy",), id="export", **BUTTON
        )


def _messages(actions: Actions) -> None:
    with html.Div(role="alert", v_if=("complaint",), id="complaint"):
        v3.VAlert(
            "{{ complaint }}",
            type="error",
            density="compact",
            variant="tonal",
            icon=False,
            style="white-space: pre-wrap;",
        )
    html.Div("{{ remark }}", v_if=("remark",), role="status", id="remark", classes="small mb-1")
    with html.Div(v_if=("busy",), id="busy"):
        v3.VProgressLinear(indeterminate=True, color="#0072B2")
        html.Div("{{ progress }}", role="status", id="progress", classes="small")
        v3.VBtn("Cancel", click=actions["cancel"], id="cancel", **BUTTON)
    html.Div(
        "Choose the folder of a campaign above, or drop its two files.",
        v_if=("!ready && !busy && !complaint",),
    )


def _left(actions: Actions) -> Any:
    with html.Div(v_if=("ready",)):
        html.Div("{{ headline }}", classes="lead", id="headline")
        html.Div("error {{ errors }}", classes="small num mt-1", id="errors")
        figure = plotly.Figure(display_mode_bar=False, responsive=True, style="height: 210px; width: 100%;")
        html.H2("Model")
        html.Div("plain virtual springs", classes="small")
        with html.Div(v_for="effect in effects", key="effect.name", classes="mb-1"):
            html.Span("+ {{ effect.name }}", classes="mr-2")
            v3.VBtn(
                "Remove",
                click=(actions["remove"], "[effect.name]"),
                disabled=("!!busy",),
                raw_attrs=[":aria-label=\"'Remove ' + effect.name\""],
                **BUTTON,
            )
            html.Div("{{ value }}", v_for="value in effect.values", classes="small value num ml-4")
        with html.Div(style="display: flex; gap: 6px; align-items: center;"):
            v3.VAutocomplete(
                v_model=("chosen",),
                items=("addable",),
                label="effect",
                density="compact",
                hide_details=True,
                variant="outlined",
                id="effect",
            )
            v3.VBtn(
                "Add",
                click=(actions["add"], "[[chosen]]"),
                disabled=("!chosen || !!busy",),
                id="add",
                **BUTTON,
            )
        _candidates(actions)
    return figure


def _candidates(actions: Actions) -> None:
    html.H2("What is missing")
    v3.VBtn("Diagnose", click=actions["diagnose"], disabled=("!!busy",), id="diagnose", **BUTTON)
    v3.VBtn(
        "Add what is named",
        v_if=("named.length",),
        click=(actions["add"], "[named]"),
        disabled=("!!busy",),
        id="add_named",
        **BUTTON,
    )
    with html.Div(v_if=("sentences.length",), id="verdict"):
        html.P("{{ said }}", v_for="said in sentences", classes="small mb-1")
    with html.Table(v_if=("candidates.length",), classes="cand", id="candidates"):
        with html.Thead(), html.Tr():
            for head in ("effect, why", "sigma left", "BIC behind", ""):
                html.Th(head)
        with html.Tbody(), html.Tr(v_for="it in candidates", key="it.name"):
            with html.Td():
                html.B("{{ it.name }}")
                html.Div("{{ it.why }}")
            html.Td("{{ it.left }}", classes="num")
            html.Td("{{ it.behind }}", classes="num")
            with html.Td():
                v3.VBtn(
                    "Add",
                    v_if=("!it.there",),
                    click=(actions["add"], "[[it.name]]"),
                    disabled=("!!busy",),
                    raw_attrs=[":aria-label=\"'Add ' + it.name\""],
                    **BUTTON,
                )


def _right(actions: Actions, plotter: Any, views: dict[str, Any]) -> None:
    with html.Div(style="display: flex; gap: 8px;"):
        with html.Div(style="flex: 1 1 58%; min-width: 0;"):
            html.H2("Where it fails: misfit in sigmas; a click shows the curve", classes="mt-0")
            views["map"] = plotly.Figure(
                display_mode_bar=False,
                responsive=True,
                style="height: 304px; width: 100%;",
                click=(actions["pick"], "[$event.points[0].customdata]"),
            )
        with html.Div(style="flex: 1 1 42%; min-width: 0;"):
            html.H2("The linkage", classes="mt-0")
            with html.Div(style="height: 216px; border: 1px solid #d9dee3;", id="scene"):
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
            html.Div("{{ seen }}", classes="small num", id="seen")
            with html.Div(classes="small", style="display: flex; gap: 8px; align-items: center;"):
                html.Span("1")
                html.Div(classes="shade")
                html.Span("100 sigma; grey: unloaded")
    with html.Div(style="display: flex; gap: 8px; align-items: center; max-width: 560px;", classes="mt-1"):
        for name, items, label in (("test", "tests", "test"), ("channel", "channels", "channel")):
            v3.VSelect(
                v_model=(name,),
                items=(items,),
                label=label,
                density="compact",
                hide_details=True,
                variant="outlined",
                id=name,
            )
    views["curve"] = plotly.Figure(
        display_mode_bar=False, responsive=True, style="height: 364px; width: 100%;"
    )
