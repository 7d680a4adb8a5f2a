"""The sets of effects that do as well as the best one."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.diagnose.estimates import estimates, raw
from pipeline.diagnose.exclusion import possible
from pipeline.diagnose.few_rows import few, fit_together
from pipeline.diagnose.merit import badness, cost, excess, taken
from pipeline.diagnose.pruning import fit_from
from pipeline.diagnose.shelf import Names, Shelf


@dataclass(frozen=True, eq=False)
class Found:
    """What was found. best: the set of least cost. rivals: sets as simple that the data do not exclude. beyond: an
    effect of the best set that only tests held out show, "" if there is none. ended: whether the search ended before
    all that might compete was fitted, as it took too long."""

    shelf: Shelf
    best: Names
    rivals: tuple[Names, ...]
    beyond: str = ""
    ended: bool = False


def with_rivals(shelf: Shelf, best: Names) -> Found:
    """Every effect of the set is exchanged for every other; those that do as well are rivals.

    A set that leaves more than noise explains nothing, and then others are of use that may: only those are fitted.
    """
    criteria, small = shelf.criteria, few(shelf)
    beyond = 0.0 if small else excess(shelf, best)
    share = criteria.few_rival_share if small else criteria.estimate_error
    without = [best - {name} for name in best if shelf.candidates[name].parameters]
    shelf.fit_all({names: {} for names in without})
    fit_from(shelf, best)
    wanted: dict[Names, dict[str, float]] = {}
    for start in without:
        gap = cost(shelf, start) - cost(shelf, best)
        limit = cost(shelf, best) - beyond + max(criteria.rival_gap, share * gap)
        near = [
            e for e in estimates(shelf, start, (1,)) if e.names not in (start, best) and raw(shelf, e) < limit
        ]
        wanted |= {e.names: e.probes for e in near[: None if small else criteria.rivals_fitted]}
    shelf.fit_all(wanted)
    if small:
        fit_together(shelf, best)
    winner = min(shelf.fits, key=lambda names: cost(shelf, names))
    if winner != best:
        return with_rivals(shelf, winner)
    simple = [n for n in shelf.fits if len(n) <= len(best) or taken(shelf, n) <= taken(shelf, best)]
    return Found(shelf, best, tuple(sorted(possible(shelf, simple, best), key=lambda n: badness(shelf, n))))
