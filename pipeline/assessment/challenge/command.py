"""`challenge` from the command line: runs the cases that are not kept yet, with progress, and writes the score."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from meshes.files import replacing
from pipeline.assessment import trials
from pipeline.assessment.challenge.dirty.outcome import DirtyOutcome, dirty_outcome
from pipeline.assessment.challenge.dirty.page import dirty_page
from pipeline.assessment.challenge.dirty.score import DirtyScored, dirty_scored
from pipeline.assessment.challenge.outcome import Outcome, outcome
from pipeline.assessment.challenge.page import page
from pipeline.assessment.challenge.score import Goal, Scored, scored
from pipeline.command import usable
from pipeline.progress import Progress
from pipeline.provenance import code_digest, commit

Task = tuple[int, str, str]


def run_challenge(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> Scored:
    """The score of the first so many cases. InputError where nothing can be written; stopped, it goes on."""
    result = scored(_outcomes(run, "challenge", cases, workers, out, store, quiet))
    _leave(result, "challenge", page(result), out, quiet)
    return result


def run_dirty(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> DirtyScored:
    """The same of the dirty programme."""
    result = dirty_scored(_outcomes(dirty_run, "dirty challenge", cases, workers, out, store, quiet))
    other = out / "challenge.json"
    clean = Scored.model_validate_json(other.read_text(encoding="utf-8")) if other.is_file() else None
    _leave(result, "dirty", dirty_page(result, clean), out, quiet)
    return result


def run(numbers: Sequence[int], store: Path, workers: int) -> Iterator[Outcome]:
    """The outcomes of these cases, those in the store first. Numbers, not the order of work, decide what a case is.

    An outcome counts for the code that it was made with: a score is that of one program.
    """
    return trials.run(_wanted(numbers), outcome, Outcome, lambda it: (it.number, it.code), store, workers)


def dirty_run(numbers: Sequence[int], store: Path, workers: int) -> Iterator[DirtyOutcome]:
    """The same of the dirty cases."""
    wanted = _wanted(numbers)
    return trials.run(wanted, dirty_outcome, DirtyOutcome, lambda it: (it.number, it.code), store, workers)


def _wanted(numbers: Sequence[int]) -> dict[Hashable, Task]:
    here, code = commit(), code_digest()
    return {(number, code): (number, here, code) for number in numbers}


def _outcomes(
    made: Callable[[Sequence[int], Path, int], Iterator[Any]],
    title: str,
    cases: int,
    workers: int,
    out: Path,
    store: Path,
    quiet: bool,
) -> list[Any]:
    """Of the first so many cases, with progress."""
    usable(out, f"--out {out}")
    usable(store.parent, f"--store {store}")
    found: list[Any] = []
    with Progress(quiet).stage(title) as stage:
        for it in made(range(cases), store, workers):
            found.append(it)
            bad = sum(each.score in ("wrong", "false alarm") for each in found)
            stage.say(f"{len(found)} of {cases} campaigns, {bad} named wrong")
    return found


def _leave(result: Scored | DirtyScored, name: str, text: str, out: Path, quiet: bool) -> None:
    """The score as a file and as a page."""
    for file, content in ((f"{name}.json", result.model_dump_json(indent=1) + "\n"), (f"{name}.md", text)):
        with replacing(out / file) as part:
            part.write_text(content, encoding="utf-8")
    if not quiet:
        _show(result.goals)
    print(f"{result.cases} campaigns; the score is in {out / f'{name}.md'}")


def _show(goals: Iterable[Goal]) -> None:
    table = Table(title="diagnosis of hidden effects", title_justify="left")
    for name in ("goal", "wanted", "found (95 % bounds)"):
        table.add_column(name)
    for goal in goals:
        table.add_row(goal.name, goal.wanted, str(goal.share))
    console = Console(highlight=False)
    if console.width > 100 or not console.is_terminal:
        console.width = 100
    console.print(table)
