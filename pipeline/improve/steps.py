"""The way from a model to what its diagnosis is certain of: one effect a step, what explains most first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from pipeline.answer.record import ModelError
from pipeline.answer.summary import error_of
from pipeline.inference.fit import Fit
from pipeline.selection.cost import root_of
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.fit_cache import Names


@dataclass(frozen=True, eq=False)
class Step:
    """A model on the way; added: the effect that the step before had not, "" for the first."""

    added: str
    fit: Fit
    error: ModelError


def certain(it: Diagnosis) -> Names:
    """Effects to be added: all of one set; of several what all share and is certain besides, for a sensor's fault that
    all share may stand for a law that none of them is; none of the unknown."""
    if it.verdict not in ("identified", "ambiguous"):
        return frozenset()
    shared = frozenset.intersection(*(frozenset(names) for names in it.possible))
    if it.verdict == "identified":
        return shared
    # What is there or not has no number that could be another's.
    return root_of(it.cache, shared) | (shared & frozenset(it.certain))


def steps(it: Diagnosis) -> Iterator[Step]:
    """The model as it was, then with one certain effect more at a time."""
    cache, goal = it.cache, certain(it)
    here: Names = frozenset()
    yield _step(it, "", here)
    while here != goal:
        ahead = [here | {name} for name in goal - here if _possible(it, name, here)]
        best = min(ahead or [goal], key=lambda names: cache.fit(names).chi_square)
        yield _step(it, " + ".join(cache.order(best - here)), best)
        here = best


def _possible(it: Diagnosis, name: str, here: Names) -> bool:
    """Whether an effect may be added now: what it cannot be without is there."""
    needed = set(it.cache.candidates[name].includes)
    return needed <= here | set(it.cache.base.names)


def _step(it: Diagnosis, added: str, names: Names) -> Step:
    # Of what was identified, numbers that nothing determines are no part.
    settled = it.verdict == "identified" and names == it.decision.sets[0]
    found = it.fit if settled else it.cache.fit(names)
    return Step(added, found, error_of(found, it.cache.whole, found.numbers))
