"""What a set of effects costs: what it leaves, how plausible its numbers are, and what its effects have to show."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.fit import Fit
from pipeline.inference.program import LOST
from vjm.effects.base import Effect


def cost(shelf: Shelf, names: Names) -> float:
    """Chi-square of the fit, how far its numbers are from plausible ones, and what each effect has to show."""
    return badness(shelf, names) + price(shelf, names) + shelf.fit(names).residual.spread


def badness(shelf: Shelf, names: Names) -> float:
    """Chi-square of the fit, what choices of sides took off it, and of its numbers, each
    `Criteria.plausible` typical sizes a sigma."""
    found = shelf.fit(names)
    return (
        found.chi_square
        + found.residual.doubt
        + implausibility(found, shelf.criteria.plausible)
        + _lost(shelf, found)
    )


def _lost(shelf: Shelf, found: Fit) -> float:
    """Chi-square that rows without a prediction count beyond their 30 sigma a reading: where the base model has a
    prediction they count no less than with it, for to lose a row is not to explain it."""
    if not found.lost:
        return 0.0
    base, whole = shelf.fit(frozenset()), shelf.whole
    rows = found.prediction.lost & ~base.prediction.lost & whole.fitted
    squares = np.sum(base.residual.values[rows] ** 2, axis=1)
    return float(np.sum(np.maximum(squares - LOST**2 * np.sum(whole.predicted[rows], axis=1), 0.0) + LOST**2))


def implausibility(found: Fit, plausible: float) -> float:
    """Chi-square of the numbers alone, each so many typical sizes a sigma."""
    return float(
        sum(
            ((value - f.parameter.null) / (plausible * f.parameter.typical)) ** 2
            for f, value in zip(found.model.free, found.model.values, strict=True)
        )
    )


def numbers(effect: Effect) -> int:
    """Degrees of freedom that an effect takes: one for an effect that is there or not."""
    return max(1, len(effect.parameters))


def entry(shelf: Shelf, name: str) -> float:
    """Fall of chi-square below which an effect is not let in. One with kinks had several looks, one at each probe."""
    effect = shelf.candidates[name]
    looks = max(len(shelf.candidates), 1) * max(1, len(effect.probes))
    return shelf.criteria.entry(numbers(effect), looks)


def price(shelf: Shelf, names: Iterable[str]) -> float:
    """What the effects of a set have to show, in chi-square."""
    return sum(entry(shelf, name) for name in names)


def seen(shelf: Shelf, names: Names) -> int:
    """Degrees of freedom that a set takes from these data: directions of its numbers that plausible sizes move by a
    sigma, and one for an effect that is there or not. What the data do not see fits no noise."""
    found = shelf.fit(names)
    scale = np.array([shelf.criteria.plausible * f.parameter.typical for f in found.model.free])
    sizes = np.linalg.svd(found.jacobian * scale, compute_uv=False) if scale.size else np.zeros(0)
    switches = sum(not shelf.candidates[name].parameters for name in names)
    return int(np.sum(sizes > 1.0)) + switches


def taken(shelf: Shelf, names: Iterable[str]) -> int:
    """Degrees of freedom that a set takes."""
    return sum(numbers(shelf.candidates[name]) for name in names)


def root_of(shelf: Shelf, names: Names) -> Names:
    """Those effects of a set that are there or not."""
    return frozenset(name for name in names if not shelf.candidates[name].parameters)


def is_noise(shelf: Shelf, names: Names) -> bool:
    """Whether chi-square is no larger than noise makes it, within a few of its standard deviations."""
    return excess(shelf, names) == 0.0


def excess(shelf: Shelf, names: Names) -> float:
    """Chi-square beyond that."""
    found = shelf.fit(names)
    spread = float(np.sqrt(2.0 * max(found.degrees, 1)))
    return max(found.chi_square - found.degrees - shelf.criteria.excess_deviations * spread, 0.0)
