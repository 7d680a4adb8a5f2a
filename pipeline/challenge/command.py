"""`challenge` from the command line: runs the cases that are not kept yet, with progress, and writes the score."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rich.console import Console
from rich.table import Table

from meshes.files import replacing
from pipeline.challenge.dirty.outcome import DirtyOutcome
from pipeline.challenge.dirty.page import dirty_page
from pipeline.challenge.dirty.score import DirtyScored, dirty_scored
from pipeline.challenge.dirty.study import run as dirty_run
from pipeline.challenge.page import page
from pipeline.challenge.score import Goal, Scored, scored
from pipeline.challenge.study import run
from pipeline.command import usable
from pipeline.progress import Progress


def run_challenge(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> Scored:
    """The score of the first so many cases. InputError where nothing can be written; stopped, it goes on."""
    usable(out, f"--out {out}")
    usable(store.parent, f"--store {store}")
    progress = Progress(quiet)
    found = []
    with progress.stage("challenge") as stage:
        for it in run(range(cases), store, workers):
            found.append(it)
            bad = sum(each.score in ("wrong", "false alarm") for each in found)
            stage.say(f"{len(found)} of {cases} campaigns, {bad} named wrong")
    result = scored(found)
    for name, text in (
        ("challenge.json", result.model_dump_json(indent=1) + "\n"),
        ("challenge.md", page(result)),
    ):
        with replacing(out / name) as part:
            part.write_text(text, encoding="utf-8")
    if not quiet:
        _show(result.goals)
    print(f"{result.cases} campaigns; the score is in {out / 'challenge.md'}")
    return result


def run_dirty(cases: int, workers: int, out: Path, store: Path, quiet: bool = False) -> DirtyScored:
    """The same of the dirty programme."""
    usable(out, f"--out {out}")
    usable(store.parent, f"--store {store}")
    found: list[DirtyOutcome] = []
    with Progress(quiet).stage("dirty challenge") as stage:
        for it in dirty_run(range(cases), store, workers):
            found.append(it)
            bad = sum(each.score in ("wrong", "false alarm") for each in found)
            stage.say(f"{len(found)} of {cases} campaigns, {bad} named wrong")
    result = dirty_scored(found)
    other = out / "challenge.json"
    clean = Scored.model_validate_json(other.read_text(encoding="utf-8")) if other.is_file() else None
    for name, text in (
        ("dirty.json", result.model_dump_json(indent=1) + "\n"),
        ("dirty.md", dirty_page(result, clean)),
    ):
        with replacing(out / name) as part:
            part.write_text(text, encoding="utf-8")
    if not quiet:
        _show(result.goals)
    print(f"{result.cases} campaigns; the score is in {out / 'dirty.md'}")
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
