"""`python -m pipeline.assessment.sensitivity`: runs the study, or goes on with it, and writes reports/sensitivity."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from meshes.files import replacing
from pipeline.assessment.sensitivity.page import page
from pipeline.assessment.sensitivity.study import BENCHES, run
from pipeline.assessment.sensitivity.trial import Trial
from pipeline.progress import Progress

OUT = Path("reports/sensitivity")
STORE = OUT / "trials.jsonl"


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


def written(found: Sequence[Trial], out: Path) -> None:
    """The page, in a folder."""
    with replacing(out / "sensitivity.md") as part:
        part.write_text(page(sorted(found, key=lambda it: it.number)), encoding="utf-8")


if __name__ == "__main__":
    typer.run(main)
