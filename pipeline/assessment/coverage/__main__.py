"""`python -m pipeline.assessment.coverage`: runs the study, or goes on with it, and writes reports/coverage."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from meshes.files import replacing
from pipeline.assessment.coverage.study import run, tasks
from pipeline.assessment.coverage.table import Study, joined, page, study
from pipeline.assessment.coverage.trial import Trial
from pipeline.assessment.trials import kept
from pipeline.progress import Progress

OUT = Path("reports/coverage")
STORE = OUT / "trials.jsonl"


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
    for name, text in (
        ("coverage.json", found.model_dump_json(indent=1) + "\n"),
        ("coverage.md", page(found)),
    ):
        with replacing(out / name) as part:
            part.write_text(text, encoding="utf-8")
    print(f"{out / 'coverage.md'}: {sum(row.noise.of for row in found.rows)} benches with hidden effects")


def _before(path: Path) -> Study:
    return Study.model_validate_json(path.read_text(encoding="utf-8")) if path.exists() else Study(rows=())


if __name__ == "__main__":
    typer.run(main)
