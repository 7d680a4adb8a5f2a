"""Cases of the challenge that cost little, found by what they are: their numbers change with its seed."""

from __future__ import annotations

from itertools import count

from pipeline.assessment.challenge.cases import Case, Kind, case
from vjm.effects import catalogue

ROWS = 84


def first(kind: Kind, effect: str = "", least: float = 0.0) -> int:
    """Number of the first case of at most `ROWS` rows: of that kind, with that effect hidden, its first number at
    least so far from null."""
    return next(n for n in count() if _fits(case(n), kind, effect, least))


def _fits(it: Case, kind: Kind, effect: str, least: float) -> bool:
    if it.kind != kind or sum(len(test.values) for test in it.bench.plan) > ROWS:
        return False
    if not effect:
        return True
    number = catalogue()[effect].parameters[0]
    return it.effects == (effect,) and abs(it.hidden[f"{effect}.{number.name}"] - number.null) >= least
