"""Searches with the readings as they were declared, and as they are about what was found, until both are the same.

Single bad readings that are seen beside the best single effect are set aside before all that competes is fitted: what
they leave looks like many effects together, and takes most of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial

from pipeline.answer.record import Verdict
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.inference.fit import unmoved
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.selection.adequacy.bad_readings import bad_readings
from pipeline.selection.adequacy.judgement import HELD_OUT, SERIES, judge
from pipeline.selection.adequacy.untested import untested
from pipeline.selection.cost import cost, is_noise, misfit, price, root_of
from pipeline.selection.faulty_sensor import has_one_fault, with_promising_faults
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.reading_noise import AS_DECLARED, Readings
from pipeline.selection.search import singles_first
from pipeline.selection.searched import Chosen, beginning, chosen
from pipeline.selection.sensor_faults import plain_zero
from pipeline.selection.verdict import ENDED
from vjm.effects.base import Effect

Again = Callable[[Campaign, FitCache], FitCache]
"""The empty fit cache of a campaign that is another's with other readings; that of the other one."""
IN_PLACES = frozenset({SERIES, HELD_OUT})
"""Checks that a single bad reading fails."""


@dataclass(frozen=True, eq=False)
class Settled:
    """it: the choice with the readings as they are. given: all of them as they were declared; with_all: the verdict by
    those, alone: whether of the best single effect only. attempts: what failed on the way."""

    it: Chosen
    readings: Readings
    given: LoadCases
    with_all: Verdict
    alone: bool
    attempts: Attempts


def settled(cache: FitCache, again: Again, attempts: Attempts, single: bool = False) -> Settled:
    """Of a fit cache of the campaign as it was declared. single: whether no more than the best single effect is looked
    for. Where no work is left the best set is looked for again once, where it is the fault of one sensor."""
    given, what = cache.whole, "what the readings are"
    begun: list[Names] = []
    first = _Beside(AS_DECLARED, settled=False)
    if not untested(beginning(cache)) and not plain_zero(beginning(cache), cache.criteria):
        begun = singles_first(cache)
        if begun:
            first = attempts.get(what, partial(_at_first, cache, begun, again), first)
    new = first.it if first.settled else AS_DECLARED
    alone = not new.plain
    it = chosen(cache, attempts, alone or single, begun)
    with_all, readings = it.decision.verdict, AS_DECLARED
    for turn in range(0 if it.untested else cache.criteria.reading_rounds):
        if new.same(readings):
            new = attempts.get(what, partial(_readings, it, readings, given), readings)
        if new.same(readings):
            break
        single = single or (it.found.cache.worn_out and _of_a_fault(it))
        if it.found.cache.worn_out and (turn or not single) and not _same_fits(it, new, given):
            # Beside it the readings are not as they were declared, and no work is left to choose again.
            it = replace(it, decision=it.decision.withheld(ENDED))
            break
        cache.on_progress("with the readings as they are")
        readings, attempts = new, Attempts()
        it = chosen(again(readings.applied(given.campaign), it.found.cache), attempts, single)
    return _without_seen(Settled(it, readings, given, with_all, alone, attempts), first.it, again, single)


def as_declared(cache: FitCache, attempts: Attempts) -> Settled:
    """What explains most alone, with all readings as they were declared."""
    it = chosen(cache, attempts, alone=True)
    return Settled(it, AS_DECLARED, cache.whole, it.decision.verdict, True, attempts)


def _without_seen(here: Settled, seen: Readings, again: Again, single: bool) -> Settled:
    """Where nothing explains all: without the single bad readings that were seen beside one effect, where that leaves
    noise beside which they are bad as well. Beside a play, which takes up one at a turn, they are not seen."""
    it, given = here.it, here.given
    cache = it.found.cache
    if (
        not seen.bad
        or not here.readings.plain
        or cache.worn_out
        or judge(it.decision.fit, cache.criteria).noise
    ):
        return here
    cache.on_progress("without single readings that are off")
    attempts = Attempts()
    other = chosen(again(seen.applied(given.campaign), cache), attempts, single)
    found = other.decision.fit
    if not judge(found, cache.criteria).noise:
        return here
    readings = seen.again(found, given, cache.criteria)
    return replace(here, it=other, readings=readings, attempts=attempts) if readings.same(seen) else here


def _same_fits(it: Chosen, new: Readings, given: LoadCases) -> bool:
    """Whether a search that came to its end finds the same with other readings: only those held out are others."""
    cases = load_cases(new.applied(given.campaign))
    return not it.found.ended and unmoved(it.decision.fit, cases) is not None


def _of_a_fault(it: Chosen) -> bool:
    """Whether the best set is the fault of one sensor alone, which a look at single effects finds again."""
    cache, best = it.found.cache, it.found.best
    return has_one_fault(cache, best) and len(best - root_of(cache, best)) == 1


def with_faults(before: Settled, known: Iterable[Effect], again: Again) -> Settled:
    """With faults of sensors among the effects, where that leaves noise, or no more than what is off in single places,
    and nothing else does; none of sensors that are vouched for. Where no work is left, one fault beside what is there
    or not is all that is looked at. known: effects, kinds of such faults among them."""
    it = before.it
    cache, best = it.found.cache, it.found.best
    if it.untested or it.decision.verdict != "unknown" or cache.whole.campaign.vouched:
        return before
    if judge(cache.fit(best), cache.criteria).noise:
        return before
    more = with_promising_faults(cache, known, (best, frozenset()))
    if more is None:
        return before
    cache.on_progress("whether a sensor is at fault")

    def with_these(campaign: Campaign, near: FitCache) -> FitCache:
        return again(campaign, near).with_candidates(more.candidates)

    first = more if before.readings.plain else with_these(before.given.campaign, more)
    new = settled(first, with_these, Attempts(), single=cache.worn_out)
    if not _explains_more(new.it, best):
        return before
    return replace(new, with_all=before.with_all, alone=before.alone)


def _explains_more(new: Chosen, best: Names) -> bool:
    """Whether a choice with the fault of one sensor leaves noise, or nothing but what is off in some places and far
    less than the best set without: single bad readings that are not set aside."""
    found = new.found
    cache = found.cache
    if not has_one_fault(cache, found.best):
        return False
    left = cache.fit(found.best)
    far = left.chi_square < cache.criteria.slow * cache.fit(best).chi_square
    return judge(left, cache.criteria).failed <= (IN_PLACES if far else frozenset())


def _at_first(cache: FitCache, begun: list[Names], again: Again) -> _Beside:
    """What the readings are beside a single effect, where nothing but single bad ones is left then. A bad one may be
    more than all that an effect explains: then the effects are looked at again without those that are seen first; these
    where that does not settle it."""
    given = cache.whole
    new = _beside_one(cache, begun, AS_DECLARED, given)
    if new.settled or not new.it.bad:
        return new
    without = Readings(new.it.bad)
    cache = again(without.applied(given.campaign), cache)
    new = _beside_one(cache, singles_first(cache), without, given)
    return new if new.settled else _Beside(without, settled=False)


@dataclass(frozen=True)
class _Beside:
    """What the readings are beside an effect. settled: whether nothing else is left."""

    it: Readings
    settled: bool


def _beside_one(cache: FitCache, begun: list[Names], before: Readings, given: LoadCases) -> _Beside:
    """Beside that of some sets which leaves noise, the one that explains most of all but single bad ones first; beside
    this where none does."""
    if not begun:
        return _Beside(before, False)
    criteria = cache.criteria
    best = min(begun, key=lambda names: cost(cache, names))
    asked = [best] if is_noise(cache, best) else begun
    bad = {names: sum(b.sigmas**2 for b in bad_readings(cache.fit(names), criteria)) for names in asked}
    left = {names: cost(cache, names) - bad[names] for names in asked if bad[names] or before.bad}
    first = before
    for names in sorted(left, key=lambda names: left[names]):
        if left[names] > min(left.values()) + criteria.competing:
            break
        new = before.again(cache.fit(names), given, criteria)
        if new.bad and new.leaves_noise(cache.fit(names), given, criteria):
            return _Beside(new, True)
        first = new if first is before else first
    return _Beside(first, False)


def _readings(it: Chosen, before: Readings, given: LoadCases) -> Readings:
    """What the readings are about the first set; about a part of it where that explains all but single bad ones: an
    effect that only explains those is none."""
    cache, best = it.found.cache, it.decision.sets[0]
    criteria = cache.criteria
    for names in sorted((n for n in cache.fits if n < best), key=len):
        found = cache.fit(names)
        bad = before.single_bad(found, given, criteria) if before.may_be_asked(found, criteria) else ()
        # A play or a friction shows most at a turn: what it explains beside that is no bad reading.
        alone = sum(b.sigmas**2 for b in bad if b not in before.bad)
        if misfit(cache, names) - misfit(cache, best) - alone >= price(cache, best - names):
            continue
        new = before.again(found, given, criteria)
        if new.bad and new.leaves_noise(found, given, criteria):
            return new
    return before.again(it.decision.fit, given, criteria)
