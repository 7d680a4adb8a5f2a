"""`python -m pipeline.assessment.sensitivity`: runs the study, or goes on with it, and writes reports/sensitivity."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path
from typing import Annotated

import typer

from meshes.files import replacing
from pipeline.assessment import trials
from pipeline.assessment.sensitivity.page import page
from pipeline.assessment.sensitivity.trial import Trial, trial
from pipeline.progress import Progress
from pipeline.provenance import code_digest, commit

OUT = Path("reports/sensitivity")
STORE = OUT / "trials.jsonl"
Task = tuple[int, str, str]
FIRST, STEP, BENCHES = 3, 10, 60


def main(
    benches: Annotated[
        int, typer.Option(min=1, help="Benches of the challenge, every tenth case.")
    ] = BENCHES,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished benches are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Halve and double every criterion of the diagnosis alone. Stopped and started again, it goes on."""
    progress = Progress()
    found: list[Trial] = []
    try:
        with progress.stage("sensitivity") as stage:
            for it in run(benches, store, workers):
                found.append(it)
                stage.say(
                    f"{len(found)} of {benches} benches, {sum(len(t.changes) for t in found)} answers change"
                )
    finally:
        # A study that is stopped leaves the page of what it has.
        if found:
            written(found, out)
    print(f"{out / 'sensitivity.md'}: {len(found)} benches")


def numbers(benches: int = BENCHES) -> Sequence[int]:
    """Every tenth case of the challenge, which have every kind."""
    return range(FIRST, FIRST + STEP * benches, STEP)


def run(benches: int, store: Path, workers: int) -> Iterator[Trial]:
    """The trials of so many benches, those in the store first; one counts for the code that it was made with."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(number, code): (number, here, code) for number in numbers(benches)}
    return trials.run(wanted, trial, Trial, lambda it: (it.number, it.code), store, workers)


def written(found: Sequence[Trial], out: Path) -> None:
    """The page, in a folder."""
    with replacing(out / "sensitivity.md") as part:
        part.write_text(page(sorted(found, key=lambda it: it.number)), encoding="utf-8")


if __name__ == "__main__":
    typer.run(main)
