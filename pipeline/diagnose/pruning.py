"""What a set of effects no longer needs, by their own numbers and by fits without them."""

from __future__ import annotations

import numpy as np

from pipeline.diagnose.merit import badness, cost, price, root_of
from pipeline.diagnose.shelf import Names, Shelf


def pruned(shelf: Shelf, names: Names) -> Names:
    """The set without what is no longer needed."""
    while names:
        fewer = [names - {name} for name in names if _dispensable(shelf, names, name)]
        _fit_fewer(shelf, names, [each for each in fewer if each not in shelf.fits])
        fit_from(shelf, names)
        best = min(fewer, key=lambda each: cost(shelf, each), default=names)
        if not fewer or cost(shelf, best) > cost(shelf, names):
            return names
        names = best
    return names


def _fit_fewer(shelf: Shelf, names: Names, fewer: list[Names]) -> None:
    """Fit sets without one of the effects from where the whole set stands, which takes least; those that this does not
    show to be good or far from it as if there were no larger set."""
    shelf.fit_again(fewer, names)
    most = shelf.criteria.refit_near * shelf.least(names)
    shelf.fit_anew(
        [n for n in fewer if cost(shelf, n) > cost(shelf, names) and shelf.fit(n).chi_square < most]
    )


def fit_from(shelf: Shelf, names: Names) -> None:
    """Fit the sets without one of these effects again, from where this set stands, where they seem to need it more
    than its own numbers say; those that were fitted.

    Where rows choose their sides, or laws remember, a fit has many valleys, some 30 of chi-square apart. One that
    is deeper by chance would make a name of an effect that takes no part in it.
    """
    again = []
    for name in names:
        fewer = names - {name}
        if fewer not in shelf.fits or not shelf.candidates[name].parameters:
            continue
        gap, said = badness(shelf, fewer) - badness(shelf, names), _said(shelf, names, name)
        if cost(shelf, fewer) > cost(shelf, names) and said < shelf.criteria.needless * price(shelf, [name]):
            again += [fewer] if gap > shelf.criteria.elsewhere * said + shelf.criteria.elsewhere_least else []
    shelf.fit_again(again, names)


def _dispensable(shelf: Shelf, names: Names, name: str) -> bool:
    """Whether an effect, by its own numbers and their covariance, explains no more than a few times its price, many
    times if it has kinks.

    One that is there or not is, unless its root would be hopeless without it, or the set far off.
    """
    if not shelf.candidates[name].parameters:
        root = root_of(shelf, names)
        if shelf.fit(root - {name}).chi_square >= shelf.criteria.hopeless * shelf.fit(root).chi_square:
            return False
        return names - {name} in shelf.fits or shelf.left_without(names, name) < shelf.criteria.far_off
    smooth = shelf.candidates[name].smooth
    most = shelf.criteria.needless if smooth else shelf.criteria.kinked_needless
    return _said(shelf, names, name) < most * price(shelf, [name])


def _said(shelf: Shelf, names: Names, name: str) -> float:
    """Chi-square that an effect explains by its own numbers and their covariance; 0 where the data say nothing."""
    found = shelf.fit(names)
    mine = np.array([each.effect == name for each in found.model.free], dtype=bool)
    null = np.array([each.parameter.null for each in found.model.free])
    away = (found.model.values - null)[mine]
    covariance = found.covariance[np.ix_(mine, mine)]
    known = np.isfinite(np.diag(covariance))
    if not known.any():
        return 0.0
    inner = covariance[np.ix_(known, known)]
    return float(away[known] @ np.linalg.solve(inner, away[known]))
