"""A sensor's fault among the effects, where those of the mechanism leave what is no noise.

Every fault of every sensor that was read is looked at to first order, beside the best set and beside none; with those
that promise most the search is made again. Where its best set has one of them and leaves noise the answer is that, else
the first one: a fault that explains a part is no better than an effect that does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.suitable import columns_read
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault


def faults_of(known: Iterable[Effect], columns: tuple[str, ...]) -> dict[str, SensorFault]:
    """Every fault that sensors of these columns may have, of the kinds that are known."""
    kinds = [it for it in known if isinstance(it, SensorFault) and not it.column]
    every = (kind.at(site) for kind in kinds for site in kind.sites(columns))
    return {it.name: it for it in every}


def with_promising_faults(shelf: Shelf, known: Iterable[Effect], best: Names) -> Shelf | None:
    """The same with the faults that promise most beside the effects; None where none promises anything."""
    every = faults_of(known, columns_read(shelf.whole.campaign))
    every = {name: it for name, it in every.items() if name not in shelf.candidates}
    criteria, chosen = shelf.criteria, []
    for names in dict.fromkeys([best, frozenset[str]()]):
        beside = {name: shelf.candidates[name] for name in shelf.order(names)}
        gains = _gains(shelf.with_candidates({**beside, **every}), names, every)
        worth = [name for name in gains if gains[name] > criteria.entry(1, len(every))]
        chosen += sorted(worth, key=lambda name: -gains[name])[: criteria.faults_looked_at]
    if not chosen:
        return None
    return shelf.with_candidates(
        {**shelf.candidates, **{name: every[name] for name in dict.fromkeys(chosen)}}
    )


def least_with_a_fault(shelf: Shelf, names: Names, known: Iterable[Effect]) -> float:
    """Chi-square that the fault of one sensor leaves beside a set, to first order; of a plausible size."""
    every = faults_of(known, columns_read(shelf.whole.campaign))
    beside = {name: shelf.candidates[name] for name in shelf.order(names)}
    there = shelf.with_candidates({**beside, **every}).picture(names)
    falls = [0.0]
    for name in every:
        if name in there.signatures:
            fall, sizes = there.alone(name)
            if np.abs(sizes).max(initial=0.0) <= shelf.criteria.plausible:
                falls.append(fall)
    return shelf.fit(names).chi_square - max(falls)


def has_one_fault(shelf: Shelf, names: Names) -> bool:
    """Whether a set has the fault of one sensor: two at once explain nearly anything, and are no name."""
    return sum(isinstance(shelf.candidates[name], SensorFault) for name in names) == 1


def _gains(shelf: Shelf, names: Names, every: Mapping[str, Effect]) -> dict[str, float]:
    """To first order, of each fault beside a set."""
    there = shelf.picture(names)
    return {name: there.gain([name]).value for name in every if name in there.signatures}
