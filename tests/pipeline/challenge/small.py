"""Cases of the challenge that cost little, found by what they are: their numbers change with its seed."""

from __future__ import annotations

from itertools import count

from pipeline.challenge.cases import Case, Kind, case

ROWS = 84


def first(kind: Kind, effect: str = "", least: float = 0.0) -> int:
    """Number of the first case of at most `ROWS` rows: of that kind, with that effect hidden, its first number at
    least so many from one."""
    return next(n for n in count() if _fits(case(n), kind, effect, least))


def _fits(it: Case, kind: Kind, effect: str, least: float) -> bool:
    few = sum(len(test.values) for test in it.bench.plan) <= ROWS
    there = not effect or it.effects == (effect,)
    return (
        few and it.kind == kind and there and all(abs(v - 1.0) >= least for v in list(it.hidden.values())[:1])
    )
