"""The sets of effects that explain a campaign: looked for to first order, fitted, grown and pruned.

One effect at a time is misled where one alone makes things worse, so pairs are looked at from the start, and every
set that competes is fitted with the full model.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations

import numpy as np

from pipeline.inference.nuisances import nominals
from pipeline.inference.stops import sided
from pipeline.selection.allotted import for_exchange
from pipeline.selection.cost import cost, is_noise, root_of
from pipeline.selection.exclusion import possible
from pipeline.selection.few_rows import few, grown_by_everything
from pipeline.selection.first_order_costs import Estimate, doubt, estimates
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.pruning import pruned
from pipeline.selection.rivals import Found, with_rivals
from vjm.work import TooMuch, spent


def singles(cache: FitCache, root: Names) -> list[Names]:
    """A set, and those with one effect more that may turn out best: fitted."""
    return [root, *(e.names for e in _competing(cache, root, 1))]


def singles_first(cache: FitCache) -> list[Names]:
    """Those of the first root, a part of the search that follows and of what it may take; none where that is all."""
    cache.ends = spent() + cache.work
    try:
        return singles(cache, first_root(cache))
    except TooMuch:
        return []


def search_one_by_one(cache: FitCache, root: Names, begun: Sequence[Names] = ()) -> Found:
    """The best single effect beside a set, and those that may as well be true: enough where something else comes before
    physics. begun: what `singles` found of it."""
    starts = list(begun) or singles(cache, root)
    best = _best(cache, starts)
    return Found(cache, best, tuple(possible(cache, starts, best)))


def first_root(cache: FitCache) -> Names:
    """The first set of effects that are there or not from which a search looks on."""
    return _roots(cache)[0]


def search(cache: FitCache, begun: Sequence[Names] = ()) -> Found:
    """The best set, and those that may as well be true; what was fitted until then where that takes too long. begun:
    what `singles` found of the first root."""
    cache.ends = min(cache.ends, spent() + cache.work)
    try:
        return _searched(cache, begun)
    except TooMuch:
        best = _best(cache, list(cache.fits))
        return Found(cache, best, (), ended=True)
    finally:
        cache.ends = np.inf


def _searched(cache: FitCache, begun: Sequence[Names]) -> Found:
    roots = _roots(cache)
    starts: list[Names] = [*roots, *begun]
    for root in roots:
        if not begun or root != roots[0]:
            starts += [e.names for e in _competing(cache, root, 1)]
        if not any(is_noise(cache, names) for names in starts):
            starts += _unforeseen(cache, root)
        # Where one effect leaves noise, a second is looked for about that fit: to first order about the root, the
        # curvature of a large effect looks like another.
        if not any(is_noise(cache, names) for names in starts):
            starts += [e.names for e in _competing(cache, root, 2)]
    if few(cache):
        starts += grown_by_everything(cache, starts, roots)
    best = _built(cache, _best(cache, starts))
    if not is_noise(cache, best):
        # What pairs about the root led to explains too little: the best effect alone may lead to more.
        alone = [names for names in starts if len(names - root_of(cache, names)) == 1]
        one = _best(cache, alone or [best])
        best = _built(cache, _best(cache, [best, *(e.names for e in _competing(cache, one, 1))]))
        best = _exchanged(cache, best)
    return Found(cache, best, ()) if cache.fit(best).rms > cache.criteria.far else with_rivals(cache, best)


def _unforeseen(cache: FitCache, start: Names) -> list[Names]:
    """Far from an explanation what was written about the rig may explain most that a look sees of a play, and the rest,
    how far noise moves a row within it, it does not see."""
    far = cache.fit(start).rms > cache.criteria.far and nominals(cache.whole.campaign)
    return _sided(cache, start) if far else []


def _sided(cache: FitCache, start: Names) -> list[Names]:
    """Sets with one effect more of which rows choose the side, where a look sees anything of it: fitted."""
    here = cost(cache, start)
    some = [e for e in estimates(cache, start, (1,)) if e.names != start and e.cost < here]
    some = [e for e in some if all(sided(cache.candidates[name]) for name in e.names - start)]
    cache.fit_all({e.names: e.probes for e in some})
    return [e.names for e in some]


def _best(cache: FitCache, sets: Sequence[Names]) -> Names:
    return min(sets, key=lambda names: cost(cache, names))


def _built(cache: FitCache, best: Names) -> Names:
    """The best set that growth and pruning lead to from a set."""
    while True:
        better = pruned(cache, _grown(cache, best))
        if cost(cache, better) >= cost(cache, best):
            return best
        slow = cache.fit(better).chi_square > cache.criteria.slow * cache.fit(best).chi_square
        best = better
        if slow and cache.fit(best).rms > cache.criteria.far:
            return best


def _exchanged(cache: FitCache, best: Names) -> Names:
    """The best set with one effect in the place of another, as long as more than noise is left: the first effects of a
    set may be those that look most like several others together (A. J. Miller, Subset Selection in Regression, 2nd ed.,
    2002, section 3.4). What was found until then where that takes too long."""
    with suppress(TooMuch), for_exchange(cache):
        while not is_noise(cache, best) and len(cache.fits) < cache.criteria.most_fits:
            own = best - root_of(cache, best)
            starts = [best - {n} - {m for m in own if n in cache.candidates[m].includes} for n in sorted(own)]
            others = [e.names for start in starts if len(own) > 1 for e in _competing(cache, start, 1)[:2]]
            kinked = [names for start in starts if len(own) > 1 for names in _sided(cache, start)]
            better = _best(cache, [best, *others, *kinked])
            if better == best:
                break
            best = _built(cache, better)
    return _best(cache, [best, *cache.fits])


def _switched(cache: FitCache, start: Names) -> Names:
    """The best set with one more of those effects that are there or not; the same where noise is all that is left.

    To first order they have nothing to show, and beside what was not yet found they may have made things no better.
    """
    if is_noise(cache, start):
        return start
    more = [start | {name} for name in _switches(cache) if name not in start]
    cache.fit_all({names: {} for names in more})
    return _best(cache, [start, *more])


def _switches(cache: FitCache) -> list[str]:
    return [name for name, effect in cache.candidates.items() if not effect.parameters]


def _roots(cache: FitCache) -> list[Names]:
    """Sets of effects that are there or not, from which to look on; one that promises far less is left out."""
    switches = _switches(cache)
    roots = [frozenset(some) for k in range(len(switches) + 1) for some in combinations(switches, k)]
    least = min(cache.fit(root).chi_square for root in roots)
    roots = [root for root in roots if cache.fit(root).chi_square <= cache.criteria.hopeless * least]
    if len(roots) == 1:
        return roots
    promise = {
        root: min(cost(cache, root), *(e.cost for e in estimates(cache, root, (1, 2)))) for root in roots
    }
    least = min(promise.values())
    gap = max(cache.criteria.root_gap, cache.criteria.root_share * abs(least))
    return [root for root in roots if promise[root] < least + gap]


def _competing(cache: FitCache, start: Names, count: int) -> list[Estimate]:
    """Those sets that may turn out best: fitted."""
    here = cost(cache, start)
    every = _looked_up(cache, start, count)
    best = min([here, *(cost(cache, n) for n in cache.fits), *(e.cost for e in every)])
    hoped = {e.names: e.cost - doubt(cache, e.names - start) * max(here - e.cost, 0.0) for e in every}
    within = [e for e in every if e.cost < here and hoped[e.names] < best + cache.criteria.competing]
    within = sorted(within, key=lambda e: hoped[e.names])[: cache.criteria.sets_fitted]
    # Far from an explanation the one that promises most is fitted first: others that stay far above it end soon.
    first = within[:1] if cache.fit(start).rms > cache.criteria.far else []
    for some in (first, within[len(first) :]):
        cache.fit_all({e.names: e.probes for e in some})
    return within


def _looked_up(cache: FitCache, start: Names, count: int) -> list[Estimate]:
    """Sets with so many further effects, to first order. Near an explanation without what probes promised of effects
    with kinks of which fits found nothing; far from one, an effect alone may be misled."""
    every = [e for e in estimates(cache, start, {1, count}) if e.names != start]
    wanted = [e for e in every if len(e.names - start) == count]
    if count == 1 or cache.fit(start).rms > cache.criteria.far:
        return wanted
    vain = [
        e
        for e in every
        if e not in wanted
        and e.names in cache.fits
        and any(not cache.candidates[n].smooth for n in e.names - start)
    ]
    missed = {e.names: cost(cache, e.names) - e.cost for e in vain}
    missed = {one: value for one, value in missed.items() if cost(cache, one) >= cost(cache, start)}
    return [replace(e, cost=e.cost + sum(v for one, v in missed.items() if one < e.names)) for e in wanted]


def _grown(cache: FitCache, start: Names) -> Names:
    """The best set with one effect more, or two; the same if none is better."""
    criteria = cache.criteria
    if len(start) >= criteria.most_effects or len(cache.fits) >= criteria.most_fits:
        return start
    switched = _switched(cache, start)
    if cost(cache, switched) < cost(cache, start):
        return switched
    here = cache.fit(start)
    if here.rms > criteria.far and estimates(cache, start, (1, 2))[0].cost > criteria.slow * here.chi_square:
        return start
    # Where noise is all that is left, two that show only together have nothing to show.
    counts = (1,) if is_noise(cache, start) else (1, 2)
    return _best(cache, [start, *(e.names for k in counts for e in _competing(cache, start, k)[:2])])
