"""Runs the benches that the study still lacks; each is kept as soon as it is done."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.sensitivity.trial import Trial, trial
from pipeline.provenance import code_digest, commit

Task = tuple[int, str, str]
FIRST, STEP, BENCHES = 3, 10, 60


def numbers(benches: int = BENCHES) -> Sequence[int]:
    """Every tenth case of the challenge, which have every kind."""
    return range(FIRST, FIRST + STEP * benches, STEP)


def run(benches: int, store: Path, workers: int) -> Iterator[Trial]:
    """The trials of so many benches, those in the store first; one counts for the code that it was made with."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(number, code): (number, here, code) for number in numbers(benches)}
    return trials.run(wanted, _one, Trial, lambda it: (it.number, it.code), store, workers)


def _one(task: Task) -> Trial:
    return trial(*task)
