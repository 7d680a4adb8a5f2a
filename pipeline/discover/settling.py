"""What the readings are beside a function at a site, before any law is proposed: long tails of the noise, or single bad
readings, one of which may look like a law of its own."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.campaign import Campaign
from pipeline.discover.locating import Map, without_best
from pipeline.selection.adequacy.bad_readings import BadReading, bad_readings, set_aside
from pipeline.selection.adequacy.correlated import series_of, without_order
from pipeline.selection.adequacy.tails import tails_of, without_tails
from pipeline.selection.criteria import CRITERIA


@dataclass(frozen=True, eq=False)
class Beside:
    """bad: single bad readings. normal: the campaign with normal noise of as much information in the place of one with
    long tails, None where it has none."""

    bad: tuple[BadReading, ...] = ()
    normal: Campaign | None = None

    def applied(self, campaign: Campaign) -> Campaign | None:
        """The campaign as the readings are; None where they are as they were."""
        if self.normal is not None:
            return self.normal
        return set_aside(campaign, self.bad) if self.bad else None


def beside(seen: Map) -> Beside:
    """Of a map's fit, with the function at its best site fitted as freely as its knots allow."""
    found = without_best(seen)
    # Of more laws, tails say nothing.
    series = series_of(found, found.residual.flat(found.residual.level))
    if found.degrees >= CRITERIA.few_readings and without_order(series, CRITERIA.check_level):
        tails = tails_of(found, CRITERIA)
        if tails is not None:
            return Beside(normal=without_tails(found, tails))
    return Beside(bad_readings(found, CRITERIA))
