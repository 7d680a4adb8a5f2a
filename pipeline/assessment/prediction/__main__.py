"""`python -m pipeline.assessment.prediction`: runs the study, or goes on with it, and writes reports/predict."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.extrapolation.cases import numbers
from pipeline.assessment.prediction.table import page, study
from pipeline.assessment.prediction.trial import Trial, trial
from pipeline.provenance import commit

OUT = Path("reports/predict")
STORES = {False: "trials.jsonl", True: "tolerances.jsonl"}
Task = tuple[int, str, bool]
NAMES = {False: "predict", True: "tolerances"}


def main(
    cases: Annotated[
        int, typer.Option(min=1, help="Campaigns with hidden effects, from the first one on.")
    ] = 100,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    tolerances: Annotated[
        bool, typer.Option("--tolerances", help="Benches that are off what is written, within tolerances.")
    ] = False,
    store: Annotated[
        Path | None,
        typer.Option(help="Where finished campaigns are kept; default in the folder of the page."),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Count how many held-out readings lie inside their intervals. Stopped and started again, it goes on."""
    found = trials.followed(
        "predict",
        run(cases, store or out / STORES[tolerances], workers, tolerances),
        lambda done: f"{len(done)} of {cases} campaigns",
        lambda done: written(done, out, tolerances),
    )
    print(f"{out / NAMES[tolerances]}.md: {len(found)} campaigns")


def run(cases: int, store: Path, workers: int, tolerances: bool = False) -> Iterator[Trial]:
    """The trials of the first so many cases of the challenge that hide effects, those in the store first; tolerances
    as in `measured`."""
    here = commit()
    wanted: Mapping[Hashable, Task] = {number: (number, here, tolerances) for number in numbers(cases)}
    return trials.run(wanted, trial, Trial, lambda it: it.number, store, workers)


def written(found: list[Trial], out: Path, tolerances: bool = False) -> None:
    """The page and its record, in a folder; none before a case is named right."""
    if not any(it.named and it.true for it in found):
        return
    it, name = study(found), NAMES[tolerances]
    trials.left(
        out, {f"{name}.json": it.model_dump_json(indent=1) + "\n", f"{name}.md": page(it, tolerances)}
    )


if __name__ == "__main__":
    typer.run(main)
