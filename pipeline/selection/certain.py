"""What is certain though not all is explained: effects without which far more is left, whatever sensors did beside.

For an effect of the best set the rival is the best set without it, other effects allowed. Both may have patterns of
sensors (`falls`): the best set as many as its rest needs to look like noise, the rival two
more. The effect is certain where the rival is still worse by far. The rival of a sensor's fault has no pattern that is
that fault.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.model import at_bound
from pipeline.inference.prior import held_back
from pipeline.parameter_names import parted
from pipeline.selection.adequacy.constancy import departures
from pipeline.selection.adequacy.patterns import Shape, left_of, shapes
from pipeline.selection.cost import cost, misfit
from pipeline.selection.criteria import Criteria
from pipeline.selection.determined import blind
from pipeline.selection.faulty_sensor import shapes_of
from pipeline.selection.first_order_costs import estimates
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.rivals import Found
from vjm.effects.sensor_fault import SensorFault

Array = NDArray[np.float64]


def certain(found: Found, sets: tuple[Names, ...], doubted: Collection[str] = ()) -> tuple[str, ...]:
    """Names of the effects with numbers that are in all sets of a verdict and that nothing else replaces. doubted:
    those in whose place a fault of a sensor explains as much. None where a number of the first set is held back, at its
    bound or by how plausible it is: what it may not explain others take up. None of an effect of which some tests would
    have twice as much, or nothing: there it is another; none of which no number is determined. None where the search
    ended before its rivals and what the readings are were looked at."""
    if found.ended:
        return ()
    cache, criteria = found.cache, found.cache.criteria
    best = sets[0]
    common = frozenset.intersection(*sets)
    fit = cache.fit(best)
    doubted = {*doubted, *_inconstant(fit, criteria)}
    names = [n for n in cache.order(common) if cache.candidates[n].parameters and n not in doubted]
    held = held_back(fit.model.free, fit.model.values, criteria.plausible, fit.jacobian)
    if not names or at_bound(fit.model) or held > criteria.exclusion_least:
        return ()
    mine = falls(fit, criteria, criteria.certain_patterns)
    limit = fit.degrees + criteria.excess_deviations * (2.0 * max(fit.degrees, 1)) ** 0.5
    count = next((k for k, left in enumerate(mine) if left <= limit), len(mine) - 1)
    beside = misfit(cache, best) - mine[0]
    needed = (criteria.certain_sigmas * max(1.0, fit.rms)) ** 2
    least = mine[count] + beside + needed
    sure = tuple(it for it in names if _beaten(cache, best, it, count + criteria.certain_more, least))
    # Of two that do the same each is missed where the other is at the end of what it may be.
    unseen = blind(fit, cache.whole) if sure else frozenset()
    return tuple(name for name in sure if name not in unseen)


def _inconstant(fit: Fit, criteria: Criteria) -> Iterator[str]:
    """Effects with a number that is not one: where it is fitted to some tests alone it differs by more than half."""
    sizes = {
        free.name: abs(v - free.parameter.null)
        for free, v in zip(fit.model.free, fit.model.values, strict=True)
    }
    least = criteria.certain_sigmas * max(1.0, fit.rms)
    for it in departures(fit):
        if abs(it.score) > least and abs(it.change) > 0.5 * sizes[it.name]:
            yield parted(it.name)[0]


def _beaten(cache: FitCache, best: Names, name: str, patterns: int, least: float) -> bool:
    """Whether every rival without an effect leaves more than this with so many patterns."""
    for rival in _rivals(cache, best, name):
        found = cache.fit(rival)
        left = falls(found, cache.criteria, patterns, _own(found, cache.fit(best), name, cache.criteria))
        if misfit(cache, rival) - left[0] + left[-1] < least:
            return False
    return True


def _rivals(cache: FitCache, best: Names, name: str) -> Iterator[Names]:
    """The set without the effect and what cannot be without it, the best sets without it that were fitted, and, where
    that is asked for, the set with the best other effects beside."""
    needs = {n for n in best if name in cache.candidates[n].includes}
    start = best - {name} - needs
    cache.fit_all({start: {}})
    wanted = cache.criteria.certain_rivals
    known = sorted((n for n in cache.fits if name not in n), key=lambda n: cost(cache, n))
    yield from dict.fromkeys([start, *known[:wanted]])
    near = [e for e in estimates(cache, start, (1,)) if e.names != start and name not in e.names]
    cache.fit_all({e.names: e.probes for e in near[:wanted]})
    yield from (e.names for e in near[:wanted] if e.names not in known[:wanted])


def _own(found: Fit, best: Fit, name: str, criteria: Criteria) -> Array | None:
    """(N,) of length 1: what the fault of a sensor, as in the best fit, does to what a fit without it leaves; None for
    an effect that is none, and where the fit takes it up."""
    term = next(it for it in best.model.terms if it.effect.name == name)
    if not isinstance(term.effect, SensorFault):
        return None
    every = shapes_of(found, best, term.effect, [term.values], criteria)
    return next((it.column / it.size for it in every), None)


def falls(found: Fit, criteria: Criteria, most: int, but: Array | None = None) -> list[float]:
    """Chi-square that is left of the fitted tests with none, one, ... `most` patterns; shorter where no more differ.
    but: (N,) of length 1, which no pattern may be.

    A gain, a drift or a cross-talk of each sensor, and each test's own zero, each the largest that is left (forward
    selection): S. Weisberg, Applied Linear Regression, 4th ed., Wiley 2014, section 10.2.
    """
    every = [it.column / it.size for it in (*shapes(found, criteria), *_zeros(found))]
    if but is not None:
        every = [it for it in every if 1.0 - float(it @ but) ** 2 > criteria.certain_new**2]
    left = float(found.whitened @ found.whitened)
    out = [left]
    if not every:
        return out
    columns, residual = np.stack(every, axis=1), found.whitened.copy()
    there = np.ones(columns.shape[1])
    for _ in range(most):
        sizes = np.linalg.norm(columns, axis=0)
        usable = (sizes > criteria.certain_new) & (there > 0.0)
        if not usable.any():
            return out
        pull = np.where(usable, columns.T @ residual / np.where(usable, sizes, 1.0), 0.0)
        best = int(np.argmax(np.abs(pull)))
        unit = columns[:, best] / sizes[best]
        there[best] = 0.0
        residual = residual - unit * pull[best]
        columns = columns - np.outer(unit, unit @ columns)
        out.append(float(residual @ residual))
    return out


def _zeros(found: Fit) -> Iterator[Shape]:
    """A constant of each channel in each test."""
    whole = found.residual.load_cases
    tests = np.unique(whole.test[whole.fitted])
    errors = (whole.test[:, None] == tests).astype(float)
    errors[found.prediction.lost] = 0.0
    for channel in np.flatnonzero(np.isfinite(whole.measured).any(axis=0) & (whole.sigma > 0.0)):
        own = [f"has a zero of its own in {whole.campaign.tests[k].id}" for k in tests]
        yield from left_of(found, int(channel), own, errors)
