"""`python -m pipeline.assessment.extrapolation`: runs the study, or goes on with it, and writes its report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from meshes.files import replacing
from pipeline.assessment.extrapolation.page import PICTURE, page
from pipeline.assessment.extrapolation.picture import drawn
from pipeline.assessment.extrapolation.study import run
from pipeline.assessment.extrapolation.table import study
from pipeline.assessment.extrapolation.trial import Trial
from pipeline.progress import Progress

OUT = Path("reports/extrapolation")
STORE = OUT / "trials.jsonl"


def main(
    cases: Annotated[
        int, typer.Option(min=1, help="Campaigns with hidden effects, from the first one on.")
    ] = 100,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished campaigns are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Predict beyond the fitted loads in several ways, and compare. Stopped and started again, it goes on."""
    progress = Progress()
    found: list[Trial] = []
    try:
        with progress.stage("extrapolation") as stage:
            for it in run(cases, store, workers):
                found.append(it)
                stage.say(f"{len(found)} of {cases} campaigns")
    finally:
        # A study that is stopped leaves the page of what it has.
        if found:
            written(found, out)
    print(f"{out / 'extrapolation.md'}: {len(found)} campaigns")


def written(found: Sequence[Trial], out: Path) -> None:
    """The page, its record and its picture, in a folder."""
    it = study(found)
    for name, content in (
        ("extrapolation.json", (it.model_dump_json(indent=1) + "\n").encode()),
        ("extrapolation.md", page(it).encode()),
        (PICTURE, drawn(it)),
    ):
        with replacing(out / name) as part:
            part.write_bytes(content)


if __name__ == "__main__":
    typer.run(main)
