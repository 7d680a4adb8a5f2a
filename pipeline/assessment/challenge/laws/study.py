"""Runs the cases with laws that a score still lacks; each outcome is kept as soon as it is known."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.challenge.laws.cases import Kind
from pipeline.assessment.challenge.laws.outcome import LawOutcome, law_outcome
from pipeline.provenance import code_digest, commit

Task = tuple[Kind, int, str, str]


def run(cases: Sequence[tuple[Kind, int]], store: Path, workers: int) -> Iterator[LawOutcome]:
    """The outcomes of these cases, those in the store first; of the code that is here."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(*each, code): (*each, here, code) for each in cases}
    return trials.run(wanted, _one, LawOutcome, lambda it: (it.kind, it.number, it.code), store, workers)


def _one(task: Task) -> LawOutcome:
    return law_outcome(*task)
