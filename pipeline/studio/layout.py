"""The frame of the studio: the bar above, and below it the first page or the campaign that is open."""

from __future__ import annotations

from typing import Any

from trame.ui.vuetify3 import VAppLayout
from trame.widgets import client, html
from trame.widgets import vuetify3 as v3

from pipeline.studio.column import left
from pipeline.studio.look import BUTTON, STYLE, Actions
from pipeline.studio.panes import right
from pipeline.studio.start import start

LANGUAGE = """document.documentElement.lang = "en";
document.querySelector("meta[name=viewport]").content = "width=device-width, initial-scale=1";"""
"""The page is English, and may be made larger."""


def build(server: Any, actions: Actions, plotter: Any) -> dict[str, Any]:
    """The page; returns the widgets that are updated."""
    views: dict[str, Any] = {}
    with VAppLayout(server, full_height=True) as layout:
        layout.root.theme = "light"
        client.Style(STYLE)
        client.Script(LANGUAGE)
        _bar(actions)
        with v3.VMain():
            with html.Div(
                classes="start",
                v_if=("screen !== 'work'",),
                tabindex="0",
                role="region",
                raw_attrs=['aria-label="first page"'],
            ):
                messages(actions)
                start(actions)
            with html.Div(raw_attrs=[":class=\"{ work: true, away: screen !== 'work' }\""]):
                with html.Div(
                    classes="left", tabindex="0", role="region", raw_attrs=['aria-label="verdict"']
                ):
                    messages(actions, work=True)
                    left(actions, views)
                with html.Div(
                    classes="right",
                    tabindex="0",
                    role="region",
                    raw_attrs=['aria-label="pictures"'],
                    v_if=("ready",),
                ):
                    right(actions, plotter, views)
    return views


def _bar(actions: Actions) -> None:
    with v3.VAppBar(height=52, flat=True, border=True):
        html.H1("parastiff studio", style="font-size: 16px; margin: 0 16px;")
        v3.VBtn("First page", click=actions["home"], v_if=("screen === 'work'",), id="home", **BUTTON)
        v3.VBtn(
            "Back to {{ campaign }}",
            click=actions["work"],
            v_if=("screen !== 'work' && ready",),
            id="return",
            **BUTTON,
        )
        html.Span("{{ folder_shown }}", classes="small ml-2", v_if=("screen === 'work'",), id="campaign")
        v3.VSpacer()
        html.A(
            "Open the report",
            v_if=("report",),
            href=("report",),
            target="_blank",
            id="report",
            classes="mr-3 small",
        )
        v3.VBtn(
            "Save model",
            click=actions["save"],
            disabled=("!dirty || !!busy",),
            id="save",
            v_if=("screen === 'work'",),
            **BUTTON,
        )
        v3.VBtn(
            "Export report",
            click=actions["export"],
            disabled=("!ready || !!busy",),
            id="export",
            v_if=("screen === 'work'",),
            **{**BUTTON, "classes": "mr-4 mb-1"},
        )


def messages(actions: Actions, work: bool = False) -> None:
    """What went wrong, what was done, what is being done; on the page that is seen."""
    seen = "screen === 'work'" if work else "screen !== 'work'"
    with html.Div(role="alert", v_if=(f"complaint && {seen}",), id="complaint"):
        html.Div("{{ complaint }}", classes="warn", style="white-space: pre-wrap;")
    html.Div("{{ remark }}", v_if=(f"remark && {seen}",), role="status", id="remark", classes="small mb-1")
    if work:
        with html.Div(v_if=("undo && !busy",), classes="small mb-1"):
            html.Div("Written last in campaign.toml: {{ undo }}", v_if=("!remark",))
            v3.VBtn("Take it back", click=actions["undo"], id="undo", **BUTTON)
    with html.Div(v_if=(f"busy && {seen}",), id="busy", classes="mb-2"):
        v3.VProgressLinear(indeterminate=True, color="#005f94", raw_attrs=['aria-label="working"'])
        html.Div("{{ progress }}", role="status", id="progress", classes="small")
        v3.VBtn("Cancel", click=actions["cancel"], id="cancel", **BUTTON)
