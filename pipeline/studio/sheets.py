"""Panes of the studio that are tables: rivals, the rig and its readings, candidates, what the tests can show."""

from __future__ import annotations

from typing import Any

from trame.widgets import html, plotly
from trame.widgets import vuetify3 as v3

from pipeline.studio.look import BUTTON, MAIN, WIDE, Actions

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


def rivals(actions: Actions, views: dict[str, Any]) -> None:
    """Sets that fit alike, with numbers and curves; each has its own button, none comes first."""
    html.P(
        "Each of these explains the readings. Only another test tells them apart; a set may be taken all the same.",
        classes="mt-2",
    )
    with (
        html.Div(classes="rivals", id="rivals"),
        html.Div(
            v_for="(it, k) in rivals",
            key="k",
            raw_attrs=[':class="{ rival: true, seen: k === choice }"'],
        ),
    ):
        html.H3("{{ it.title }}")
        html.Code("{{ it.code }}")
        html.P("{{ it.fit }}", classes="small num")
        html.P("{{ value }}", v_for="value in it.values", classes="small")
        with html.Div(v_if=("it.open",)):
            v3.VBtn(
                "Show in the pictures",
                click=(actions["choose"], "[k]"),
                disabled=("!!busy",),
                raw_attrs=[":aria-label=\"'Show ' + it.title\""],
                **BUTTON,
            )
            v3.VBtn(
                "Take this set",
                click=(actions["take"], "[k]"),
                disabled=("!!busy",),
                raw_attrs=[":aria-label=\"'Take ' + it.title\""],
                **BUTTON,
            )
    html.H2("{{ test }}, {{ channel }}: beside what was measured")
    views["rivals"] = plotly.Figure(**WIDE, style="height: 440px; width: 100%;")


def rig(actions: Actions) -> None:
    """What was written about the rig, what the doctor says, and readings that were set aside."""
    with html.Div(v_if=("mistakes.length",)):
        html.H2("The table seems to have a mistake")
        html.Div("{{ said }}", v_for="said in mistakes", classes="warn")
    html.H2("What was written about the rig, and by how much it may be off")
    with html.Table(classes="grid", id="tolerances"):
        with html.Thead(), html.Tr():
            for head in (
                "what",
                "one standard deviation",
                "unit",
                "found beside the nominal value",
                "pull, sigma",
            ):
                html.Th(head)
        with html.Tbody(), html.Tr(v_for="row in tolerances", key="row.key"):
            with html.Td():
                html.Span("{{ row.words }} ")
                html.Code("{{ row.key }}")
            with html.Td():
                html.Input(
                    raw_attrs=[
                        'v-model="row.value"',
                        "@change=\"flushState('tolerances')\"",
                        ":aria-label=\"'tolerance of ' + row.words\"",
                    ]
                )
            html.Td("{{ row.unit }}")
            html.Td("{{ row.found }}", classes="num")
            html.Td("{{ row.pull }}", classes="num")
    html.P(
        '"exact" where nothing is off. campaign.toml is written by Save tolerances alone.',
        classes="small mt-1",
    )
    v3.VBtn(
        "Use for the next diagnosis", click=actions["tolerate"], disabled=("!!busy",), id="tolerate", **MAIN
    )
    v3.VBtn(
        "Save tolerances",
        click=actions["save_tolerances"],
        disabled=("!edited || !!busy",),
        id="save_tolerances",
        **BUTTON,
    )
    _readings(actions)
    html.H2("Noise of the sensors, one standard deviation")
    with html.Table(classes="grid", id="sigmas"):
        with html.Thead(), html.Tr():
            for head in ("channel", "sigma", "unit", "where from"):
                html.Th(head)
        with html.Tbody(), html.Tr(v_for="row in sigmas"):
            html.Td("{{ cell }}", v_for="cell in row")


def _readings(actions: Actions) -> None:
    """Those that do not count, or are kept by hand, each with the way back."""
    html.H2("Readings that were set aside, or are kept by hand")
    html.P("None.", v_if=("!set_aside.length",), classes="small")
    with html.Table(v_if=("set_aside.length",), classes="grid", id="set_aside"):
        with html.Thead(), html.Tr():
            for head in ("test", "step", "column", "why", ""):
                html.Th(head)
        with html.Tbody(), html.Tr(v_for="row in set_aside"):
            for key in ("test", "step", "column", "said"):
                html.Td(f"{{{{ row.{key} }}}}")
            with html.Td():
                v3.VBtn(
                    "{{ row.button }}",
                    click=(actions["count"], "[row.test, row.step, row.column, row.counts]"),
                    disabled=("!!busy",),
                    raw_attrs=[
                        ":aria-label=\"row.button + ': ' + row.column + ' of ' + row.test + ', step ' + row.step\""
                    ],
                    **BUTTON,
                )
    html.P(
        "Another is set aside below the picture of its load step. Both are written in campaign.toml, under its test.",
        classes="small mt-1",
    )


def laws(actions: Actions) -> None:
    """What was found beyond the catalogue: where, by which law, and the picture of it; and the way into the model."""
    html.P(
        "Every place of the linkage is asked whether one function there, shared by all tests, explains what is left. "
        "What is found is a law at a place, whatever its effect is called.",
        classes="mt-2",
    )
    with html.Div(classes="row"):
        v3.VBtn(
            "Look for laws",
            click=actions["discover"],
            disabled=("!measured || !!busy",),
            id="discover",
            **MAIN,
        )
        v3.VBtn(
            "Write laws.py and add them",
            v_if=("laws_add",),
            click=actions["add_laws"],
            disabled=("!!busy",),
            id="add_laws",
            **MAIN,
        )
    html.P(
        "An effect file is written beside campaign.toml, and added with a fit of all numbers: {{ laws_names }}",
        v_if=("laws_add",),
        classes="small mt-1",
    )
    with html.Div(v_if=("laws_looked",), id="laws_said"):
        html.P("{{ laws_about }}", classes="small mt-1")
        html.P("{{ said }}", v_for="said in laws_said")
    with html.Div(v_if=("laws.length",), id="laws"):
        _law()


def _law() -> None:
    """Beside its picture what is said of it."""
    with html.Div(v_for="(law, k) in laws", key="k", classes="rival law"):
        with html.Div():
            html.H3("{{ law.title }}")
            html.P("{{ said }}", v_for="said in law.said", classes="small")
            html.P("{{ law.left }}", v_if=("law.left",), classes="small")
        html.Img(
            v_if=("law.picture",),
            src=("law.picture",),
            raw_attrs=[":alt=\"'law at ' + law.title\""],
            style="max-width: 100%;",
        )


def candidates() -> None:
    """Every effect that was looked at, the best first."""
    with html.Table(classes="grid mt-2", id="candidates"):
        with html.Thead(), html.Tr():
            for head, kind in (("effect", ""), ("sigma left", "n"), ("BIC behind", "n"), ("why", "")):
                html.Th(head, classes=kind)
        with html.Tbody(), html.Tr(v_for="it in candidates", key="it.name"):
            with html.Td():
                html.Span("{{ it.chosen ? '✓ ' : '' }}{{ it.title }} ")
                html.Code("{{ it.name }}")
            html.Td("{{ it.left }}", classes="n")
            html.Td("{{ it.behind }}", classes="n")
            html.Td("{{ it.why }}")


def plan(actions: Actions, views: dict[str, Any]) -> None:
    """Which effects these tests can show and tell apart."""
    with html.Div(v_if=("!planned",), classes="mt-2"):
        html.P(
            "Plan looks at which effects these tests can show and tell apart, "
            "measured or not, and which test comes next."
        )
        v3.VBtn("Plan", click=actions["plan"], disabled=("!!busy",), id="plan_here", **MAIN)
    with html.Div(v_if=("planned",), id="planned"):
        with html.Div(classes="lead mt-2", id="next_test"):
            html.Div("{{ said }}", v_for="said in following")
        html.Div("{{ about }}", classes="small mt-1", id="about")
        html.Div("{{ said }}", v_for="said in apart_from", classes="small")
        html.H2("Which effect could be taken for which: correlation, in hundredths")
        views["alike"] = plotly.Figure(**WIDE, style="height: 400px; width: 100%;")
        html.H2("Smallest sizes that these tests show")
        _sizes()


def _sizes() -> None:
    html.Div(
        "detected in 90 % of cases, told from the rival in 95 %; bold with !: a typical size is not enough",
        classes="small",
    )
    with html.Table(classes="grid", id="sizes"):
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
