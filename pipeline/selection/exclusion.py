"""Which sets of effects the data speak against, and which may as well be true."""

from __future__ import annotations

import numpy as np

from pipeline.selection.cost import misfit, seen
from pipeline.selection.fit_cache import FitCache, Names


def possible(cache: FitCache, sets: list[Names], best: Names) -> list[Names]:
    """Of these sets those that may as well be true.

    Several that fit alike are excluded together or not at all: each weighs as its likelihood, and what all that are
    excluded weigh together is no more than one of them may.
    """
    others = [n for n in sets if not n <= best and not best < n]
    kept = [n for n in others if not excluded(cache, n, best)]
    kept = [n for n in kept if not any(other < n for other in kept)]
    gaps = {n: worse(cache, n, best) - needed(cache, n, best) for n in others if n not in kept}
    left = [
        n
        for n in gaps
        if not any(o < n for o in kept) and not any(o < n and gaps[o] <= gaps[n] for o in gaps)
    ]
    left.sort(key=lambda n: gaps[n])
    while left and sum(np.exp(-0.5 * gaps[n]) for n in left) > 1.0:
        kept.append(left.pop(0))
    return kept


def excluded(cache: FitCache, rival: Names, best: Names) -> bool:
    """Whether the data speak against a rival."""
    return worse(cache, rival, best) > max(cache.criteria.exclusion_least, needed(cache, rival, best))


def worse(cache: FitCache, rival: Names, best: Names) -> float:
    """Chi-square by which a rival is worse."""
    return misfit(cache, rival) - misfit(cache, best)


def needed(cache: FitCache, rival: Names, best: Names) -> float:
    """Chi-square by which a rival has to be worse to be excluded: what tells two sets of as many numbers apart, what
    the numbers take up that one of them has more, as far as the data see them, and where rows choose sides in one of
    them alone, by how much that varies."""
    more = seen(cache, best) - seen(cache, rival)
    return cache.criteria.apart(more) + abs(
        cache.fit(rival).residual.spread - cache.fit(best).residual.spread
    )
