"""The left of the studio: the verdict, what is certain, what to do next, and the model."""

from __future__ import annotations

from typing import Any

from trame.widgets import html
from trame.widgets import vuetify3 as v3

from pipeline.studio.look import BUTTON, FIELD, MAIN, Actions


def left(actions: Actions, views: dict[str, Any]) -> None:
    """From what matters most downwards."""
    with html.Div(v_if=("ready",)):
        html.Div("{{ mistake }}", v_for="mistake in mistakes", classes="warn", key="mistake")
        _mends(actions)
        html.Div("{{ headline }}", classes="lead", id="headline")
        html.Div("{{ standing }}", v_if=("standing",), classes="small mt-1", id="standing")
        _buttons(actions)
        html.Div(v_html=("bars",), v_if=("measured",), id="bars")
        with html.Div(v_if=("certain.length",), id="certain"):
            html.H2("What is certain")
            with html.Ul(classes="small"):
                html.Li("{{ said }}", v_for="said in certain")
        with html.Div(v_if=("next.length",), id="next"):
            html.H2("Next step")
            html.P("{{ said }}", v_for="said in next", classes="small")
        _model(actions)
        with html.Div(v_if=("nearest.length",), id="nearest"):
            html.H2("Looked at, and not chosen")
            with html.Div(v_for="it in nearest", key="it.name", classes="small mb-1"):
                html.Span("{{ it.title }}")
                html.Code("{{ it.name }}")
                html.Div("{{ it.why }}", classes="ml-3")
        with html.Details(v_if=("sentences.length",), id="why"):
            html.Summary("Why")
            html.P("{{ said }}", v_for="said in sentences", classes="small")


def _mends(actions: Actions) -> None:
    """The lines of campaign.toml that mend what the doctor found, each with its button."""
    with html.Div(v_for="(it, k) in mends", key="it.words", classes="warn"):
        html.Div("If {{ it.words }}, campaign.toml may say so:", classes="small")
        html.Div("{{ line }}", v_for="line in it.lines", classes="small code")
        v3.VBtn(
            "Write it",
            click=(actions["mend"], "[k]"),
            disabled=("!!busy",),
            raw_attrs=[":aria-label=\"'Write it: ' + it.words\""],
            **BUTTON,
        )


def _buttons(actions: Actions) -> None:
    with html.Div(classes="mt-2 mb-1"):
        v3.VBtn(
            "Diagnose",
            v_if=("!proposals",),
            click=actions["diagnose"],
            disabled=("!measured || !!busy",),
            id="diagnose",
            **MAIN,
        )
        v3.VBtn(
            "Accept this model",
            v_if=("proposed && !ambiguous",),
            click=actions["accept"],
            disabled=("!!busy",),
            id="accept",
            **MAIN,
        )
        v3.VBtn("Compare the sets", v_if=("ambiguous",), click="tab = 'rivals'", id="compare_sets", **MAIN)
        v3.VBtn("Back to the model before", v_if=("proposed",), click=actions["back"], id="back", **BUTTON)
        v3.VBtn(
            "Show what was found",
            v_if=("proposals && !proposed",),
            click=(actions["choose"], "[0]"),
            id="found",
            **BUTTON,
        )
        v3.VBtn(
            "Diagnose again",
            v_if=("proposals && !proposed",),
            click=actions["diagnose"],
            disabled=("!!busy",),
            id="again",
            **BUTTON,
        )
        v3.VBtn(
            "Look for laws",
            v_if=("look_for_laws",),
            click=actions["discover"],
            disabled=("!!busy",),
            id="laws_next",
            **BUTTON,
        )
        v3.VBtn("Plan", click=actions["plan"], disabled=("!!busy",), id="plan", **BUTTON)


def _model(actions: Actions) -> None:
    html.H2("{{ proposed ? 'The proposed model' : 'The model' }}")
    html.Div("plain virtual springs{{ effects.length ? ', and' : '' }}", classes="small")
    with html.Div(v_for="effect in effects", key="effect.name", classes="mb-1"):
        html.Span("{{ effect.title }}", classes="mr-1")
        html.Code("{{ effect.name }}", classes="mr-2")
        v3.VBtn(
            "Remove",
            v_if=("!proposed",),
            click=(actions["remove"], "[effect.name]"),
            disabled=("!!busy",),
            raw_attrs=[":aria-label=\"'Remove ' + effect.name\""],
            **BUTTON,
        )
        html.Div("{{ value }}", v_for="value in effect.values", classes="small ml-3")
    with html.Div(v_if=("!proposed",), classes="row mt-1"):
        v3.VAutocomplete(v_model=("chosen",), items=("addable",), label="add an effect", id="effect", **FIELD)
        v3.VBtn(
            "Add", click=(actions["add"], "[[chosen]]"), disabled=("!chosen || !!busy",), id="add", **BUTTON
        )
