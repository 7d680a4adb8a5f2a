"""Runs the cases that the study still lacks; each is kept as soon as it is done."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.extrapolation.study import numbers
from pipeline.assessment.prediction.trial import Trial, trial
from pipeline.provenance import commit

Task = tuple[int, str, bool]


def run(cases: int, store: Path, workers: int, tolerances: bool = False) -> Iterator[Trial]:
    """The trials of the first so many cases of the challenge that hide effects, those in the store first; tolerances
    as in `measured`."""
    here = commit()
    wanted: Mapping[Hashable, Task] = {number: (number, here, tolerances) for number in numbers(cases)}
    return trials.run(wanted, _one, Trial, lambda it: it.number, store, workers)


def _one(task: Task) -> Trial:
    return trial(*task)
