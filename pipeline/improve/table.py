"""The waterfall of an improvement, and what is said at its end, on a terminal of 100 columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pipeline.add.table import WIDTH, bar, parameter_table
from pipeline.answer import Answer, Verdict
from pipeline.diagnose.diagnosis import Diagnosis
from pipeline.improve.steps import Step


def waterfall(campaign: str, done: Sequence[Step]) -> Table:
    """One row a step: the error that is left in the fitted tests and in those held out."""
    top = max((step.error.fit for step in done), default=1.0)
    title = f"{escape(campaign)}: error in sigmas, 1 is noise"
    table = Table(title=title, title_justify="left")
    table.add_column("step")
    table.add_column("fitted", justify="right")
    table.add_column("held out", justify="right")
    table.add_column("left of it" if top < 20.0 else "left of it, log scale", no_wrap=True)
    for number, step in enumerate(done):
        words = f"+ {step.added}" if number else " + ".join(step.error.effects) or "plain virtual springs"
        held = "–" if step.error.holdout is None else f"{step.error.holdout:.3g}"
        table.add_row(escape(words), f"{step.error.fit:.3g}", held, bar(step.error.fit, step.error.fit, top))
    return table


def closing(answer: Answer, found: Diagnosis, saved: str, following: Iterable[str], quiet: bool) -> None:
    """Verdict, parameters, what is worth saying, where the model is and what can be done next."""
    out = Console(highlight=False)
    if out.width > WIDTH or not out.is_terminal:
        out.width = WIDTH
    if answer.parameters:
        out.print(parameter_table(answer))
    for sentence in answer.sentences[:1] if quiet else answer.sentences:
        out.print(escape(sentence))
    if answer.added:
        out.print(f"added: {', '.join(answer.added)}; saved: {escape(saved)}", soft_wrap=True)
    elif found.verdict == "within_noise":
        out.print("Nothing was added: what is left is noise.")
    else:
        out.print("Nothing was added: no effect is certain.")
    if not quiet:
        for command in following:
            out.print(f"next: {escape(command)}", soft_wrap=True)


def following(answer: Answer, verdict: Verdict, folder: Path, out: Path | None) -> list[str]:
    """Commands to go on with, or back."""
    some = (
        [f"python -m pipeline remove {folder} {answer.added[-1]}   (undoes the last step)"]
        if answer.added
        else []
    )
    if verdict == "ambiguous":
        some.append(f"python -m pipeline plan {folder}")
    return some
