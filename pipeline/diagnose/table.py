"""A diagnosis on a terminal of 100 columns."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pipeline.add.table import WIDTH, bar, error_table, parameter_table
from pipeline.answer import Answer

SHOWN = 10


def show(answer: Answer, following: Iterable[str], quiet: bool, console: Console | None = None) -> None:
    """Print the verdict; unless quiet also candidates, errors, parameters and all that is worth saying."""
    out = console or Console(highlight=False)
    if out.width > WIDTH or not out.is_terminal:
        out.width = WIDTH
    if not quiet:
        out.print(waterfall(answer))
        out.print(candidate_table(answer))
        out.print(error_table(answer))
        if answer.parameters:
            out.print(parameter_table(answer))
    for sentence in answer.sentences[:1] if quiet else answer.sentences:
        out.print(escape(sentence))
    if not quiet:
        for command in following:
            out.print(f"next: {escape(command)}", soft_wrap=True)


def waterfall(answer: Answer) -> Table:
    """The error as effects are added one by one."""
    table = Table(title=f"{escape(answer.campaign)}: error in sigmas, 1 is noise", title_justify="left")
    for name, justify in (("model", "left"), ("fitted", "right"), ("held out", "right"), ("", "left")):
        table.add_column(name, justify="left" if justify == "left" else "right")
    top = max(step.fit for step in answer.error)
    seen: tuple[str, ...] = ()
    for k, step in enumerate(answer.error):
        new = [name for name in step.effects if name not in seen]
        words = (" + ".join(step.effects) or "plain virtual springs") if k == 0 else "+ " + " + ".join(new)
        seen = step.effects
        held = "–" if step.holdout is None else f"{step.holdout:.3g}"
        table.add_row(escape(words), f"{step.fit:.3g}", held, bar(step.fit, step.fit, top))
    return table


def candidate_table(answer: Answer) -> Table:
    """Effects that were tried, best first."""
    table = Table(title="candidates: error in sigmas with each of them", title_justify="left")
    table.add_column("effect", no_wrap=True)
    for name in ("first order", "fitted", "left out", "BIC behind"):
        table.add_column(name, justify="right", no_wrap=True)
    for it in answer.candidates[:SHOWN]:
        cells = (it.screen, it.fit, it.crossvalidated, it.evidence)
        numbers = ["–" if v is None else f"{v:.3g}" if abs(v) < 1e5 else f"{v:.1e}" for v in cells]
        mark = "[bold]" if it.effect in answer.effects else ""
        table.add_row(f"{mark}{escape(it.effect)}", *numbers)
    rest = answer.candidates[SHOWN:]
    if rest:
        table.caption = f"and {len(rest)} more that promise less"
    return table
