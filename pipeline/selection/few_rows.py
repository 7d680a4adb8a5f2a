"""With few rows a fit costs little, and what is far from a solution is too curved for first-order estimates: sets are
grown by everything, side by side.
"""

from __future__ import annotations

from pipeline.selection.cost import cost, is_noise, root_of, taken
from pipeline.selection.first_order_costs import estimates
from pipeline.selection.fit_cache import FitCache, Names


def few(cache: FitCache) -> bool:
    """Whether no more rows are fitted than that."""
    return int(cache.whole.fitted.sum()) <= cache.criteria.few_steps


def leading(cache: FitCache, sets: set[Names]) -> list[Names]:
    """The best of these sets, as many as are grown side by side: where every row is lost no slope says by what."""
    rows = cache.whole.fitted
    able = [names for names in sets if not cache.fit(names).prediction.lost[rows].all()]
    return sorted(able, key=lambda names: cost(cache, names))[: cache.criteria.few_sets]


def grown_by_everything(cache: FitCache, starts: list[Names], roots: list[Names]) -> list[Names]:
    """The best sets of every root that explains nothing yet, with one effect more: what the best root is shows then."""
    grown: list[Names] = []
    for root in roots:
        like = {root, *(names for names in (*starts, *grown) if root_of(cache, names) == root)}
        if any(is_noise(cache, names) for names in like):
            continue
        for names in leading(cache, like - {root}):
            grown += [e.names for e in estimates(cache, names, (1,)) if e.names != names]
    return grown


def fit_together(cache: FitCache, best: Names) -> None:
    """Fit those that explain only together and take no more numbers than the best set: one of many numbers, that is
    looked at alone, would hide them."""
    root, room = root_of(cache, best), taken(cache, best)
    begun = {
        n
        for n in cache.fits
        if n != root and root_of(cache, n) == root and taken(cache, n) < room and not is_noise(cache, n)
    }
    for start in leading(cache, begun):
        for e in estimates(cache, start, (1,)):
            if e.names != start and taken(cache, e.names) <= room:
                cache.fit(e.names, e.probes)
