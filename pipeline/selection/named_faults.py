"""Faults of sensors that explain as much as an effect, as sets of their own.

What `faults_instead` finds is a pattern of what is left without the effect. Here the faults of the catalogue that
promise most there are fitted: one that the readings do not exclude is a set beside the others, with numbers, a next
test that tells them apart, and a name that can be added to the model.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from pipeline.selection.exclusion import possible
from pipeline.selection.faulty_sensor import with_promising_faults
from pipeline.selection.noise_rounds import Settled
from vjm.effects.base import Effect


def with_named_faults(before: Settled, known: Iterable[Effect]) -> Settled:
    """The same with such sets after those of the mechanism; none of sensors that are vouched for. A constant of a
    channel is no fault of the catalogue: it is asked about as a zero. known: effects, kinds of such faults among
    them."""
    it = before.it
    found, decision, cache = it.found, it.decision, it.found.cache
    asked = [each for each in decision.instead if each.effect and each.zero is None]
    if it.untested or not asked or cache.whole.campaign.vouched:
        return before
    cache.on_progress("which fault of a sensor explains as much")
    every, there = tuple(known), cache
    sets, rest = list(decision.sets), list(decision.instead)
    for each in asked:
        more = with_promising_faults(there, every, (each.without,))
        if more is None:
            continue
        faults = {
            each.without | {name}: dict[str, float]() for name in more.candidates.keys() - there.candidates
        }
        more.fit_all(faults)
        alike = possible(more, sorted(faults, key=more.order), found.best)
        if alike:
            there = more
            sets += alike
            rest.remove(each)
    decision = replace(decision, sets=tuple(dict.fromkeys(sets)), instead=tuple(rest))
    return replace(before, it=replace(it, found=replace(found, cache=there), decision=decision))
