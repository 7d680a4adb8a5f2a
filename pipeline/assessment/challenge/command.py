"""`challenge` from the command line: runs the cases that are not kept yet, with progress, and writes the score."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console
from rich.table import Table

from pipeline.assessment.challenge.dirty.outcome import DirtyOutcome, dirty_outcome
from pipeline.assessment.challenge.dirty.page import dirty_page
from pipeline.assessment.challenge.dirty.score import DirtyScored, dirty_scored
from pipeline.assessment.challenge.outcome import Outcome, outcome
from pipeline.assessment.challenge.page import page
from pipeline.assessment.challenge.score import Goal, Scored, scored
from pipeline.assessment.study import Study
from pipeline.command import usable

Result = TypeVar("Result", Scored, DirtyScored)


CLEAN: Study[Any] = Study(
    name="challenge",
    title="challenge",
    of="campaigns",
    count=600,
    counted="Campaigns, from the first one on.",
    # Numbers, not the order of work, decide what a case is.
    tasks=lambda count: [(number,) for number in range(count)],
    trial=outcome,
    kind=Outcome,
    task=lambda it: (it.number,),
    right=lambda it: it.score not in ("wrong", "false alarm"),
    page=lambda found: page(scored(found)),
    beside=lambda found: {"challenge.json": scored(found).text()},
)
DIRTY = replace(
    CLEAN,
    name="dirty",
    title="dirty challenge",
    trial=dirty_outcome,
    kind=DirtyOutcome,
    page=lambda found: dirty_page(dirty_scored(found), None),
    beside=lambda found: {"dirty.json": dirty_scored(found).text()},
)


def run_challenge(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> Scored:
    """The score of the first so many cases. InputError where nothing can be written; stopped, it goes on."""
    return _run(CLEAN, scored, cases, workers, out, store, quiet)


def run_dirty(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> DirtyScored:
    """The same of the dirty programme, beside the score of the clean one where that is in the folder."""
    other = out / "challenge.json"
    clean = Scored.model_validate_json(other.read_text(encoding="utf-8")) if other.is_file() else None
    beside = replace(DIRTY, page=lambda found: dirty_page(dirty_scored(found), clean))
    return _run(beside, dirty_scored, cases, workers, out, store, quiet)


def _run(
    study: Study[Any],
    score: Callable[[Sequence[Any]], Result],
    cases: int,
    workers: int,
    out: Path,
    store: Path,
    quiet: bool,
) -> Result:
    usable(out, f"--out {out}")
    usable(store.parent, f"--store {store}")
    result = score(study.run(cases, workers, store, out, quiet))
    if not quiet:
        _show(result.goals)
    print(f"{result.cases} campaigns; the score is in {out / f'{study.name}.md'}")
    return result


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
