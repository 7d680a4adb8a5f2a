"""The waterfall of an improvement, and what is said at its end, on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.answer.record import Answer, Verdict
from pipeline.answer.tables.added import BAR, bar, parameter_table, scale
from pipeline.answer.tables.diagnosis import STEP
from pipeline.answer.tables.headline import headline
from pipeline.improve.steps import Step
from pipeline.selection.diagnosis import Diagnosis
from pipeline.terminal import cell, lean, terminal
from pipeline.typed import command
from reports.quantities import sigma


def waterfall(campaign: str, done: Sequence[Step]) -> Table:
    """One row a step: the error that is left in the fitted tests and in those held out."""
    top = max((step.error.fit for step in done), default=1.0)
    table = lean("step", "fitted", "held out", title=f"{campaign}: error in sigmas, 1 is noise")
    table.add_column(scale(top), no_wrap=True, width=BAR)
    for number, step in enumerate(done):
        words = f"+ {step.added}" if number else " + ".join(step.error.effects) or "plain virtual springs"
        left = step.error.fit
        table.add_row(cell(words, STEP), sigma(left), sigma(step.error.holdout), bar(left, left, top))
    return table


def closing(
    answer: Answer,
    found: Diagnosis,
    saved: str,
    following: Iterable[str],
    quiet: bool,
    steps: Iterable[Table] = (),
) -> None:
    """One line of headline, steps, parameters, what is worth saying, where the model is and what can be done next."""
    out = terminal()
    if not quiet:
        out.print(Text(f"{headline(answer)}\n"))
    for table in steps:
        out.print(table, "")
    if answer.parameters:
        out.print(parameter_table(answer), "")
    for sentence in answer.sentences[:1] if quiet else answer.sentences:
        out.print(escape(sentence))
    if answer.added:
        out.print(f"added: {', '.join(answer.added)}; saved: {escape(saved)}", soft_wrap=True)
    elif found.verdict == "within_noise":
        out.print("Nothing was added: what is left is noise.")
    else:
        out.print("Nothing was added: no effect is certain.")
    if not quiet:
        for each in following:
            out.print(f"next: {escape(each)}", soft_wrap=True)


def following(answer: Answer, verdict: Verdict, folder: Path, out: Path | None) -> list[str]:
    """Commands to go on with, or back."""
    some = [f"{command('remove', folder, answer.added[-1])}   (undoes the last step)"] if answer.added else []
    if verdict == "ambiguous":
        some.append(command("plan", folder))
    return some
