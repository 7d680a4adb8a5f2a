"""`python -m pipeline.assessment.coverage`: runs the study, or goes on with it, and writes reports/coverage."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.coverage.cases import PAIRS
from pipeline.assessment.coverage.table import Study, joined, page, study
from pipeline.assessment.coverage.trial import Kind, Trial, trial
from pipeline.assessment.trials import kept
from pipeline.progress import Progress
from pipeline.provenance import commit
from vjm.effects import for_kind

OUT = Path("reports/coverage")
STORE = OUT / "trials.jsonl"
Task = tuple[Kind, tuple[str, ...], int, int, str]
STEPS, FEW = 24, 8
FULL = 10
"""One seed in so many is measured at all steps of a test, the others at few: coverage does not need many rows."""
NOTHING_TO_FIND = "bar_geometric_nonlinearity"
"""Has no parameter, and is never absent from the bench."""


def main(
    seeds: Annotated[int, typer.Option(help="Benches of each effect, there and absent.")] = 200,
    pairs: Annotated[int, typer.Option(help="Benches of each pair.")] = 40,
    only: Annotated[list[str] | None, typer.Option(help="Effects; repeatable.")] = None,
    workers: Annotated[int, typer.Option(help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished benches are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Hide every effect on many benches, find it again, and count. Stopped and started again, it goes on.

    Rows that the page has of more benches than are kept here stay, so that it can grow effect by effect.
    """
    wanted = tasks(seeds, pairs, only or ())
    progress = Progress()
    with progress.stage("coverage") as stage:
        for done, _ in enumerate(run(wanted, store, workers), 1):
            stage.say(f"{done} of {len(wanted)} benches")
    found = joined(study(kept(store, Trial)), _before(out / "coverage.json"))
    trials.left(out, {"coverage.json": found.model_dump_json(indent=1) + "\n", "coverage.md": page(found)})
    print(f"{out / 'coverage.md'}: {sum(row.noise.of for row in found.rows)} benches with hidden effects")


def steps_of(seed: int, effects: Sequence[str]) -> int:
    """Load steps of each test on the bench of that seed; few of them miss the turning points, where bars yield."""
    return STEPS if seed % FULL == 0 or "material_yield" in effects else FEW


def tasks(seeds: int, pair_seeds: int, only: Sequence[str] = ()) -> list[Task]:
    """All trials of a study, seed after seed, so that a study that was stopped says something about every effect."""
    here = commit()
    names = [name for name in for_kind("parallelogram") if not only or name in only]
    pairs = [pair for pair in PAIRS if not only or set(pair) <= set(only)]
    found: list[Task] = []
    for seed in range(max(seeds, pair_seeds)):
        sets: list[tuple[Kind, tuple[str, ...]]] = []
        if seed < seeds:
            sets += [("there", (name,)) for name in names]
            sets += [("absent", (name,)) for name in names if name != NOTHING_TO_FIND]
        if seed < pair_seeds:
            sets += [("there", pair) for pair in pairs]
        found += [(kind, effects, seed, steps_of(seed, effects), here) for kind, effects in sets]
    return found


def run(wanted: Iterable[Task], store: Path, workers: int) -> Iterator[Trial]:
    """The trials, those in the store first; the others are added to it as they are done."""
    return trials.run({task[:4]: task for task in wanted}, trial, Trial, _key, store, workers)


def _key(it: Trial) -> tuple[Kind, tuple[str, ...], int, int]:
    return it.kind, it.effects, it.seed, it.steps


def _before(path: Path) -> Study:
    return Study.model_validate_json(path.read_text(encoding="utf-8")) if path.exists() else Study(rows=())


if __name__ == "__main__":
    typer.run(main)
