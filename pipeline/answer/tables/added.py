"""What adding effects changed, on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable
from math import log10

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.answer.record import LEVEL, Answer, TestChange, TestNoise
from pipeline.answer.tables.headline import headline, title
from pipeline.answer.value import Value
from pipeline.parameter_names import parted
from pipeline.terminal import cell, folded, lean, terminal
from reports.quantities import (
    AT_BOUND,
    FIXED,
    NOT_DETERMINED,
    estimate,
    interval_text,
    p_is,
    sigma,
    value_text,
)

BAR = 21
NAME, UNIT = 27, 12
"""Cells of a test's or a parameter's name and of a unit; longer ones go on below."""
EIGHTHS = " ▏▎▍▌▋▊▉█"
WIDE = 20.0
"""From so many sigmas on, bars are logarithmic: beside hundreds of sigmas ten would not be seen."""


def show(
    answer: Answer, saved: str, following: Iterable[str], quiet: bool, console: Console | None = None
) -> None:
    """Print the verdict and the parameters; unless quiet, also every test and all that is worth saying.

    saved: where the model went. following: commands that come next.
    """
    out = terminal(console)
    if not quiet:
        out.print(Text(f"{headline(answer)}\n"))
        out.print(error_table(answer), "")
    if answer.parameters:
        out.print(parameter_table(answer), "")
    said = answer.sentences[:1] if quiet else answer.sentences
    for sentence in said:
        out.print(escape(sentence))
    if not quiet:
        out.print(f"model: {escape(saved)}", soft_wrap=True)
        for command in following:
            out.print(f"next: {escape(command)}", soft_wrap=True)


def error_table(answer: Answer) -> Table:
    """Error of every test before and after, held-out tests apart, with bars on one scale."""
    before, after = answer.error[0], answer.error[-1]
    table = lean("test", "rows", "before", "after", title=title(answer))
    top = max([1.0, *(each.rms or 0.0 for t in answer.tests for each in (t.before, t.after))])
    table.add_column(scale(top), no_wrap=True, width=BAR)
    table.add_column("noise?", overflow="fold")
    # So many tests are looked at: together they are held to one level.
    level = LEVEL / max(2 * len(answer.tests), 1)
    for role in ("fit", "holdout"):
        mine = [t for t in answer.tests if t.role == role]
        for test in mine:
            table.add_row(*_row(test, top, level))
        if not mine:
            continue
        was, now = (before.fit, after.fit) if role == "fit" else (before.holdout, after.holdout)
        name = "all fitted tests" if role == "fit" else "held-out tests, never used"
        rows = str(sum(t.rows for t in mine))
        table.add_row(
            cell(name, NAME, "bold"), rows, sigma(was), f"[bold]{sigma(now)}", bar(was, now, top), ""
        )
        table.add_section()
    return table


def _row(test: TestChange, top: float, level: float) -> tuple[str | Text, ...]:
    was, now = test.before.rms, test.after.rms
    return (
        cell(test.test, NAME),
        str(test.rows),
        sigma(was),
        sigma(now),
        bar(was, now, top),
        _judged(test.after, level),
    )


def _judged(it: TestNoise, level: float) -> str:
    if it.lost:
        return f"[red]{it.lost} lost"
    p = [value for value in (it.chi_square_p, it.lag_one_p) if value is not None]
    if not p:
        return "[dim]–"
    return "[green]yes" if min(p) >= level else f"[yellow]{p_is(min(p))}"


def scale(top: float) -> str:
    """Head of a column of bars that go to `top` sigmas."""
    return "left of it" if top < WIDE else "left of it, log scale"


def bar(before: float | None, after: float | None, top: float, width: int = BAR) -> Text:
    """Solid to what is left, light to what there was; in eighths of a character; logarithmic from 0.1 if wide."""
    if before is None or after is None:
        return Text("")
    if top >= WIDE:
        before, after, top = (max(log10(10.0 * max(it, 0.1)), 0.0) for it in (before, after, top))
    top = max(top, 1e-9)
    solid = 8.0 * width * min(after / top, 1.0)
    whole, part = divmod(round(solid), 8)
    text = "█" * whole + (EIGHTHS[part] if part else "")
    light = round(width * min(before / top, 1.0)) - len(text)
    return Text.assemble((text, "cyan"), ("░" * max(light, 0), "dim"))


def parameter_table(answer: Answer) -> Table:
    """Value, 95 % interval and unit of every parameter, its meaning below its name."""
    table = lean("parameter", "value", "95 %", title="parameters")
    table.add_column("unit", overflow="fold")
    last = ""
    for name, it in answer.parameters.items():
        effect, parameter = parted(name)
        if effect != last:
            table.add_row(cell(effect, NAME + 2, "bold"))
        last = effect
        meaning = Text(folded(it.meaning, NAME), style="dim")
        named = Text("\n").join([cell(parameter, NAME), *([meaning] if it.meaning else [])])
        named = Text("\n").join([Text("  ") + line for line in named.split("\n")])
        unit = cell("" if it.unit == "1" else it.unit, UNIT)
        table.add_row(named, _value(it), _interval(it), unit)
    return table


def _value(it: Value) -> Text:
    """Beside it, on the next line, that it is at its bound."""
    known = estimate(it.model_dump())
    return Text(value_text(known)) + Text(f"\n{AT_BOUND}" if it.at_bound else "", style="yellow")


def _interval(it: Value) -> Text:
    said = interval_text(estimate(it.model_dump()))
    return Text(said, style="dim" if said in (NOT_DETERMINED, FIXED) else "")
