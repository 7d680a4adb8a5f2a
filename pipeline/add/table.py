"""What adding effects changed, on a terminal of 100 columns."""

from __future__ import annotations

from collections.abc import Iterable
from math import floor, log10

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.answer import LEVEL, Answer, TestChange, TestNoise, Value

WIDTH, BAR = 100, 24
EIGHTHS = " ▏▎▍▌▋▊▉█"
WIDE = 20.0
"""From so many sigmas on, bars are logarithmic: beside hundreds of sigmas ten would not be seen."""


def show(
    answer: Answer, saved: str, following: Iterable[str], quiet: bool, console: Console | None = None
) -> None:
    """Print the verdict and the parameters; unless quiet, also every test and all that is worth saying.

    saved: where the model went. following: commands that come next.
    """
    out = console or Console(highlight=False)
    if out.width > WIDTH or not out.is_terminal:
        out.width = WIDTH
    if not quiet:
        out.print(error_table(answer))
    if answer.parameters:
        out.print(parameter_table(answer))
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
    table = Table(title=f"{escape(answer.campaign)}: error in sigmas, 1 is noise", title_justify="left")
    table.add_column("test", no_wrap=True, max_width=30)
    for name in ("rows", "before", "after"):
        table.add_column(name, justify="right", no_wrap=True)
    top = max([1.0, *(each.rms or 0.0 for t in answer.tests for each in (t.before, t.after))])
    table.add_column("left of it" if top < WIDE else "left of it, log scale", no_wrap=True, width=BAR)
    table.add_column("noise?", no_wrap=True)
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
        table.add_row(f"[bold]{name}", rows, _number(was), f"[bold]{_number(now)}", bar(was, now, top), "")
        table.add_section()
    return table


def _row(test: TestChange, top: float, level: float) -> tuple[str | Text, ...]:
    was, now = test.before.rms, test.after.rms
    return (
        escape(test.test),
        str(test.rows),
        _number(was),
        _number(now),
        bar(was, now, top),
        _judged(test.after, level),
    )


def _judged(it: TestNoise, level: float) -> str:
    if it.lost:
        return f"[red]{it.lost} lost"
    p = [value for value in (it.chi_square_p, it.lag_one_p) if value is not None]
    if not p:
        return "[dim]–"
    return "[green]yes" if min(p) >= level else f"[yellow]p {min(p):.0e}" if min(p) > 1e-99 else "[yellow]p 0"


def bar(before: float | None, after: float | None, top: float, width: int = BAR) -> Text:
    """Solid to what is left, light to what there was; in eighths of a character; logarithmic from 0.1 if wide."""
    if before is None or after is None:
        return Text("")
    if top >= WIDE:
        before, after, top = (max(log10(10.0 * max(it, 0.1)), 0.0) for it in (before, after, top))
    solid = 8.0 * width * min(after / top, 1.0)
    whole, part = divmod(round(solid), 8)
    text = "█" * whole + (EIGHTHS[part] if part else "")
    light = round(width * min(before / top, 1.0)) - len(text)
    return Text.assemble((text, "cyan"), ("░" * max(light, 0), "dim"))


def parameter_table(answer: Answer) -> Table:
    """Value, 95 % interval, unit and meaning of every parameter."""
    table = Table(title="parameters", title_justify="left")
    table.add_column("parameter", overflow="fold", ratio=3)
    table.add_column("value", justify="right", no_wrap=True)
    table.add_column("95 %", justify="right", no_wrap=True)
    table.add_column("unit", no_wrap=True)
    table.add_column("meaning", ratio=3)
    last = ""
    for name, it in answer.parameters.items():
        effect, _, parameter = name.partition(".")
        if effect != last:
            table.add_row(f"[bold]{escape(effect)}", "", "", "", "")
        last = effect
        meaning = Text(it.meaning)
        table.add_row(f"  {escape(parameter)}", _value(it), _interval(it), escape(it.unit), meaning)
    return table


def _value(it: Value) -> str:
    """To the second digit of the standard error."""
    if it.interval == "undetermined":
        return "[dim]–"
    return f"{it.value:.{_digits(it)}g}"


def _digits(it: Value) -> int:
    if it.std is None or it.std == 0.0 or it.value == 0.0:
        return 4
    return int(min(max(floor(log10(abs(it.value))) - floor(log10(it.std)) + 2, 2), 8))


def _interval(it: Value) -> str:
    if it.interval == "fixed":
        return "fixed"
    if it.interval == "undetermined":
        return "[dim]not determined"
    digits = _digits(it)
    low, high = ("" if end is None else f"{end:.{digits}g}" for end in (it.low95, it.high95))
    return f"{low} .. {high}"


def _number(value: float | None) -> str:
    return "–" if value is None else f"{value:.2f}" if value < 100.0 else f"{value:.0f}"
