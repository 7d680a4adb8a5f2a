"""`python -m pipeline.assessment.challenge.laws`: all benches with laws; it may be stopped and started again."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path
from typing import Annotated

import typer

from pipeline.assessment import trials
from pipeline.assessment.challenge.laws.cases import CASES, Kind
from pipeline.assessment.challenge.laws.outcome import LawOutcome, law_outcome
from pipeline.assessment.challenge.laws.page import law_page
from pipeline.assessment.challenge.laws.score import law_scored
from pipeline.provenance import code_digest, commit

STORE = Path("reports/challenge/laws_outcomes.jsonl")
Task = tuple[Kind, int, str, str]


def main(
    share: Annotated[float, typer.Option(min=0.01, max=1.0, help="Of each kind of case, the first.")] = 1.0,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    out: Annotated[Path, typer.Option(help="Folder of the score.")] = Path("reports/challenge"),
    store: Annotated[Path, typer.Option(help="Where finished benches are kept.")] = STORE,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress.")] = False,
) -> None:
    """The score of the look for laws."""
    cases = [(kind, k) for kind, count in CASES.items() for k in range(max(1, round(share * count)))]
    found = trials.followed(
        "benches with laws",
        run(cases, store, workers),
        lambda done: f"{len(done)} of {len(cases)}, {sum(all(each.right) for each in done)} places right",
        lambda done: written(done, out),
        quiet,
    )
    print(f"{len(found)} benches; the score is in {out / 'laws.md'}")


def written(found: Sequence[LawOutcome], out: Path) -> None:
    """The page and its record, in a folder."""
    result = law_scored(found)
    trials.left(out, {"laws.json": result.model_dump_json(indent=1) + "\n", "laws.md": law_page(result)})


def run(cases: Sequence[tuple[Kind, int]], store: Path, workers: int) -> Iterator[LawOutcome]:
    """The outcomes of these cases, those in the store first; of the code that is here."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(*each, code): (*each, here, code) for each in cases}
    return trials.run(
        wanted, law_outcome, LawOutcome, lambda it: (it.kind, it.number, it.code), store, workers
    )


if __name__ == "__main__":
    typer.run(main)
