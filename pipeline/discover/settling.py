"""What the readings are beside a function at a site, before any law is proposed: long tails of the noise, or single bad
readings, one of which may look like a law of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pipeline.adequacy.bad_readings import BadReading, bad_readings, set_aside
from pipeline.adequacy.tails import tails_of, without_tails
from pipeline.campaign import Campaign
from pipeline.discover.locating import Map, without_best
from pipeline.inference.fit import Fit
from pipeline.noise import lag_one
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
    if found.degrees >= CRITERIA.few_readings and _without_order(found):
        tails = tails_of(found, CRITERIA)
        if tails is not None:
            return Beside(normal=without_tails(found, tails))
    return Beside(bad_readings(found, CRITERIA))


def _without_order(found: Fit) -> bool:
    """Whether what is left has no order along the load paths: of more laws, tails say nothing."""
    rows, left = found.residual.rows, found.residual.flat(found.residual.left)
    keys = np.stack([found.residual.program.test[rows[:, 0]], rows[:, 1]], axis=1)
    series = [left[np.all(keys == key, axis=1)] for key in np.unique(keys, axis=0)]
    try:
        return lag_one(series).p_value >= CRITERIA.check_level
    except ValueError:
        return True
