"""Forward selection by AIC: the effect that lowers it most is added, until none does.

H. Akaike, IEEE Transactions on Automatic Control 19 (1974), 716-723. With known sigmas AIC is chi-square and two for
each fitted number, but for a constant.
"""

from __future__ import annotations

from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.stops import SIDE, sided
from pipeline.selection.criteria import CRITERIA


def forward(shelf: Shelf) -> Names:
    """The effects that are added to the base model, one at a time."""
    here: Names = frozenset()
    while True:
        better = _added(shelf, here)
        if not aic(shelf, better) < aic(shelf, here):
            return here
        here = better


def aic(shelf: Shelf, names: Names) -> float:
    """Of the base model with these effects at its best fit."""
    found = shelf.fit(names)
    return found.chi_square + 2.0 * len(found.model.free)


def _added(shelf: Shelf, here: Names) -> Names:
    """The best set with one effect more; `here` if none is better.

    Fitted in the order of what each promises to first order; one that would not be the best even if it kept more
    than it promises, as an effect with kinks may, is not fitted. Those with kinks begin where they promise most, as
    in the diagnosis.
    """
    hopes = _hopes(shelf, here)
    best = here
    for name in sorted(hopes, key=lambda name: hopes[name][0]):
        hope, probes = hopes[name]
        if hope < aic(shelf, best):
            shelf.fit(here | {name}, probes)
            best = min(best, here | {name}, key=lambda names: aic(shelf, names))
    return best


def _hopes(shelf: Shelf, here: Names) -> dict[str, tuple[float, dict[str, float]]]:
    """The least AIC that each further effect may have, and where those with kinks begin."""
    base, about = aic(shelf, here), shelf.picture(here)
    out: dict[str, tuple[float, dict[str, float]]] = {}
    for name, effect in shelf.candidates.items():
        if name in here or not here >= set(effect.includes):
            continue
        if not effect.parameters:
            out[name] = float("-inf"), {}
        elif name in about.signatures:
            gain = about.gain([name])
            doubt = CRITERIA.estimate_error if effect.smooth else CRITERIA.kinked_estimate_error
            # A probe does not know what rows gain by choosing their sides.
            rows = float(shelf.whole.fitted.sum()) if sided(effect) else 0.0
            fall = (1.0 + doubt) * gain.value + SIDE * rows
            out[name] = base + 2.0 * len(effect.parameters) - fall, gain.probes
    return out
