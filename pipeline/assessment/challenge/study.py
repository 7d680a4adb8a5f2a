"""Runs the cases that a score still lacks; each outcome is kept as soon as it is known."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.challenge.outcome import Outcome, outcome
from pipeline.provenance import code_digest, commit

Task = tuple[int, str, str]


def run(numbers: Sequence[int], store: Path, workers: int) -> Iterator[Outcome]:
    """The outcomes of these cases, those in the store first. Numbers, not the order of work, decide what a case is.

    An outcome counts for the code that it was made with: a score is that of one program.
    """
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(number, code): (number, here, code) for number in numbers}
    return trials.run(wanted, _one, Outcome, lambda it: (it.number, it.code), store, workers)


def _one(task: Task) -> Outcome:
    return outcome(*task)
