"""Searches with the readings as they were declared, and as they are about what was found, until both are the same.

Single bad readings that are seen beside the best single effect are set aside before all that competes is fitted: what
they leave looks like many effects together, and takes most of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial

from pipeline.adequacy.bad_readings import bad_readings
from pipeline.adequacy.judgement import judge
from pipeline.adequacy.untested import untested
from pipeline.answer import Verdict
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.diagnose.chosen import Chosen, beginning, chosen
from pipeline.diagnose.faulty import has_one_fault, with_promising_faults
from pipeline.diagnose.merit import cost
from pipeline.diagnose.readings import AS_DECLARED, Readings
from pipeline.diagnose.search import singles_first
from pipeline.diagnose.sensor_faults import plain_zero
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.program import Program
from vjm.effects.base import Effect

Again = Callable[[Campaign, Shelf], Shelf]
"""The empty fit cache of a campaign that is another's with other readings; that of the other one."""


@dataclass(frozen=True, eq=False)
class Settled:
    """it: the choice with the readings as they are. given: all of them as they were declared; with_all: the verdict by
    those, alone: whether of the best single effect only. attempts: what failed on the way."""

    it: Chosen
    readings: Readings
    given: Program
    with_all: Verdict
    alone: bool
    attempts: Attempts


def settled(shelf: Shelf, again: Again, attempts: Attempts) -> Settled:
    """Of a fit cache of the campaign as it was declared."""
    given, what = shelf.whole, "what the readings are"
    begun: list[Names] = []
    new = AS_DECLARED
    if not untested(beginning(shelf)) and not plain_zero(beginning(shelf), shelf.criteria):
        begun = singles_first(shelf)
        if begun:
            new = attempts.get(what, partial(_at_first, shelf, begun), AS_DECLARED)
    alone = not new.plain
    it = chosen(shelf, attempts, alone, begun)
    with_all, readings = it.ruling.verdict, AS_DECLARED
    for _ in range(0 if it.untested else shelf.criteria.reading_rounds):
        if new.same(readings):
            new = attempts.get(what, partial(_readings, it, readings, given), readings)
        if new.same(readings):
            break
        shelf.say("with the readings as they are")
        readings, attempts = new, Attempts()
        it = chosen(again(readings.applied(given.campaign), it.found.shelf), attempts)
    return Settled(it, readings, given, with_all, alone, attempts)


def with_faults(before: Settled, known: Iterable[Effect], again: Again) -> Settled:
    """With faults of sensors among the effects, where that leaves noise and nothing else does; none of sensors that
    are vouched for. known: effects, kinds of such faults among them."""
    it = before.it
    shelf, best = it.found.shelf, it.found.best
    if it.untested or it.ruling.verdict != "unknown" or shelf.whole.campaign.vouched:
        return before
    if judge(shelf.fit(best), shelf.criteria).noise:
        return before
    more = with_promising_faults(shelf, known, best)
    if more is None:
        return before
    shelf.say("whether a sensor is at fault")

    def with_these(campaign: Campaign, near: Shelf) -> Shelf:
        return again(campaign, near).with_candidates(more.candidates)

    first = more if before.readings.plain else with_these(before.given.campaign, more)
    new = settled(first, with_these, Attempts())
    named = new.it.found
    if (
        not has_one_fault(named.shelf, named.best)
        or not judge(named.shelf.fit(named.best), shelf.criteria).noise
    ):
        return before
    return replace(new, with_all=before.with_all, alone=before.alone)


def _at_first(shelf: Shelf, begun: list[Names]) -> Readings:
    """What the readings are beside the best of single effects, where nothing but single bad ones is left then."""
    found = shelf.fit(min(begun, key=lambda names: cost(shelf, names)))
    if not bad_readings(found, shelf.criteria):
        return AS_DECLARED
    new = AS_DECLARED.again(found, shelf.whole, shelf.criteria)
    return new if new.bad and new.leaves_noise(found, shelf.whole, shelf.criteria) else AS_DECLARED


def _readings(it: Chosen, before: Readings, given: Program) -> Readings:
    """What the readings are about the first set; about a part of it where that explains all but single bad ones: an
    effect that only explains those is none."""
    shelf, best = it.found.shelf, it.ruling.sets[0]
    criteria = shelf.criteria
    for names in sorted((n for n in shelf.fits if n < best), key=len):
        new = before.again(shelf.fit(names), given, criteria)
        if new.bad and new.leaves_noise(shelf.fit(names), given, criteria):
            return new
    return before.again(it.ruling.fit, given, criteria)
