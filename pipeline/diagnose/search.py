"""The sets of effects that explain a campaign: looked for to first order, fitted, grown and pruned.

One effect at a time is misled where one alone makes things worse, so pairs are looked at from the start, and every
set that competes is fitted with the full model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from pipeline.diagnose.estimates import Estimate, doubt, estimates
from pipeline.diagnose.exclusion import possible
from pipeline.diagnose.few_rows import few, grown_by_everything
from pipeline.diagnose.merit import cost, is_noise, root_of
from pipeline.diagnose.pruning import pruned
from pipeline.diagnose.rivals import Found, with_rivals
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.nominals import nominals
from pipeline.inference.solvers import allowance
from pipeline.inference.stops import sided
from vjm.work import TooMuch, spent


def singles(shelf: Shelf, root: Names) -> list[Names]:
    """A set, and those with one effect more that may turn out best: fitted."""
    return [root, *(e.names for e in _competing(shelf, root, 1))]


def singles_first(shelf: Shelf) -> list[Names]:
    """Those of the first root, a part of the search that follows and of what it may take; none where that is all."""
    shelf.ends = _end(shelf)
    try:
        return singles(shelf, first_root(shelf))
    except TooMuch:
        return []


def _end(shelf: Shelf) -> float:
    return spent() + shelf.criteria.search_work * allowance(shelf.whole)


def search_one_by_one(shelf: Shelf, root: Names, begun: Sequence[Names] = ()) -> Found:
    """The best single effect beside a set, and those that may as well be true: enough where something else comes before
    physics. begun: what `singles` found of it."""
    starts = list(begun) or singles(shelf, root)
    best = _best(shelf, starts)
    return Found(shelf, best, tuple(possible(shelf, starts, best)))


def first_root(shelf: Shelf) -> Names:
    """The first set of effects that are there or not from which a search looks on."""
    return _roots(shelf)[0]


def search(shelf: Shelf, begun: Sequence[Names] = ()) -> Found:
    """The best set, and those that may as well be true; what was fitted until then where that takes too long. begun:
    what `singles` found of the first root."""
    shelf.ends = min(shelf.ends, _end(shelf))
    try:
        return _searched(shelf, begun)
    except TooMuch:
        best = _best(shelf, list(shelf.fits))
        return Found(shelf, best, (), ended=True)
    finally:
        shelf.ends = np.inf


def _searched(shelf: Shelf, begun: Sequence[Names]) -> Found:
    roots = _roots(shelf)
    starts: list[Names] = [*roots, *begun]
    for root in roots:
        if not begun or root != roots[0]:
            starts += [e.names for e in _competing(shelf, root, 1)]
        if not any(is_noise(shelf, names) for names in starts):
            starts += _unforeseen(shelf, root)
        # Where one effect leaves noise, a second is looked for about that fit: to first order about the root, the
        # curvature of a large effect looks like another.
        if not any(is_noise(shelf, names) for names in starts):
            starts += [e.names for e in _competing(shelf, root, 2)]
    if few(shelf):
        starts += grown_by_everything(shelf, starts, roots)
    best = _built(shelf, _best(shelf, starts))
    if not is_noise(shelf, best):
        # What pairs about the root led to explains too little: the best effect alone may lead to more.
        alone = [names for names in starts if len(names - root_of(shelf, names)) == 1]
        one = _best(shelf, alone or [best])
        best = _built(shelf, _best(shelf, [best, *(e.names for e in _competing(shelf, one, 1))]))
    return Found(shelf, best, ()) if shelf.fit(best).rms > shelf.criteria.far else with_rivals(shelf, best)


def _unforeseen(shelf: Shelf, start: Names) -> list[Names]:
    """Far from an explanation, sets with one effect more of which rows choose the side, fitted where a look sees
    anything of it: what was written about the rig may explain most that it sees, and the rest, how far noise moves a
    row within a play, it does not see."""
    if shelf.fit(start).rms <= shelf.criteria.far or not nominals(shelf.whole.campaign):
        return []
    here = cost(shelf, start)
    some = [e for e in estimates(shelf, start, (1,)) if e.names != start and e.cost < here]
    some = [e for e in some if all(sided(shelf.candidates[name]) for name in e.names - start)]
    shelf.fit_all({e.names: e.probes for e in some})
    return [e.names for e in some]


def _best(shelf: Shelf, sets: Sequence[Names]) -> Names:
    return min(sets, key=lambda names: cost(shelf, names))


def _built(shelf: Shelf, best: Names) -> Names:
    """The best set that growth and pruning lead to from a set."""
    while True:
        better = pruned(shelf, _grown(shelf, best))
        if cost(shelf, better) >= cost(shelf, best):
            return best
        slow = shelf.fit(better).chi_square > shelf.criteria.slow * shelf.fit(best).chi_square
        best = better
        if slow and shelf.fit(best).rms > shelf.criteria.far:
            return best


def _switched(shelf: Shelf, start: Names) -> Names:
    """The best set with one more of those effects that are there or not; the same where noise is all that is left.

    To first order they have nothing to show, and beside what was not yet found they may have made things no better.
    """
    if is_noise(shelf, start):
        return start
    more = [start | {name} for name in _switches(shelf) if name not in start]
    shelf.fit_all({names: {} for names in more})
    return _best(shelf, [start, *more])


def _switches(shelf: Shelf) -> list[str]:
    return [name for name, effect in shelf.candidates.items() if not effect.parameters]


def _roots(shelf: Shelf) -> list[Names]:
    """Sets of effects that are there or not, from which to look on; one that promises far less is left out."""
    switches = _switches(shelf)
    roots = [frozenset(some) for k in range(len(switches) + 1) for some in combinations(switches, k)]
    least = min(shelf.fit(root).chi_square for root in roots)
    roots = [root for root in roots if shelf.fit(root).chi_square <= shelf.criteria.hopeless * least]
    if len(roots) == 1:
        return roots
    promise = {
        root: min(cost(shelf, root), *(e.cost for e in estimates(shelf, root, (1, 2)))) for root in roots
    }
    least = min(promise.values())
    gap = max(shelf.criteria.root_gap, shelf.criteria.root_share * abs(least))
    return [root for root in roots if promise[root] < least + gap]


def _competing(shelf: Shelf, start: Names, count: int) -> list[Estimate]:
    """Those sets that may turn out best: fitted."""
    here = cost(shelf, start)
    every = _looked_up(shelf, start, count)
    best = min([here, *(cost(shelf, n) for n in shelf.fits), *(e.cost for e in every)])
    hoped = {e.names: e.cost - doubt(shelf, e.names - start) * max(here - e.cost, 0.0) for e in every}
    within = [e for e in every if e.cost < here and hoped[e.names] < best + shelf.criteria.competing]
    within = sorted(within, key=lambda e: hoped[e.names])[: shelf.criteria.sets_fitted]
    # Far from an explanation the one that promises most is fitted first: others that stay far above it end soon.
    first = within[:1] if shelf.fit(start).rms > shelf.criteria.far else []
    for some in (first, within[len(first) :]):
        shelf.fit_all({e.names: e.probes for e in some})
    return within


def _looked_up(shelf: Shelf, start: Names, count: int) -> list[Estimate]:
    """Sets with so many further effects, to first order. Near an explanation without what probes promised of effects
    with kinks of which fits found nothing; far from one, an effect alone may be misled."""
    every = [e for e in estimates(shelf, start, {1, count}) if e.names != start]
    wanted = [e for e in every if len(e.names - start) == count]
    if count == 1 or shelf.fit(start).rms > shelf.criteria.far:
        return wanted
    vain = [e for e in every if e not in wanted and e.names in shelf.fits and not _smooth(shelf, e, start)]
    missed = {e.names: cost(shelf, e.names) - e.cost for e in vain}
    missed = {one: value for one, value in missed.items() if cost(shelf, one) >= cost(shelf, start)}
    return [replace(e, cost=e.cost + sum(v for one, v in missed.items() if one < e.names)) for e in wanted]


def _smooth(shelf: Shelf, e: Estimate, start: Names) -> bool:
    return all(shelf.candidates[name].smooth for name in e.names - start)


def _grown(shelf: Shelf, start: Names) -> Names:
    """The best set with one effect more, or two; the same if none is better."""
    criteria = shelf.criteria
    if len(start) >= criteria.most_effects or len(shelf.fits) >= criteria.most_fits:
        return start
    switched = _switched(shelf, start)
    if cost(shelf, switched) < cost(shelf, start):
        return switched
    here = shelf.fit(start)
    if here.rms > criteria.far and estimates(shelf, start, (1, 2))[0].cost > criteria.slow * here.chi_square:
        return start
    # Where noise is all that is left, two that show only together have nothing to show.
    counts = (1,) if is_noise(shelf, start) else (1, 2)
    return _best(shelf, [start, *(e.names for k in counts for e in _competing(shelf, start, k)[:2])])
