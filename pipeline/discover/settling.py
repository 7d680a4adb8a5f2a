"""What the readings are beside a function at a site, before any law is proposed: long tails of the noise, single bad
readings, one of which may look like a law of its own, or sensors that scatter otherwise than their sigmas say: where
these are too small, noise alone looks like a law."""

from __future__ import annotations

from pipeline.discover.locating import Map, without_best
from pipeline.selection.adequacy.bad_readings import bad_readings
from pipeline.selection.adequacy.correlated import series_of, without_order
from pipeline.selection.adequacy.tails import tails_of, without_tails
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.reading_noise import AS_DECLARED, Readings, other_sigmas


def beside(seen: Map) -> Readings:
    """Of a map's fit, with the function at its best site fitted as freely as its knots allow."""
    found = without_best(seen)
    # Of more laws, tails and other sigmas say nothing.
    series = series_of(found, found.residual.flat(found.residual.level))
    noise = found.degrees >= CRITERIA.few_readings and without_order(series, CRITERIA.check_level)
    tails = tails_of(found, CRITERIA) if noise else None
    if tails is not None:
        return Readings(tails=tails, normal=without_tails(found, tails))
    bad = bad_readings(found, CRITERIA)
    if bad:
        # Beside one a sensor seems to scatter more: sigmas are asked about once that is set aside.
        return Readings(bad)
    return Readings(scatter=tuple(other_sigmas(found, CRITERIA))) if noise else AS_DECLARED
