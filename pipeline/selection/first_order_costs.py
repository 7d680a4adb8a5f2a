"""Sets of effects that could be fitted, and what each would cost to first order."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

from pipeline.selection.cost import cost, price
from pipeline.selection.fit_cache import FitCache, Names


@dataclass(frozen=True)
class Estimate:
    """A set that could be fitted: to first order its cost, and where effects with kinks begin."""

    names: Names
    cost: float
    probes: dict[str, float]


def estimates(cache: FitCache, start: Names, counts: Iterable[int]) -> list[Estimate]:
    """Sets with so many further effects, to first order, best first; always at least one."""
    found = cache.first_order(start)
    every = [name for name in found.signatures if start >= set(cache.candidates[name].includes)]
    base = cost(cache, start)
    single = {name: found.gain([name]) for name in every}
    leaders = sorted(single, key=lambda name: -single[name].value)[: cache.criteria.leaders]
    out = [Estimate(start, base, {})]
    for count in counts:
        groups = [(n,) for n in single] if count == 1 else list(combinations(leaders, count))
        for group in groups:
            if not cache.affords(start | set(group)):
                continue
            gain = single[group[0]] if count == 1 else found.gain(group)
            out.append(Estimate(start | set(group), base - gain.value + price(cache, group), gain.probes))
    return sorted(out, key=lambda e: e.cost)


def doubt(cache: FitCache, names: Names) -> float:
    """Part of what these effects explain by which the estimate may be wrong."""
    smooth = all(cache.candidates[name].smooth for name in names)
    return cache.criteria.estimate_error if smooth else cache.criteria.kinked_estimate_error


def raw(cache: FitCache, e: Estimate) -> float:
    """Cost without the advantage of having few numbers."""
    return e.cost - price(cache, e.names) + min(price(cache, [n]) for n in e.names) * len(e.names)
