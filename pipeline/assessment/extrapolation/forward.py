"""Forward selection by AIC: the effect that lowers it most is added, until none does.

H. Akaike, IEEE Transactions on Automatic Control 19 (1974), 716-723. With known sigmas AIC is chi-square and two for
each fitted number, but for a constant.
"""

from __future__ import annotations

from pipeline.inference.settings import STOPS
from pipeline.inference.stops import sided
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.fit_cache import FitCache, Names


def forward(cache: FitCache) -> Names:
    """The effects that are added to the base model, one at a time."""
    here: Names = frozenset()
    while True:
        better = _added(cache, here)
        if not aic(cache, better) < aic(cache, here):
            return here
        here = better


def aic(cache: FitCache, names: Names) -> float:
    """Of the base model with these effects at its best fit."""
    found = cache.fit(names)
    return found.chi_square + 2.0 * len(found.model.free)


def _added(cache: FitCache, here: Names) -> Names:
    """The best set with one effect more; `here` if none is better.

    Fitted in the order of what each promises to first order; one that would not be the best even if it kept more
    than it promises, as an effect with kinks may, is not fitted. Those with kinks begin where they promise most, as
    in the diagnosis.
    """
    hopes = _hopes(cache, here)
    best = here
    for name in sorted(hopes, key=lambda name: hopes[name][0]):
        hope, probes = hopes[name]
        if hope < aic(cache, best):
            cache.fit(here | {name}, probes)
            best = min(best, here | {name}, key=lambda names: aic(cache, names))
    return best


def _hopes(cache: FitCache, here: Names) -> dict[str, tuple[float, dict[str, float]]]:
    """The least AIC that each further effect may have, and where those with kinks begin."""
    base, about = aic(cache, here), cache.first_order(here)
    out: dict[str, tuple[float, dict[str, float]]] = {}
    for name, effect in cache.candidates.items():
        if name in here or not here >= set(effect.includes):
            continue
        if not effect.parameters:
            out[name] = float("-inf"), {}
        elif name in about.signatures:
            gain = about.gain([name])
            doubt = CRITERIA.estimate_error if effect.smooth else CRITERIA.kinked_estimate_error
            # A probe does not know what rows gain by choosing their sides.
            rows = float(cache.whole.fitted.sum()) if sided(effect) else 0.0
            fall = (1.0 + doubt) * gain.value + STOPS.side * rows
            out[name] = base + 2.0 * len(effect.parameters) - fall, gain.probes
    return out
