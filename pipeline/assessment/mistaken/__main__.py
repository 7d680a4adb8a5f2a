"""`python -m pipeline.assessment.mistaken`: runs the study, or goes on with it, and writes reports/mistaken."""

from __future__ import annotations

from collections.abc import Hashable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.mistaken.page import page
from pipeline.assessment.mistaken.tables import KINDS
from pipeline.assessment.mistaken.trial import NONE, Trial, benches, trial
from pipeline.provenance import code_digest, commit

OUT = Path("reports/mistaken")
STORE = OUT / "trials.jsonl"
Task = tuple[str, int, str, str]


def main(
    count: Annotated[int, typer.Option(min=1, help="Benches of each kind, with and without an effect.")] = 20,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished tables are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Twelve kinds of mistakes of a table, and right ones. Stopped and started again, it goes on."""
    here, code = commit(), code_digest()
    numbers = sorted((*benches("clean", count), *benches("single", count)))
    wanted: dict[Hashable, Task] = {
        (kind, number, code): (kind, number, here, code) for number in numbers for kind in (NONE, *KINDS)
    }
    order = {kind: k for k, kind in enumerate((NONE, *KINDS))}
    found = trials.followed(
        "mistakes of tables",
        trials.run(wanted, trial, Trial, lambda it: (it.kind, it.number, it.code), store, workers),
        lambda done: (
            f"{len(done)} of {len(wanted)} tables, "
            f"{sum(each.named for each in done if each.counts)} as it should be"
        ),
        lambda done: trials.left(
            out, {"mistaken.md": page(sorted(done, key=lambda it: (it.number, order[it.kind])))}
        ),
    )
    print(f"{out / 'mistaken.md'}: {len(found)} tables")


if __name__ == "__main__":
    typer.run(main)
