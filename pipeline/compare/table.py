"""A comparison on a terminal: models side by side, tests against channels, and how the model fails, in words."""

from __future__ import annotations

from collections.abc import Iterable

from rich.cells import cell_len
from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from pipeline.answer.wording.doctor import doctor_sentence, mends
from pipeline.compare.record import ChannelError, Comparison, ModelError, TestError
from pipeline.terminal import WIDTH, blocks, cell, one_line, terminal
from reports.quantities import NONE, number, p_value, sigma

NAME, HEAD = 30, 10
"""Cells of a test's and of a channel's name; longer ones go on below."""
SENTENCES, LOST, REMARKS = 12, 4, 4
"""Lines of each kind at most."""
SCREEN, WORST, FEW, CHANNELS = 8, 4, 2, 2
"""Tests up to which all are shown; of more of them: tests, sentences and channels, the worst ones."""
HEADS = {"lin": "LIN", "vjm": "VJM", "saved": "saved", "fea": "FEA"}
FULL = "every test and channel: see --full"
_UNITS = {"mm": (1e3, "µm"), "rad": (1e6, "µrad"), "N": (1.0, "N"), "Nmm": (1.0, "Nmm")}
"""In which an error is shown, and by how much it is multiplied for that."""
NOISE, CLEAR = 1.5, 3.0
"""Sigmas up to which an error is shown as noise, and from which as a clear misfit."""


def show(result: Comparison, console: Console | None = None, full: bool = False) -> None:
    """Print a comparison; full: every test and channel, however many."""
    out = terminal(console)
    out.print(page(result, out.width, full))


def page(result: Comparison, width: int = WIDTH, full: bool = False) -> RenderableType:
    """A comparison, so many columns wide, one line of headline first. One of many tests is told in a screen, by those
    that are missed most, unless it is asked for in full."""
    whole = full or result.tests <= SCREEN
    shown = result.model_of(result.shown)
    counts = f"{result.tests} tests, {result.rows} load steps, {result.readings} readings to predict"
    if result.remarks and not whole:
        counts += f"; {len(result.remarks)} remarks"
    parts: list[RenderableType] = [
        Text(headline(result)),
        *(Text(said) for said in _details(result)),
        Text(counts),
        *(Text(said) for said in mends(result.doctor)),
        *(Text(f"{said}.") for said in result.not_done),
        *_lines("", shown.in_units, SENTENCES),
        *(_lines("remark: ", result.remarks, REMARKS) if whole else []),
        *([Text()] if whole else []),
        tests_table(result, whole),
        *_lost(result, LOST if whole else 1),
    ]
    if shown.failed is None:
        if whole:
            parts.append(Text(f"\n{shown.title}: error of each channel, in its sigmas"))
            parts += [*_channels(shown, width), Text()]
        else:
            parts.append(Text(_worst_channels(shown)))
        parts += [Text(f"How {shown.title} fails in the fitted tests:"), *_failures(shown, whole)]
    return Group(*parts)


def headline(result: Comparison) -> str:
    """The comparison in one line of 80 columns."""
    return one_line(*_tries(result))


def _tries(result: Comparison) -> Iterable[str]:
    shown, name = result.model_of(result.shown), result.campaign
    model = HEADS[shown.model]
    if shown.failed is not None:
        yield f"{name}: {model} has no prediction: {shown.failed}"
        yield f"{model} has no prediction, see below"
        return
    if shown.untested:
        yield f"{name}: {shown.untested}"
        yield "nothing can be tested, see below"
        return
    error = f"{model}: {sigma(shown.fit)} sigma"
    held = "" if shown.holdout is None else f", held-out tests {sigma(shown.holdout)}"
    said = "within the noise" if shown.within_noise else "not within the noise"
    said = "a mistake of the table comes first" if result.doctor else said
    for text in (f"{error}{held}: {said}", f"{error}: {said}"):
        yield f"{name}: {text}"
    yield f"{error}: {said}"


def _details(result: Comparison) -> Iterable[str]:
    """What the headline has no room for."""
    shown = result.model_of(result.shown)
    if shown.failed is not None:
        yield f"{shown.title} has no prediction: {shown.failed}"
        return
    if shown.untested:
        yield shown.untested
        return
    if result.doctor:
        yield doctor_sentence(result.doctor)
        return
    if shown.tolerated:
        yield "That is with what is written about the rig as it fits best within its tolerances."
    if shown.headline:
        yield shown.headline


def _worst_channels(model: ModelError) -> str:
    """The channels that fit worst, in their sigmas and units, in two lines."""
    worst = sorted(model.channels.items(), key=lambda it: -it[1].sigmas)[:CHANNELS]
    said = ", ".join(
        f"{name} {sigma(it.sigmas)} sigma ({_in_unit(it)} {_UNITS[it.unit][1]})" for name, it in worst
    )
    return f"worst channels: {said}" if said else "no channel is predicted"


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


def tests_table(result: Comparison, whole: bool = False) -> Table:
    """Whitened RMS of every test by every model, or of those that are missed most."""
    table = _table("error in sigmas, 1 is noise", *(HEADS[m.model] for m in result.models))
    working = next((m for m in result.models if m.tests), None)
    by_model = [{t.test: t for t in m.tests} for m in result.models]
    tests = list(working.tests) if working else []
    some = tests if whole or len(tests) <= SCREEN else _missed_most(result, tests)
    for row in some:
        name = row.test if row.role == "fit" else f"{row.test} (held out)"
        found = [its.get(row.test) for its in by_model]
        table.add_row(
            cell(name, NAME),
            *(
                Text(NONE) if t is None else coloured(t.rms) + Text("*" if t.lost else "", style="red")
                for t in found
            ),
        )
    if len(some) < len(tests):
        others = {t.test for t in tests} - {t.test for t in some}
        worst = [max((its[n].rms or 0.0 for n in others if n in its), default=None) for its in by_model]
        table.add_row(f"{len(others)} others, at most", *map(coloured, worst))
    table.add_section()
    table.add_row("all fitted tests", *(coloured(m.fit) for m in result.models), style="bold")
    table.add_row("all held-out tests", *(coloured(m.holdout) for m in result.models), style="bold")
    table.add_row("as large by noise", *(p_value(m.chi_square_p) for m in result.models))
    table.add_row("as smooth by noise", *(p_value(m.lag_one_p) for m in result.models))
    return table


def _missed_most(result: Comparison, tests: list[TestError]) -> list[TestError]:
    """Tests that the model that is told misses most, in the order of the campaign."""
    errors = {t.test: t.rms or 0.0 for t in result.model_of(result.shown).tests}
    worst = sorted(tests, key=lambda t: -errors.get(t.test, 0.0))[:WORST]
    return [t for t in tests if t in worst]


def _lost(result: Comparison, most: int) -> list[RenderableType]:
    """Rows and models without a prediction."""
    out: list[RenderableType] = []
    for model in result.models:
        head = HEADS[model.model]
        if model.failed is not None:
            out.append(Text(f"{head} has no prediction: {model.failed}"))
        out += _lines(f"* {head}, ", [lost.sentence for lost in model.lost], most)
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


def _failures(model: ModelError, whole: bool) -> list[RenderableType]:
    if model.untested:
        return [Text("  nothing can be tested")]
    if not model.channels and not model.holdout_channels:
        return [Text("  not measured yet: there is no reading that a model predicts")]
    told = [finding.sentence for finding in model.findings if finding.sentence]
    told = told or [f"not noise: {said}" for said in model.not_noise]
    told = [*told, *model.too_short]
    if told:
        return _lines("  ", told, SENTENCES) if whole else _lines("  ", told, FEW, FULL)
    if model.within_noise:
        return [Text("  nothing beyond what noise gives in as many looks")]
    return [Text(f"  no single shape stands out, yet {sigma(model.fit)} sigma are more than noise")]


def _table(corner: str, *heads: str) -> Table:
    table = Table(box=None, padding=(0, 0, 0, 1), header_style="bold", pad_edge=False)
    table.add_column(corner, no_wrap=True)
    for head in heads:
        table.add_column(cell(head, HEAD), justify="right", no_wrap=True, min_width=5)
    return table


def _lines(start: str, sentences: Iterable[str], most: int, rest: str = "see --json") -> list[RenderableType]:
    """The first few sentences, one a line, and how many more there are."""
    every = list(sentences)
    left = len(every) - most
    shown = [*every[:most], *([f"... and {left} more, {rest}"] if left > 0 else [])]
    return [Text(start + each) for each in shown]
