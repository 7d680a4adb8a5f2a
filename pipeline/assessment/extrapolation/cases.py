"""The cases of the challenge of which predictions are made."""

from __future__ import annotations

from itertools import count, islice

from pipeline.assessment.challenge.cases import ROUND

KINDS = ("single", "pair")


def numbers(cases: int) -> list[int]:
    """The first so many cases of the challenge that hide effects of the catalogue."""
    return list(islice((n for n in count() if ROUND[n % len(ROUND)] in KINDS), cases))
