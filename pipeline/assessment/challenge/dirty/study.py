"""Runs the dirty cases that a score still lacks; each outcome is kept as soon as it is known."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.challenge.dirty.outcome import DirtyOutcome, dirty_outcome
from pipeline.provenance import code_digest, commit

Task = tuple[int, str, str]


def run(numbers: Sequence[int], store: Path, workers: int) -> Iterator[DirtyOutcome]:
    """The outcomes of these cases, those in the store first; of the code that is here."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(number, code): (number, here, code) for number in numbers}
    return trials.run(wanted, _one, DirtyOutcome, lambda it: (it.number, it.code), store, workers)


def _one(task: Task) -> DirtyOutcome:
    return dirty_outcome(*task)
