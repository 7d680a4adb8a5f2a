"""The widgets of the studio: what there is on the left, where it fails on the right."""

from __future__ import annotations

from typing import Any

from trame.ui.vuetify3 import VAppLayout
from trame.widgets import client, html, plotly
from trame.widgets import vuetify3 as v3

from pipeline.studio.look import BUTTON, FIELD, STYLE, Actions
from pipeline.studio.panes import right


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
                right(actions, plotter, views)
    return views


def _bar(actions: Actions) -> None:
    with v3.VAppBar(height=52, flat=True, border=True):
        html.H1("parastiff studio", style="font-size: 16px; margin: 0 16px;")
        v3.VCombobox(
            v_model=("folder",),
            items=("campaigns",),
            label="campaign folder",
            **FIELD,
            style="max-width: 380px;",
            id="folder",
        )
        v3.VBtn(
            "Open", click=actions["open"], disabled=("!!busy",), id="open", **{**BUTTON, "classes": "ml-2"}
        )
        v3.VFileInput(
            v_model=("dropped",),
            label="or drop its two files here",
            multiple=True,
            **FIELD,
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
        "Choose the folder of a campaign above, or drop its campaign.toml and measurements.csv.",
        v_if=("!ready && !busy && !complaint",),
    )


def _left(actions: Actions) -> Any:
    with html.Div(v_if=("ready",)):
        html.Div("{{ headline }}", classes="lead", id="headline")
        with html.Div(v_if=("measured",)):
            html.Div("error {{ errors }}", classes="small num mt-1", id="errors")
            figure = plotly.Figure(
                display_mode_bar=False, responsive=True, style="height: 222px; width: 100%;"
            )
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
                **FIELD,
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
    html.H2("What these tests can show")
    v3.VBtn("Plan", click=actions["plan"], disabled=("!!busy",), id="plan", **BUTTON)
    html.H2("What is missing")
    v3.VBtn("Diagnose", click=actions["diagnose"], disabled=("!measured || !!busy",), id="diagnose", **BUTTON)
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
