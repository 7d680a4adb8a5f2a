"""The second step of a table: what each column is, what the rig is, and the first rows in N and mm."""

from __future__ import annotations

from trame.widgets import html
from trame.widgets import vuetify3 as v3

from pipeline.studio.look import BUTTON, MAIN, Actions

PUSH = "@change=\"flushState('table')\""


def importing(actions: Actions) -> None:
    """Seen once a table was looked at."""
    with html.Div(v_if=("table",), id="importing"):
        html.H2("{{ table.file }}: what its columns are", classes="mt-6")
        _columns()
        html.H2("The rig")
        _rig(actions)
        html.H2("The tests: what was prescribed")
        _tests()
        with html.Div(classes="row mt-3"):
            v3.VBtn(
                "Read it in N and mm", click=actions["preview"], disabled=("!!busy",), id="preview", **MAIN
            )
            v3.VBtn("Not this table", click=actions["drop_table"], id="drop_table", **BUTTON)
        with html.Div(v_if=("preview.rows.length",), id="previewed"):
            html.H2("As it is read: check axes, signs and sizes")
            html.P("{{ said }}", v_for="said in preview.said", classes="small")
            with html.Table(classes="grid"):
                with html.Thead(), html.Tr():
                    html.Th("{{ head }}", v_for="head in preview.head", classes="n")
                with html.Tbody(), html.Tr(v_for="row in preview.rows"):
                    html.Td("{{ cell }}", v_for="cell in row", classes="n")
            with html.Div(classes="row mt-3"):
                v3.VBtn("Make it a campaign", click=actions["make"], disabled=("!!busy",), id="make", **MAIN)


def _columns() -> None:
    with html.Table(classes="grid", id="columns"):
        with html.Thead(), html.Tr():
            for head in ("column", "first values", "what it is", "sign", "unit"):
                html.Th(head)
        with html.Tbody(), html.Tr(v_for="row in table.columns", key="row.name"):
            html.Td("{{ row.name }}")
            html.Td("{{ row.values }}", classes="small")
            with html.Td():
                _select("row.what", "row.choices", "'what ' + row.name + ' is'", shown="row.words[it] || it")
            with html.Td():
                _select("row.sign", "['+', '−']", "'sign of ' + row.name")
            with html.Td():
                html.Input(raw_attrs=['v-model="row.unit"', PUSH, ":aria-label=\"'unit of ' + row.name\""])


def _rig(actions: Actions) -> None:
    with html.Div(classes="row small"):
        html.Span("kind")
        _select(
            "table.kind",
            "table.kinds",
            "'kind of rig'",
            change=actions["kind"],
            shown="it",
            identifier="kind",
        )
    with html.Table(classes="grid", id="rig"), html.Tbody(), html.Tr(v_for="row in table.rig", key="row.key"):
        html.Td("{{ row.words }}")
        with html.Td():
            html.Input(raw_attrs=['v-model="row.value"', PUSH, ':aria-label="row.words"'])
        with html.Td():
            html.Code("{{ row.key }}")


def _tests() -> None:
    with html.Table(classes="grid", id="runs"):
        with html.Thead(), html.Tr():
            html.Th("test")
            html.Th("angle of the bars, degrees", v_if=("table.posture",))
            html.Th("use")
            html.Th("{{ name }}", v_for="name in table.coordinates")
        with html.Tbody(), html.Tr(v_for="row in table.tests", key="row.name"):
            html.Td("{{ row.name }}")
            with html.Td(v_if=("table.posture",)):
                html.Input(
                    raw_attrs=['v-model="row.posture"', PUSH, ":aria-label=\"'angle of ' + row.name\""]
                )
            with html.Td():
                _select(
                    "row.role",
                    "['fit', 'holdout']",
                    "'use of ' + row.name",
                    shown="{fit: 'fit', holdout: 'hold out'}[it]",
                )
            with html.Td(v_for="name in table.coordinates"):
                _select(
                    "row.control[name]",
                    "['force', 'displacement', 'held']",
                    "name + ' of ' + row.name",
                    shown="{force: 'loaded or free', displacement: 'moved or held', held: 'held, not read'}[it]",
                )


def _select(
    model: str, items: str, label: str, shown: str = "it", change: object = None, identifier: str = ""
) -> None:
    """A list of the page's own kind: it is read aloud and worked by keys as any other."""
    more = {"change": change} if change is not None else {}
    attributes = [f'v-model="{model}"', f':aria-label="{label}"', *([] if more else [PUSH])]
    with html.Select(
        raw_attrs=attributes, classes="plain", **({"id": identifier} if identifier else {}), **more
    ):
        html.Option(f"{{{{ {shown} }}}}", v_for=f"it in {items}", value=("it",))
