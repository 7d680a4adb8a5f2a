"""A sensor's fault among the effects, where those of the mechanism leave what is no noise.

Every fault of every sensor that was read is looked at to first order, beside the best set and beside none; with those
that promise most the search is made again. Where its best set has one of them and leaves noise the answer is that, else
the first one: a fault that explains a part is no better than an effect that does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np

from pipeline.campaign import Campaign
from pipeline.campaign.names import channel_columns
from pipeline.inference.fit import Fit
from pipeline.inference.sensor_faults import moved, noise_of
from pipeline.inference.suitable import columns_read
from pipeline.selection.adequacy.patterns import Shape, expected, left_of, steady
from pipeline.selection.cost import entry_for
from pipeline.selection.criteria import Criteria
from pipeline.selection.fit_cache import FitCache, Names
from vjm.effects.base import Effect, Values
from vjm.effects.sensor_fault import SensorFault


def faults_of(known: Iterable[Effect], campaign: Campaign, criteria: Criteria) -> dict[str, SensorFault]:
    """Every fault that the sensors of a campaign may have, of the kinds that are known.

    None is larger than a share of what its sensor read: one that is replaces the readings, and would explain a lost
    sign or a wrong column as well.
    """
    kinds = [it for it in known if isinstance(it, SensorFault) and not it.column]
    most = _most(campaign, criteria.fault_share)
    every = (kind.at(site) for kind in kinds for site in kind.sites(columns_read(campaign)))
    return {it.name: it.limited(most[it.column]) if it.column in most else it for it in every}


def _most(campaign: Campaign, share: float) -> dict[str, float]:
    """By column this share of the span of its readings, where they have any."""
    readings = np.concatenate([test.data.readings for test in campaign.tests])
    out = {}
    for name, values in zip(channel_columns(campaign.gauges), readings.T, strict=True):
        values = values[np.isfinite(values)]
        if values.size and (span := float(np.ptp(values))) > 0.0:
            out[name] = share * span
    return out


def with_promising_faults(cache: FitCache, known: Iterable[Effect], sets: Iterable[Names]) -> FitCache | None:
    """The same with the faults that promise most beside one of the sets; None where none promises anything."""
    every = faults_of(known, cache.whole.campaign, cache.criteria)
    every = {name: it for name, it in every.items() if name not in cache.candidates}
    criteria, chosen = cache.criteria, list[str]()
    for names in dict.fromkeys(sets):
        beside = {name: cache.candidates[name] for name in cache.order(names)}
        gains = _gains(cache.with_candidates({**beside, **every}), names, every)
        enough = entry_for(cache, 1, len(every))
        worth = sorted((name for name in gains if gains[name] > enough), key=lambda name: -gains[name])
        found = cache.fit(names)
        some = (it for it in worth if _in_many_readings(found, every[it], criteria) > enough)
        chosen += islice(some, criteria.faults_looked_at)
    if not chosen:
        return None
    return cache.with_candidates(
        {**cache.candidates, **{name: every[name] for name in dict.fromkeys(chosen)}}
    )


def least_with_a_fault(cache: FitCache, names: Names, known: Iterable[Effect]) -> float:
    """Chi-square that the fault of one sensor leaves beside a set, to first order; of a plausible size."""
    every = faults_of(known, cache.whole.campaign, cache.criteria)
    beside = {name: cache.candidates[name] for name in cache.order(names)}
    there = cache.with_candidates({**beside, **every}).first_order(names)
    falls = [0.0]
    for name in every:
        if name in there.signatures and not every[name].smooth:
            falls.append(there.gain([name]).value)
        elif name in there.signatures:
            fall, sizes = there.alone(name)
            most = [max(-p.low, p.high) / p.typical for p in every[name].parameters]
            within = np.abs(sizes) <= np.minimum(most, cache.criteria.plausible)
            if within.all():
                falls.append(fall)
    return cache.fit(names).chi_square - max(falls)


def has_one_fault(cache: FitCache, names: Names) -> bool:
    """Whether a set has the fault of one sensor: two at once explain nearly anything, and are no name."""
    return sum(isinstance(cache.candidates[name], SensorFault) for name in names) == 1


def shapes_of(
    found: Fit, about: Fit, fault: SensorFault, values: Sequence[Values], criteria: Criteria
) -> Iterator[Shape]:
    """What a fault with some values, of the readings of the fit `about`, does to what another fit leaves."""
    whole = about.residual.load_cases
    channel = whole.rows.columns.index(fault.column)
    noise = noise_of(about.prediction, channel, whole)
    readings = moved(fault, expected(about, criteria.chosen_side), whole, noise)
    errors = np.stack([fault.error(readings, whole.rows, it) for it in values], axis=-1)
    return left_of(found, channel, [fault.name] * len(values), errors)


def _in_many_readings(found: Fit, fault: SensorFault, criteria: Criteria) -> float:
    """By how much a fault of its typical size, or of one at which it is looked at, lowers chi-square of a fit, without
    the row that says most for it: a single bad reading looks like many faults."""
    first = fault.parameters[0]
    sizes = fault.probes or (first.null + first.typical,)
    every = shapes_of(found, found, fault, [{**fault.nulls, first.name: size} for size in sizes], criteria)
    rows = found.residual.rows[:, 0]
    return max((steady(it.column, found.whitened, rows) ** 2 for it in every), default=0.0)


def _gains(cache: FitCache, names: Names, every: Mapping[str, Effect]) -> dict[str, float]:
    """To first order, of each fault beside a set."""
    there = cache.first_order(names)
    return {name: there.gain([name]).value for name in every if name in there.signatures}
