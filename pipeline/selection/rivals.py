"""The sets of effects that do as well as the best one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from pipeline.selection.cost import cost, excess, misfit, taken
from pipeline.selection.exclusion import possible
from pipeline.selection.few_rows import few, fit_together
from pipeline.selection.first_order_costs import estimates, raw
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.pruning import fit_from
from vjm.effects.sensor_fault import SensorFault


@dataclass(frozen=True, eq=False)
class Found:
    """What was found. best: the set of least cost. rivals: sets as simple that the data do not exclude. beyond: an
    effect of the best set that only tests held out show, "" if there is none. ended: whether the search ended before
    all that might compete was fitted, as it took too long."""

    cache: FitCache
    best: Names
    rivals: tuple[Names, ...]
    beyond: str = ""
    ended: bool = False


def with_rivals(cache: FitCache, best: Names) -> Found:
    """Every effect of the set is exchanged for every other; those that do as well are rivals.

    A set that leaves more than noise explains nothing, and then others are of use that may: only those are fitted.
    """
    criteria, small = cache.criteria, few(cache)
    beyond = 0.0 if small else excess(cache, best)
    share = criteria.few_rival_share if small else criteria.estimate_error
    without = [best - {name} for name in best if cache.candidates[name].parameters]
    cache.fit_all({names: {} for names in without})
    fit_from(cache, best)
    wanted: dict[Names, dict[str, float]] = {}
    for start in without:
        gap = cost(cache, start) - cost(cache, best)
        limit = cost(cache, best) - beyond + max(criteria.rival_gap, share * gap)
        near = [
            e for e in estimates(cache, start, (1,)) if e.names not in (start, best) and raw(cache, e) < limit
        ]
        wanted |= {e.names: e.probes for e in near[: None if small else criteria.rivals_fitted]}
    wanted |= {names: {} for names in _same_sensor(cache, best) if names not in wanted}
    cache.fit_all(wanted)
    if small:
        fit_together(cache, best)
    winner = min(cache.fits, key=lambda names: cost(cache, names))
    if winner != best:
        return with_rivals(cache, winner)
    simple = [n for n in cache.fits if len(n) <= len(best) or taken(cache, n) <= taken(cache, best)]
    return Found(cache, best, tuple(sorted(possible(cache, simple, best), key=lambda n: misfit(cache, n))))


def _same_sensor(cache: FitCache, best: Names) -> Iterator[Names]:
    """The set with another fault of the same sensor in the place of one: to first order a late sensor and one with
    backlash are far from what they are."""
    faults = {name: it.column for name, it in cache.candidates.items() if isinstance(it, SensorFault)}
    for name in best & faults.keys():
        for other in faults.keys() - best:
            if faults[other] == faults[name]:
                yield best - {name} | {other}
