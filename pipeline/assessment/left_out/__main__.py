"""`python -m pipeline.assessment.left_out`: runs the study, or goes on with it, and writes reports/left_out."""

from __future__ import annotations

from collections.abc import Hashable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.left_out.benches import MU
from pipeline.assessment.left_out.entries import ENTRIES
from pipeline.assessment.left_out.page import page
from pipeline.assessment.left_out.trial import Trial, trial
from pipeline.provenance import code_digest, commit

OUT = Path("reports/left_out")
STORE = OUT / "trials.jsonl"
Task = tuple[int, str, str, str]


def main(
    rounds: Annotated[int, typer.Option(min=1, help="Benches of each effect at each of three sizes.")] = 4,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished benches are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Each effect left out of the catalogue and hidden on benches. Stopped and started again, it goes on."""
    here, code, names = commit(), code_digest(), list(ENTRIES)
    numbers = range(rounds * len(MU) * len(names))
    wanted: dict[Hashable, Task] = {
        (number, code): (number, names[number % len(names)], here, code) for number in numbers
    }
    found = trials.followed(
        "effects left out of the catalogue",
        trials.run(wanted, trial, Trial, lambda it: (it.number, it.code), store, workers),
        lambda done: f"{len(done)} of {len(wanted)} benches, {sum(each.right for each in done)} right",
        lambda done: trials.left(out, {"left_out.md": page(sorted(done, key=lambda it: it.number))}),
    )
    print(f"{out / 'left_out.md'}: {len(found)} benches")


if __name__ == "__main__":
    typer.run(main)
