"""`python -m pipeline.assessment.challenge.laws`: all benches with laws; it may be stopped and started again."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path
from typing import Annotated

import typer

from meshes.files import replacing
from pipeline.assessment import trials
from pipeline.assessment.challenge.laws.cases import CASES, Kind
from pipeline.assessment.challenge.laws.outcome import LawOutcome, law_outcome
from pipeline.assessment.challenge.laws.page import law_page
from pipeline.assessment.challenge.laws.score import law_scored
from pipeline.progress import Progress
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
    found: list[LawOutcome] = []
    with Progress(quiet).stage("benches with laws") as stage:
        for it in run(cases, store, workers):
            found.append(it)
            stage.say(f"{len(found)} of {len(cases)}, {sum(all(each.right) for each in found)} places right")
    result = law_scored(found)
    for name, text in (("laws.json", result.model_dump_json(indent=1) + "\n"), ("laws.md", law_page(result))):
        with replacing(out / name) as part:
            part.write_text(text, encoding="utf-8")
    print(f"{result.cases} benches; the score is in {out / 'laws.md'}")


def run(cases: Sequence[tuple[Kind, int]], store: Path, workers: int) -> Iterator[LawOutcome]:
    """The outcomes of these cases, those in the store first; of the code that is here."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(*each, code): (*each, here, code) for each in cases}
    return trials.run(
        wanted, law_outcome, LawOutcome, lambda it: (it.kind, it.number, it.code), store, workers
    )


if __name__ == "__main__":
    typer.run(main)
