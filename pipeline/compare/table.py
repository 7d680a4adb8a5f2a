"""A comparison on a terminal: models side by side, tests against channels, and how the model fails, in words."""

from __future__ import annotations

from collections.abc import Iterable

from rich.cells import cell_len
from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from pipeline.compare.record import ChannelError, Comparison, ModelError
from pipeline.diagnose.doctor_words import doctor_sentence, mends
from pipeline.terminal import WIDTH, blocks, cell, terminal
from reports.quantities import NONE, number, p_value, sigma

NAME, HEAD = 30, 10
"""Cells of a test's and of a channel's name; longer ones go on below."""
SENTENCES, LOST, REMARKS = 12, 4, 4
"""Lines of each kind at most."""
HEADS = {"lin": "LIN", "vjm": "VJM", "saved": "saved", "fea": "FEA"}
_UNITS = {"mm": (1e3, "µm"), "rad": (1e6, "µrad"), "N": (1.0, "N"), "Nmm": (1.0, "Nmm")}
"""In which an error is shown, and by how much it is multiplied for that."""
NOISE, CLEAR = 1.5, 3.0
"""Sigmas up to which an error is shown as noise, and from which as a clear misfit."""


def show(result: Comparison, console: Console | None = None) -> None:
    """Print a comparison."""
    out = terminal(console)
    out.print(page(result, out.width))


def page(result: Comparison, width: int = WIDTH) -> RenderableType:
    """A comparison, so many columns wide; channels that do not fit beside the others follow below."""
    shown = result.model_of(result.shown)
    parts: list[RenderableType] = [
        Text(sentence(result)),
        *(Text(said) for said in mends(result.doctor)),
        *_lines("", shown.in_units, SENTENCES),
        Text(
            f"{result.campaign}: {result.tests} tests, {result.rows} load steps, {result.readings} readings to predict"
        ),
        *_lines("remark: ", result.remarks, REMARKS),
        Text(),
        _models(result),
        *_lost(result),
    ]
    if shown.failed is None:
        parts += [
            Text(),
            Text(f"{shown.title}: error of each channel, in its sigmas"),
            *_channels(shown, width),
        ]
        parts += [Text(), Text(f"How {shown.title} fails in the fitted tests:"), *_failures(shown)]
    return Group(*parts)


def sentence(result: Comparison) -> str:
    """The comparison in one line."""
    shown = result.model_of(result.shown)
    if shown.failed is not None:
        return f"{result.campaign}: {shown.title} has no prediction: {shown.failed}"
    if shown.untested:
        return f"{result.campaign}: {shown.untested}"
    if result.doctor:
        return f"{result.campaign}: {shown.title}: {sigma(shown.fit)} sigma: {doctor_sentence(result.doctor)}"
    said = "within the noise" if shown.within_noise else "not within the noise"
    said += ", what is written about the rig being within its tolerances" if shown.tolerated else ""
    said += f"; {shown.headline}" if shown.headline else ""
    held = "" if shown.holdout is None else f", held-out tests {sigma(shown.holdout)}"
    return f"{result.campaign}: {shown.title}: {sigma(shown.fit)} sigma{held}: {said}"


def coloured(value: float | None) -> Text:
    """A number of sigmas: green as noise, yellow, red as a misfit."""
    style = "dim" if value is None else "green" if value <= NOISE else "yellow" if value <= CLEAR else "red"
    return Text(sigma(value), style=style)


def _models(result: Comparison) -> Table:
    """Whitened RMS of every test by every model."""
    table = _table("error in sigmas, 1 is noise", *(HEADS[m.model] for m in result.models))
    working = next((m for m in result.models if m.tests), None)
    for row in working.tests if working else ():
        name = row.test if row.role == "fit" else f"{row.test} (held out)"
        by_model = [{t.test: t for t in m.tests}.get(row.test) for m in result.models]
        table.add_row(
            cell(name, NAME),
            *(
                Text(NONE) if t is None else coloured(t.rms) + Text("*" if t.lost else "", style="red")
                for t in by_model
            ),
        )
    table.add_section()
    table.add_row("all fitted tests", *(coloured(m.fit) for m in result.models), style="bold")
    table.add_row("all held-out tests", *(coloured(m.holdout) for m in result.models), style="bold")
    table.add_row("as large by noise", *(p_value(m.chi_square_p) for m in result.models))
    table.add_row("as smooth by noise", *(p_value(m.lag_one_p) for m in result.models))
    return table


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


def _channels(model: ModelError, width: int) -> Iterable[RenderableType]:
    """Tests against channels, and the channels in their units below, in blocks that are no wider than the page."""
    names = list(dict.fromkeys([*model.channels, *model.holdout_channels]))
    columns = [_column(name, model) for name in names]
    rows = _rows(model)
    first = min(max(_width(name) for name in rows), NAME)
    for part in blocks([max(5, *map(_width, column)) + 1 for column in columns], width - first):
        if part.start:
            yield Text()
        table = _table("", *(names[k] for k in part))
        for at, name in enumerate(rows):
            if at == len(model.tests):
                table.add_section()
            table.add_row(cell(name, NAME), *(columns[k][at + 1] for k in part))
        yield table


def _rows(model: ModelError) -> list[str]:
    tests = [test.test if test.role == "fit" else f"{test.test} (held out)" for test in model.tests]
    return [*tests, "fitted, in units", "held out, in units", "unit"]


def _column(channel: str, model: ModelError) -> list[Text]:
    """Head and cells of a channel."""
    errors = [test.channels.get(channel) for test in model.tests]
    fitted, held = model.channels.get(channel), model.holdout_channels.get(channel)
    known = fitted or held
    return [
        cell(channel, HEAD),
        *(coloured(None if e is None else e.sigmas) for e in errors),
        Text(_in_unit(fitted)),
        Text(_in_unit(held)),
        Text("" if known is None else _UNITS[known.unit][1], style="dim"),
    ]


def _in_unit(error: ChannelError | None) -> str:
    return number(None if error is None else error.rms * _UNITS[error.unit][0])


def _width(text: str | Text) -> int:
    plain = text.plain if isinstance(text, Text) else text
    return max(map(cell_len, plain.split("\n")))


def _failures(model: ModelError) -> list[RenderableType]:
    if model.untested:
        return [Text("  nothing can be tested")]
    if not model.channels and not model.holdout_channels:
        return [Text("  not measured yet: there is no reading that a model predicts")]
    told = [finding.sentence for finding in model.findings if finding.sentence]
    told = told or [f"not noise: {said}" for said in model.not_noise]
    told = [*told, *model.too_short]
    if told:
        return _lines("  ", told, SENTENCES)
    if model.within_noise:
        return [Text("  nothing beyond what noise gives in as many looks")]
    return [Text(f"  no single shape stands out, yet {sigma(model.fit)} sigma are more than noise")]


def _table(corner: str, *heads: str) -> Table:
    table = Table(box=None, padding=(0, 0, 0, 1), header_style="bold", pad_edge=False)
    table.add_column(corner, no_wrap=True)
    for head in heads:
        table.add_column(cell(head, HEAD), justify="right", no_wrap=True, min_width=5)
    return table


def _lines(start: str, sentences: Iterable[str], most: int) -> list[RenderableType]:
    """The first few sentences, one a line, and how many more there are."""
    every = list(sentences)
    shown = [*every[:most], *([f"... and {len(every) - most} more, see --json"] if len(every) > most else [])]
    return [Text(start + each) for each in shown]
