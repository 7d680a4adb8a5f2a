"""A fault of a sensor instead of an effect: where one explains as much, a name would be a guess."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from scipy.stats import chi2

from pipeline.inference.fit import Fit, as_it_is, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.solvers import ALL, Effort, far
from pipeline.inference.subsets import carried
from pipeline.selection.adequacy.patterns import scores
from pipeline.selection.cost import cost, entry_for, misfit, misfit_of, numbers
from pipeline.selection.criteria import Criteria
from pipeline.selection.doctor import Suspicion
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.rivals import Found
from pipeline.selection.unknown_zeros import Zero, left_beside, taken_out, zeros
from vjm.effects.sensor_fault import SensorFault


@dataclass(frozen=True)
class Instead:
    """A fault of a sensor beside the set without an effect. explains, of: chi-square that the fault takes off with one
    number, and the effect with its own. zero: where the fault is a constant."""

    effect: str
    without: Names
    words: str
    explains: float
    of: float
    zero: Zero | None = None


def faults_instead(found: Found) -> tuple[Instead, ...]:
    """For each effect of the best set the plainest fault that the data do not exclude in its place.

    The same measure as between effects: worse by what tells so many numbers apart. A fault has one.
    """
    cache, best = found.cache, found.best
    out = []
    for name in cache.order(best):
        effect, without = cache.candidates[name], best - {name}
        if not effect.parameters or isinstance(effect, SensorFault):
            continue
        if any(name in cache.candidates[other].includes for other in without):
            continue
        gain = misfit(cache, without) - misfit(cache, best)
        enough = gain - cache.criteria.apart(numbers(effect) - 1)
        faults = [*_faults(cache, name, without, gain), *_zero_about(cache, name, best, gain, enough)]
        every = sorted(faults, key=lambda it: -it.explains)
        out += [it for it in every[:1] if it.explains >= enough]
    return tuple(out)


def _faults(cache: FitCache, name: str, without: Names, gain: float) -> Iterator[Instead]:
    """What each fault would explain in place of an effect."""
    found = cache.fit(without)
    for zero in zeros(found, cache.criteria):
        # One test alone that was not zeroed is a choice among many: it has to do better than the effect.
        if zero.everywhere or zero.gain >= gain:
            yield Instead(name, without, zero.words, zero.gain, gain, zero)
    vouched = cache.whole.campaign.vouched
    # An effect is no steadier than a fault: a few large loads may say all that is known of either. Of a sensor that is
    # vouched for it takes more than one reading.
    every = ((p.score**2 if vouched else p.takes, p.words) for p in scores(found, cache.criteria))
    explains, words = max(every, default=(0.0, ""))
    if words:
        yield Instead(name, without, words, explains, gain)


def _zero_about(cache: FitCache, name: str, best: Names, gain: float, enough: float) -> Iterator[Instead]:
    """What a zero would explain in place of an effect, about the numbers of the best set: where a set without it is far
    from the readings its numbers have gone far to explain a constant, and say nothing of what is left beside it.

    So far from the fit without the effect a slope promises what is not there: the set is fitted to the readings without
    the constant, and what that leaves counts."""
    without, whole = best - {name}, cache.fit(best)
    if not far(cache.fit(without).chi_square, whole.whitened.size):
        return
    about = as_it_is(whole.model.without(name), cache.whole, whole.prediction)
    alone = misfit(cache, without)
    for zero in zeros(about, cache.criteria):
        promised = alone - left_beside(about, zero)
        if promised < (enough if zero.everywhere else max(enough, gain)):
            continue
        beside = fitted_beside(about, zero, cache.criteria.plausible, cache.effort)
        explains = alone - misfit_of(cache, beside) + _gain(zero, beside, cache.criteria)
        if zero.everywhere or explains >= gain:
            yield Instead(name, without, zero.words, explains, gain, zero)
        return


def fitted_beside(found: Fit, zero: Zero, plausible: float, effort: Effort = ALL) -> Fit:
    """A model fitted anew, from where it is, to the readings of its tests without a constant. plausible: typical sizes
    of a number, effort: what it may take (`pipeline.inference.fit.fit`)."""
    before = found.residual.load_cases
    cases = load_cases(taken_out(before.campaign, zero))
    return fit(found.model, cases, carried(found.prediction, cases, before), None, plausible, effort)


def _gain(zero: Zero, beside: Fit, criteria: Criteria) -> float:
    """What more the same zero takes off once its first estimate is taken out."""
    same = (it for it in zeros(beside, criteria) if (it.column, it.tests) == (zero.column, zero.tests))
    return next((it.gain for it in same), 0.0)


def plain_zero(found: Fit, criteria: Criteria) -> bool:
    """Whether a zero alone explains nearly all of a large misfit: then nothing else is looked for in depth."""
    every = zeros(found, criteria)
    return (
        bool(every)
        and found.rms > criteria.zero_large
        and every[0].gain > (1.0 - criteria.zero_left) * found.chi_square
    )


def more_than_zero(before: Fit, single: Fit, criteria: Criteria) -> bool:
    """Whether a single effect leaves as little as the plainest zero does, within the factor from which that is asked
    about: a length that differs from the drawing moves one channel in every test as well."""
    left = before.chi_square - zeros(before, criteria)[0].gain
    return single.chi_square <= criteria.zero_factor * left


def _plainer(fit: Fit, zero: Zero, criteria: Criteria) -> bool:
    """Whether another fault of a sensor explains more than a zero."""
    return any(pattern.score**2 > zero.gain for pattern in scores(fit, criteria)[:1])


def zero_first(found: Found, explained: bool) -> Instead | None:
    """The zero of a sensor that explains more than the best set of effects, beside the set that needs it.

    explained: whether the best set leaves noise; a zero beside all of it would only take up some of that.
    """
    cache, best, criteria = found.cache, found.best, found.cache.criteria
    sets = sorted(cache.fits, key=lambda names: cost(cache, names))[: criteria.zero_sets]
    most = cache.fit(best).chi_square
    out: list[tuple[float, Instead]] = []
    for names in dict.fromkeys([frozenset(), *sets]):
        if explained and best <= names:
            continue
        fit = cache.fit(names)
        for zero in zeros(fit, criteria)[:1]:
            left = fit.chi_square - zero.gain
            entry = entry_for(cache, 1, zero.looks)
            total = cost(cache, names) - zero.gain + entry
            noise = left <= float(chi2.isf(criteria.zero_chance, max(fit.degrees - 1, 1)))
            worth = zero.gain > entry and total < cost(cache, best) and not _plainer(fit, zero, criteria)
            if worth and (noise or left < most / criteria.zero_factor):
                out.append((total, Instead("", names, zero.words, zero.gain, most, zero)))
    return min(out, key=lambda it: it[0])[1] if out else None


def asked_about(found: Fit, doctor: tuple[Suspicion, ...], criteria: Criteria) -> Instead | None:
    """The zero that a mistake of one column is, where it is one; beside a fit."""
    mistake = doctor[0].mistake
    if mistake.kind != "zero" or len(mistake.columns) != 1:
        return None
    column, _, _ = mistake.columns[0].rpartition("_")
    zero = next((it for it in zeros(found, criteria) if it.column == column and it.everywhere), None)
    return None if zero is None else Instead("", frozenset(), zero.words, zero.gain, found.chi_square, zero)
