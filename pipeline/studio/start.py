"""The first page: an example, a campaign that is there, or a table that is to become one."""

from __future__ import annotations

from trame.widgets import html
from trame.widgets import vuetify3 as v3

from pipeline.studio.importing import importing
from pipeline.studio.look import BUTTON, FIELD, MAIN, Actions


def start(actions: Actions) -> None:
    """Three ways in, and what was open lately; the second step of a table stands below."""
    html.P(
        "Which effect is missing in a stiffness model of this linkage? Begin with readings.",
        classes="lead mb-4",
    )
    with html.Div(classes="cards"):
        with html.Div(classes="card"):
            html.H2("See how it works")
            html.Div(
                "A bench of two bars and four hinges, 19 tests, 456 load steps. It is opened and what is missing in "
                "its model is looked for, in some twenty seconds.",
                classes="push",
            )
            v3.VBtn("Open the example", click=actions["example"], disabled=("!!busy",), id="example", **MAIN)
        with html.Div(classes="card"):
            html.H2("Read my table")
            html.Div(
                "Text, Excel or TDMS, one row for each load step. You say what each column is and check it in N and mm "
                "before it becomes a campaign.",
                classes="push",
            )
            v3.VFileInput(
                v_model=("table_file",),
                label="drop a table here, or choose it",
                prepend_icon="",
                disabled=("!!busy",),
                id="table",
                **FIELD,
            )
        with html.Div(classes="card"):
            html.H2("Open a campaign")
            html.Div("A folder with campaign.toml and its readings.", classes="push")
            with html.Div(classes="row"):
                v3.VCombobox(
                    v_model=("folder",),
                    items=("campaigns",),
                    label="folder",
                    __events=[("keydown_enter", "keydown.enter")],
                    keydown_enter=(actions["enter"], "[$event.target.value]"),
                    id="folder",
                    **FIELD,
                )
                v3.VBtn("Open", click=actions["open"], disabled=("!!busy",), id="open", **MAIN)
            v3.VFileInput(
                v_model=("dropped",),
                label="or drop its two files here",
                multiple=True,
                prepend_icon="",
                disabled=("!!busy",),
                id="drop",
                **FIELD,
            )
    with html.Div(v_if=("recent.length && !table",), id="recent"):
        html.H2("Opened lately", classes="mt-6")
        with html.Div(v_for="it in recent", key="it"):
            v3.VBtn("{{ it }}", click=(actions["enter"], "[it]"), disabled=("!!busy",), **BUTTON)
    importing(actions)
