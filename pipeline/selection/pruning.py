"""What a set of effects no longer needs, by their own numbers and by fits without them."""

from __future__ import annotations

import numpy as np

from pipeline.selection.cost import cost, misfit, price, root_of
from pipeline.selection.fit_cache import FitCache, Names


def pruned(cache: FitCache, names: Names) -> Names:
    """The set without what is no longer needed."""
    while names:
        fewer = [names - {name} for name in names if _dispensable(cache, names, name)]
        _fit_fewer(cache, names, [each for each in fewer if each not in cache.fits])
        fit_from(cache, names)
        best = min(fewer, key=lambda each: cost(cache, each), default=names)
        if not fewer or cost(cache, best) > cost(cache, names):
            return names
        names = best
    return names


def _fit_fewer(cache: FitCache, names: Names, fewer: list[Names]) -> None:
    """Fit sets without one of the effects from where the whole set stands, which takes least; those that this does not
    show to be good or far from it as if there were no larger set."""
    cache.fit_again(fewer, names)
    most = cache.criteria.refit_near * cache.least(names)
    cache.fit_anew(
        [n for n in fewer if cost(cache, n) > cost(cache, names) and cache.fit(n).chi_square < most]
    )


def fit_from(cache: FitCache, names: Names) -> None:
    """Fit the sets without one of these effects again, from where this set stands, where they seem to need it more
    than its own numbers say; those that were fitted.

    Where rows choose their sides, or laws remember, a fit has many valleys, some 30 of chi-square apart. One that
    is deeper by chance would make a name of an effect that takes no part in it.
    """
    again = []
    for name in names:
        fewer = names - {name}
        if fewer not in cache.fits or not cache.candidates[name].parameters:
            continue
        gap, said = misfit(cache, fewer) - misfit(cache, names), _said(cache, names, name)
        if cost(cache, fewer) > cost(cache, names) and said < cache.criteria.needless * price(cache, [name]):
            again += [fewer] if gap > cache.criteria.elsewhere * said + cache.criteria.elsewhere_least else []
    cache.fit_again(again, names)


def _dispensable(cache: FitCache, names: Names, name: str) -> bool:
    """Whether an effect, by its own numbers and their covariance, explains no more than a few times its price, many
    times if it has kinks.

    One that is there or not is, unless its root would be hopeless without it, or the set far off.
    """
    if not cache.candidates[name].parameters:
        root = root_of(cache, names)
        if cache.fit(root - {name}).chi_square >= cache.criteria.hopeless * cache.fit(root).chi_square:
            return False
        return names - {name} in cache.fits or cache.left_without(names, name) < cache.criteria.far_off
    smooth = cache.candidates[name].smooth
    most = cache.criteria.needless if smooth else cache.criteria.kinked_needless
    return _said(cache, names, name) < most * price(cache, [name])


def _said(cache: FitCache, names: Names, name: str) -> float:
    """Chi-square that an effect explains by its own numbers and their covariance; 0 where the data say nothing."""
    found = cache.fit(names)
    mine = np.array([each.effect == name for each in found.model.free], dtype=bool)
    null = np.array([each.parameter.null for each in found.model.free])
    away = (found.model.values - null)[mine]
    covariance = found.covariance[np.ix_(mine, mine)]
    known = np.isfinite(np.diag(covariance))
    if not known.any():
        return 0.0
    typical = np.array([abs(each.parameter.typical) for each in found.model.free])[mine][known]
    inner = covariance[np.ix_(known, known)] / np.outer(typical, typical)
    # Numbers of one effect may be known in some combinations alone.
    return float(away[known] / typical @ np.linalg.pinv(inner, hermitian=True) @ (away[known] / typical))
