"""`python -m pipeline.assessment.doubts`: runs the study, or goes on with it, and writes reports/doubts."""

from __future__ import annotations

from collections.abc import Hashable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.doubts.kinds import KINDS
from pipeline.assessment.doubts.page import page
from pipeline.assessment.doubts.trial import Trial, trial
from pipeline.provenance import code_digest, commit

OUT = Path("reports/doubts")
STORE = OUT / "trials.jsonl"
Task = tuple[str, int, str, str]


def main(
    count: Annotated[int, typer.Option(min=1, help="Benches of each kind.")] = 200,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished benches are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Each kind of doubt by itself, on as many benches. Stopped and started again, it goes on."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {
        (kind, number, code): (kind, number, here, code) for number in range(count) for kind in KINDS
    }
    order = {kind: k for k, kind in enumerate(KINDS)}
    found = trials.followed(
        "one doubt at a time",
        trials.run(wanted, trial, Trial, lambda it: (it.kind, it.number, it.code), store, workers),
        lambda done: f"{len(done)} of {len(wanted)} benches, {sum(each.right for each in done)} right",
        lambda done: trials.left(
            out, {"doubts.md": page(sorted(done, key=lambda it: (order[it.kind], it.number)))}
        ),
    )
    print(f"{out / 'doubts.md'}: {len(found)} benches")


if __name__ == "__main__":
    typer.run(main)
