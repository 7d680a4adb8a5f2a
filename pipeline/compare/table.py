"""A comparison on a terminal: models side by side, tests against channels, and how the model fails, in words."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from pipeline.compare.record import Comparison, ModelError

WIDTH = 100
CHANNELS = 12
"""Columns of channels beside each other; more follow below."""
SENTENCES, LOST, REMARKS = 12, 4, 4
"""Lines of each kind at most."""
HEADS = {"lin": "LIN", "vjm": "VJM", "saved": "saved", "fea": "FEA"}
_UNITS = {"mm": (1e3, "µm"), "rad": (1e6, "µrad"), "N": (1.0, "N"), "Nmm": (1.0, "Nmm")}
"""In which an error is shown, and by how much it is multiplied for that."""
NOISE, CLEAR = 1.5, 3.0
"""Sigmas up to which an error is shown as noise, and from which as a clear misfit."""


def show(result: Comparison, console: Console | None = None) -> None:
    """Print a comparison."""
    (console or screen()).print(page(result))


def screen() -> Console:
    """A terminal of at most `WIDTH` columns; what is no terminal has as many."""
    here = Console(highlight=False)
    return Console(highlight=False, width=min(here.width, WIDTH) if here.is_terminal else WIDTH)


def page(result: Comparison) -> RenderableType:
    """A comparison, at most `WIDTH` columns wide."""
    shown = result.model_of(result.shown)
    parts: list[RenderableType] = [
        Text(
            f"{result.campaign}: {result.tests} tests, {result.rows} load steps, {result.readings} readings to predict"
        ),
        *_lines("remark: ", result.remarks, REMARKS),
        Text(),
        _models(result),
        *_lost(result),
    ]
    if shown.failed is None:
        parts += [Text(), Text(f"{shown.title}: error of each channel, in its sigmas"), *_channels(shown)]
        parts += [Text(), Text(f"How {shown.title} fails in the fitted tests:"), *_failures(shown)]
    return Group(*parts)


def sentence(result: Comparison) -> str:
    """The comparison in one line."""
    shown = result.model_of(result.shown)
    if shown.failed is not None:
        return f"{result.campaign}: {shown.title} has no prediction: {shown.failed}"
    if shown.fit is None:
        return f"{result.campaign}: {shown.title}: not measured yet"
    said = "within the noise" if shown.within_noise else "not within the noise"
    held = "" if shown.holdout is None else f", held-out tests {number(shown.holdout)}"
    return f"{result.campaign}: {shown.title}: {number(shown.fit)} sigma{held}: {said}"


def number(value: float | None) -> str:
    """Three digits, in few characters."""
    if value is None:
        return "-"
    if value >= 1e4:
        return f"{value:.0e}".replace("e+0", "e")
    return f"{value:.2f}" if value < 9.995 else f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


def coloured(value: float | None) -> Text:
    """A number of sigmas: green as noise, yellow, red as a misfit."""
    style = "dim" if value is None else "green" if value <= NOISE else "yellow" if value <= CLEAR else "red"
    return Text(number(value), style=style)


def _models(result: Comparison) -> Table:
    """Whitened RMS of every test by every model."""
    table = _table("error in sigmas, 1 is noise", *(HEADS[m.model] for m in result.models))
    working = next((m for m in result.models if m.tests), None)
    for row in working.tests if working else ():
        name = row.test if row.role == "fit" else f"{row.test} (held out)"
        by_model = [{t.test: t for t in m.tests}.get(row.test) for m in result.models]
        table.add_row(
            _short(name),
            *(
                Text("-") if t is None else coloured(t.rms) + Text("*" if t.lost else "", style="red")
                for t in by_model
            ),
        )
    table.add_section()
    table.add_row("all fitted tests", *(coloured(m.fit) for m in result.models), style="bold")
    table.add_row("all held-out tests", *(coloured(m.holdout) for m in result.models), style="bold")
    table.add_row("as large by noise", *(_probability(m.chi_square_p) for m in result.models))
    table.add_row("as smooth by noise", *(_probability(m.lag_one_p) for m in result.models))
    return table


def _probability(value: float | None) -> str:
    return "-" if value is None else "< 1e-6" if value < 1e-6 else f"{value:.2g}"


def _lost(result: Comparison) -> list[RenderableType]:
    """Rows and models without a prediction."""
    out: list[RenderableType] = []
    for model in result.models:
        head = HEADS[model.model]
        if model.failed is not None:
            out.append(Text(f"{head} has no prediction: {model.failed}"))
        out += _lines(f"* {head}, ", [lost.sentence for lost in model.lost], LOST)
    if any(model.lost for model in result.models):
        out.append(Text("* readings without a prediction count as 30 sigma each"))
    return out


def _channels(model: ModelError) -> Iterable[RenderableType]:
    """Tests against channels, and the channels in their units below."""
    names = list(dict.fromkeys([*model.channels, *model.holdout_channels]))
    for first in range(0, len(names), CHANNELS):
        some = names[first : first + CHANNELS]
        table = _table("", *some)
        for test in model.tests:
            name = test.test if test.role == "fit" else f"{test.test} (held out)"
            errors = [test.channels.get(channel) for channel in some]
            table.add_row(_short(name), *(coloured(None if e is None else e.sigmas) for e in errors))
        table.add_section()
        for title, errors_by in (("fitted", model.channels), ("held out", model.holdout_channels)):
            table.add_row(
                f"{title}, in units",
                *(
                    number(errors_by[c].rms * _UNITS[errors_by[c].unit][0] if c in errors_by else None)
                    for c in some
                ),
            )
        every = model.holdout_channels | model.channels
        table.add_row("unit", *(_UNITS[every[c].unit][1] for c in some), style="dim")
        yield table


def _failures(model: ModelError) -> list[RenderableType]:
    if not model.channels and not model.holdout_channels:
        return [Text("  not measured yet: there is no reading that a model predicts")]
    told = [finding.sentence for finding in model.findings if finding.sentence]
    if told:
        return _lines("  ", told, SENTENCES)
    return [Text("  nothing beyond what noise gives in as many looks")]


def _table(corner: str, *heads: str) -> Table:
    table = Table(box=None, padding=(0, 0, 0, 1), header_style="bold", pad_edge=False)
    table.add_column(corner, no_wrap=True)
    for head in heads:
        table.add_column(Text(head[:8]), justify="right", no_wrap=True, min_width=5)
    return table


def _short(name: str) -> Text:
    """An id as it is: brackets in it are no markup."""
    return Text(name if len(name) <= 28 else name[:25] + "...")


def _lines(start: str, sentences: Iterable[str], most: int) -> list[RenderableType]:
    """The first few sentences, one a line, and how many more there are."""
    every = list(sentences)
    shown = [*every[:most], *([f"... and {len(every) - most} more, see --json"] if len(every) > most else [])]
    return [Text(start + each) for each in shown]
