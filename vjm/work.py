"""How much work equilibria took, in evaluations of their equations: the same on every machine, as seconds are not.

That of a parallelogram with lumped bars at one load case is one; longer bars count by their unknowns, a batch as one
and one more for every `MEMBERS` load cases. Counted in each thread by itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import inf
from threading import local

UNKNOWNS = 34
"""Of that parallelogram."""
MEMBERS = 50
"""Load cases of a batch whose arrays take as long as the calls that a step is made of."""


class TooMuch(RuntimeError):
    """More work than was allowed; load cases without an equilibrium, each approached in vain, take most of it."""


class _Count(local):
    steps, most, ends = 0.0, inf, inf


_count = _Count()


def note(members: int, unknowns: int) -> None:
    """Count an evaluation at so many load cases with so many unknowns each. TooMuch beyond what `at_most` allows."""
    elsewhere(unknowns / UNKNOWNS * (1.0 + members / MEMBERS))


def spent() -> float:
    """Evaluations of this thread so far."""
    return _count.steps


def elsewhere(steps: float) -> None:
    """Count work that another process took for this one; as `note`."""
    _count.steps += steps
    if _count.steps > _count.most:
        raise TooMuch("it would take too long")


def over() -> bool:
    """Whether what `within` allows is used up: nothing new is begun, and what was found until then is kept."""
    return _count.steps > _count.ends


@contextmanager
def within(steps: float) -> Iterator[None]:
    """In it, `over` after that many evaluations more, or sooner inside another one."""
    before = _count.ends
    _count.ends = min(before, _count.steps + steps)
    try:
        yield
    finally:
        _count.ends = before


@contextmanager
def at_most(steps: float) -> Iterator[None]:
    """Within it, more evaluations than that raise TooMuch."""
    before = _count.most
    _count.most = min(before, _count.steps + steps)
    try:
        yield
    finally:
        _count.most = before
