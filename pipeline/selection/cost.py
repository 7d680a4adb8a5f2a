"""What a set of effects costs: what it leaves, how plausible its numbers are, and what its effects have to show."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LOST
from pipeline.inference.prior import implausibility
from pipeline.selection.fit_cache import FitCache, Names
from vjm.effects.base import Effect


def cost(cache: FitCache, names: Names) -> float:
    """Chi-square of the fit, how far its numbers are from plausible ones, and what each effect has to show."""
    return misfit(cache, names) + price(cache, names) + cache.fit(names).residual.spread


def misfit(cache: FitCache, names: Names) -> float:
    """Chi-square of the fit, what choices of sides took off it, and of its numbers, each
    `Criteria.plausible` typical sizes a sigma."""
    return misfit_of(cache, cache.fit(names))


def misfit_of(cache: FitCache, found: Fit) -> float:
    """The same of a fit of the same tests."""
    return (
        found.chi_square
        + found.residual.doubt
        + implausibility(found.model.free, found.model.values, cache.criteria.plausible)
        + _lost(cache, found)
    )


def _lost(cache: FitCache, found: Fit) -> float:
    """Chi-square that rows without a prediction count beyond their 30 sigma a reading: where the base model has a
    prediction they count no less than with it, for to lose a row is not to explain it."""
    if not found.lost:
        return 0.0
    base, whole = cache.fit(frozenset()), cache.whole
    rows = found.prediction.lost & ~base.prediction.lost & whole.fitted
    squares = np.sum(base.residual.values[rows] ** 2, axis=1)
    return float(np.sum(np.maximum(squares - LOST**2 * np.sum(whole.predicted[rows], axis=1), 0.0) + LOST**2))


def numbers(effect: Effect) -> int:
    """Degrees of freedom that an effect takes: one for an effect that is there or not."""
    return max(1, len(effect.parameters))


def entry(cache: FitCache, name: str) -> float:
    """Fall of chi-square below which an effect is not let in."""
    effect = cache.candidates[name]
    return entry_for(cache, numbers(effect), looks(effect, len(cache.candidates)))


def entry_for(cache: FitCache, parameters: int, among: int) -> float:
    """Fall of chi-square that so many further parameters have to show, the best among so many looks: of effects, of
    faults of sensors and of their zeros alike."""
    return cache.criteria.entry(parameters, among)


def looks(effect: Effect, candidates: int) -> int:
    """In how many ways an effect among so many candidates could have shown by chance: one with kinks at each probe."""
    return max(candidates, 1) * max(1, len(effect.probes))


def price(cache: FitCache, names: Iterable[str]) -> float:
    """What the effects of a set have to show, in chi-square."""
    return sum(entry(cache, name) for name in names)


def seen(cache: FitCache, names: Names) -> int:
    """Degrees of freedom that a set takes from these data: directions of its numbers that plausible sizes move by a
    sigma, and one for an effect that is there or not. What the data do not see fits no noise."""
    found = cache.fit(names)
    scale = np.array([cache.criteria.plausible * f.parameter.typical for f in found.model.free])
    sizes = np.linalg.svd(found.jacobian * scale, compute_uv=False) if scale.size else np.zeros(0)
    switches = sum(not cache.candidates[name].parameters for name in names)
    return int(np.sum(sizes > 1.0)) + switches


def taken(cache: FitCache, names: Iterable[str]) -> int:
    """Degrees of freedom that a set takes."""
    return sum(numbers(cache.candidates[name]) for name in names)


def root_of(cache: FitCache, names: Names) -> Names:
    """Those effects of a set that are there or not."""
    return frozenset(name for name in names if not cache.candidates[name].parameters)


def is_noise(cache: FitCache, names: Names) -> bool:
    """Whether chi-square is no larger than noise makes it, within a few of its standard deviations."""
    return excess(cache, names) == 0.0


def excess(cache: FitCache, names: Names) -> float:
    """Chi-square beyond that."""
    found = cache.fit(names)
    spread = float(np.sqrt(2.0 * max(found.degrees, 1)))
    return max(found.chi_square - found.degrees - cache.criteria.excess_deviations * spread, 0.0)
