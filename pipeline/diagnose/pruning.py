"""What a set of effects no longer needs, by their own numbers and by fits without them."""

from __future__ import annotations

import numpy as np

from pipeline.diagnose.merit import badness, cost, price, root_of
from pipeline.diagnose.shelf import Names, Shelf

HOPELESS = 300.0
"""Times the least chi-square of the roots, beyond which a root is left out unseen."""
FAR_OFF = 5.0
"""Times the chi-square of a fit, or of noise, that the same numbers, smooth ones moved by a linear step, leave without
an effect that is there or not: then it is needed. The fit itself takes longest where it ends far from all noise."""
NEAR = 1.5
"""Times the chi-square of a set, or of noise, that one without an effect of it leaves, at most, to be fitted twice."""
NEEDLESS = 4.0
"""Times what it has to show: an effect that by its own numbers explains less may not be needed."""
CERTAIN = 100.0
"""The same of an effect with kinks, whose numbers say less: sets without it are tried up to there."""
MORE, BY = 2.0, 2.0
"""An effect should cost a fit what its own numbers say; so many times that and so much of chi-square, and the fit
without it has ended elsewhere."""


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
    most = NEAR * shelf.least(names)
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
        if cost(shelf, fewer) > cost(shelf, names) and said < NEEDLESS * price(shelf, [name]):
            again += [fewer] if gap > MORE * said + BY else []
    shelf.fit_again(again, names)


def _dispensable(shelf: Shelf, names: Names, name: str) -> bool:
    """Whether an effect, by its own numbers and their covariance, explains no more than a few times its price, many
    times if it has kinks.

    One that is there or not is, unless its root would be hopeless without it, or the set far off.
    """
    if not shelf.candidates[name].parameters:
        root = root_of(shelf, names)
        if shelf.fit(root - {name}).chi_square >= HOPELESS * shelf.fit(root).chi_square:
            return False
        return names - {name} in shelf.fits or shelf.left_without(names, name) < FAR_OFF
    most = NEEDLESS if shelf.candidates[name].smooth else CERTAIN
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
