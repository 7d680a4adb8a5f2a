"""A diagnosis on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.answer.record import Answer
from pipeline.answer.tables.added import BAR, NAME, bar, error_table, parameter_table, scale
from pipeline.answer.tables.headline import headline, title
from pipeline.terminal import cell, lean, terminal
from reports.quantities import short, sigma

SHOWN = 10
STEP = 36
"""Cells of the name of a step; longer ones go on below."""


def show(answer: Answer, following: Iterable[str], quiet: bool, console: Console | None = None) -> None:
    """Print the verdict; unless quiet also candidates, errors, parameters and all that is worth saying."""
    out = terminal(console)
    if not quiet:
        out.print(Text(f"{headline(answer)}\n"))
        tables = [waterfall(answer), candidate_table(answer), error_table(answer)]
        if answer.parameters:
            tables.append(parameter_table(answer))
        for table in tables:
            out.print(table, "")
    for sentence in answer.sentences[:1] if quiet else answer.sentences:
        out.print(escape(sentence))
    if not quiet:
        for command in following:
            out.print(f"next: {escape(command)}", soft_wrap=True)


def waterfall(answer: Answer) -> Table:
    """The error as effects are added one by one."""
    table = lean("model", "fitted", "held out", title=title(answer))
    top = max(step.fit for step in answer.error)
    table.add_column(scale(top), no_wrap=True, width=BAR)
    seen: tuple[str, ...] = ()
    for k, step in enumerate(answer.error):
        new = [name for name in step.effects if name not in seen]
        words = (" + ".join(step.effects) or "plain virtual springs") if k == 0 else "+ " + " + ".join(new)
        seen = step.effects
        table.add_row(cell(words, STEP), sigma(step.fit), sigma(step.holdout), bar(step.fit, step.fit, top))
    return table


def candidate_table(answer: Answer) -> Table:
    """Effects that were tried, best first."""
    table = lean(
        "effect",
        "first order",
        "fitted",
        "left out",
        "BIC behind",
        title="candidates: error in sigmas with each of them",
    )
    for it in answer.candidates[:SHOWN]:
        errors = (sigma(v) for v in (it.screen, it.fit, it.crossvalidated))
        mark = "bold" if it.effect in answer.effects else ""
        table.add_row(cell(it.effect, NAME + 2, mark), *errors, short(it.evidence))
    rest = answer.candidates[SHOWN:]
    if rest:
        table.caption = f"and {len(rest)} more that promise less"
    return table
