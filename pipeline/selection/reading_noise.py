"""What the readings are about a model: single bad ones, sigmas as they are, tails.

Asked of the best set only, and only where what it leaves has no order along the load paths: then a shape is missing
and nothing of it is noise. Readings that are off by turns are an order too, but one that a single bad reading leaves
around it: tails and other sigmas are asked about once that is set aside. What is found is asked again about all
readings once the search was made with it, so that what is no longer outlying comes back.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, fit, unfitted, unmoved
from pipeline.inference.kept import kept
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.subsets import carried
from pipeline.selection.adequacy.bad_readings import BadReading, bad_readings, set_aside
from pipeline.selection.adequacy.greatest_loads import off_at_greatest_loads
from pipeline.selection.adequacy.judgement import HELD_OUT, judge, of_the_size_of_noise, ordered
from pipeline.selection.adequacy.scatter import Scatter, scatters
from pipeline.selection.adequacy.tails import Tails, tails_of, without_tails
from pipeline.selection.adequacy.whiteness import white
from pipeline.selection.criteria import Criteria


@dataclass(frozen=True, eq=False)
class Readings:
    """bad: single bad readings. scatter: of sensors whose declared sigma is another one. tails: long tails, and normal:
    the campaign with its readings as normal noise of as much information; or None."""

    bad: tuple[BadReading, ...] = ()
    scatter: tuple[Scatter, ...] = ()
    tails: Tails | None = None
    normal: Campaign | None = None

    def same(self, other: Readings) -> bool:
        """Whether they say the same: the same readings and the same sensors set apart."""
        return self._key == other._key

    @property
    def _key(self) -> tuple[object, ...]:
        cells = frozenset(each.cell for each in self.bad)
        return cells, frozenset(each.channel for each in self.scatter), self.tails is None

    @property
    def plain(self) -> bool:
        """Whether they are as they were declared."""
        return self.same(AS_DECLARED)

    @staticmethod
    def may_be_asked(found: Fit, criteria: Criteria) -> bool:
        """Whether nothing of a fit has an order, and it is not off at the greatest loads."""
        if ordered(found, criteria):
            return False
        return not off_at_greatest_loads(found, criteria.false_alarm)

    def again(self, found: Fit, given: LoadCases, criteria: Criteria) -> Readings:
        """What the readings are about another fit. given: all of them as they were declared."""
        if not self.may_be_asked(found, criteria):
            return self
        bad = self.single_bad(found, given, criteria)
        if found.degrees < criteria.few_readings:
            # Few readings say nothing of what sensors scatter by.
            return Readings(bad) if bad else self
        whole = found if self.plain else _given(found, given)
        # A bad reading pulls a fit to itself, and what that leaves of its neighbours looks like long tails.
        rest = whole if not bad else self._beside(bad, found, given, criteria)
        about = whole if not bad else _given(rest, given)
        if not white(rest, criteria):
            return Readings(bad)
        tails = tails_of(about, criteria)
        if tails is not None:
            return Readings(tails=tails, normal=without_tails(about, tails))
        return Readings(bad, tuple(other_sigmas(rest, criteria)))

    def single_bad(self, found: Fit, given: LoadCases, criteria: Criteria) -> tuple[BadReading, ...]:
        """Those of all readings, given as they were declared, that are single bad ones about a fit."""
        whole = found if self.plain else _given(found, given)
        return (*bad_readings(whole, criteria), *_held_out(whole, criteria))

    def _beside(self, bad: tuple[BadReading, ...], found: Fit, given: LoadCases, criteria: Criteria) -> Fit:
        """A model fitted without these readings; found: fitted to the readings as they are here."""
        cases = load_cases(set_aside(given.campaign, bad))
        same = Readings(bad, self.scatter, self.tails).same(self)
        return _with_readings(found, cases) if same else _refitted(cases, found, criteria)

    def leaves_noise(self, found: Fit, given: LoadCases, criteria: Criteria) -> bool:
        """Whether a model explains all but what they set aside."""
        rest = load_cases(self.applied(given.campaign))
        return judge(_refitted(rest, found, criteria), criteria).noise

    def applied(self, campaign: Campaign) -> Campaign:
        """A campaign as these readings are."""
        if self.normal is not None:
            return self.normal
        return set_aside(with_sigmas(campaign, self.scatter), self.bad)


AS_DECLARED = Readings()


def with_sigmas(campaign: Campaign, scatter: Iterable[Scatter]) -> Campaign:
    """A campaign with the sigmas of these sensors as they scatter."""
    factors = np.ones(12 + len(campaign.gauges))
    for each in scatter:
        factors[each.channel] *= each.factor
    return replace(campaign, noise=campaign.noise.times(factors))


@kept
def _held_out(found: Fit, criteria: Criteria) -> tuple[BadReading, ...]:
    """Single bad ones of the tests that were held out, where these are off: as if they had been fitted."""
    if all(check.passed for check in judge(found, criteria).checks if check.name == HELD_OUT):
        return ()
    campaign = found.residual.load_cases.campaign
    held = {test.id for test in campaign.tests if test.role != "fit"}
    every = replace(campaign, tests=tuple(replace(test, role="fit") for test in campaign.tests))
    return tuple(
        each for each in bad_readings(_with_readings(found, load_cases(every)), criteria) if each.test in held
    )


def _with_readings(found: Fit, cases: LoadCases) -> Fit:
    """A fitted model as it is beside other readings of the same tests."""
    return unfitted(found.model, cases, carried(found.prediction, cases, found.residual.load_cases))


@kept
def _given(found: Fit, given: LoadCases) -> Fit:
    """The same beside all readings as they were given, which are asked about again and again."""
    return _with_readings(found, given)


def _refitted(cases: LoadCases, found: Fit, criteria: Criteria) -> Fit:
    """A model fitted to other readings of the same tests; as it is where only those that were held out are others."""
    if (same := unmoved(found, cases)) is not None:
        return same
    start = carried(found.prediction, cases, found.residual.load_cases)
    return fit(found.model, cases, start, None, criteria.plausible)


def other_sigmas(found: Fit, criteria: Criteria) -> Iterator[Scatter]:
    """Sensors whose scatter about a fit counts in the place of what was declared."""
    unexplained = not of_the_size_of_noise(found, criteria)
    for each in scatters(found):
        if each.differs(criteria, unexplained):
            yield each
