"""Runs the cases that the study still lacks; each is kept as soon as it is done."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from itertools import count, islice
from pathlib import Path

from pipeline.assessment import trials
from pipeline.assessment.challenge.cases import ROUND
from pipeline.assessment.extrapolation.trial import Trial, trial
from pipeline.provenance import code_digest, commit

Task = tuple[int, str, str]
KINDS = ("single", "pair")


def numbers(cases: int) -> list[int]:
    """The first so many cases of the challenge that hide effects of the catalogue."""
    return list(islice((n for n in count() if ROUND[n % len(ROUND)] in KINDS), cases))


def run(cases: int, store: Path, workers: int) -> Iterator[Trial]:
    """The trials of these cases, those in the store first; one counts for the code that it was made with."""
    here, code = commit(), code_digest()
    wanted: dict[Hashable, Task] = {(number, code): (number, here, code) for number in numbers(cases)}
    return trials.run(wanted, trial, Trial, lambda it: (it.number, it.code), store, workers)
