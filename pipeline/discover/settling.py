"""Single bad readings beside a function at a site: set aside before any law is proposed, for one of them may look like
a law of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pipeline.adequacy.bad_readings import BadReading, bad_readings
from pipeline.discover.locating import Map
from pipeline.inference.fit import Fit
from pipeline.selection.criteria import CRITERIA


def bad_beside(seen: Map) -> tuple[BadReading, ...]:
    """Single bad readings of a map's fit, with the function at its best site fitted as freely as its knots allow."""
    found = seen.found
    if not seen.sites:
        return bad_readings(found, CRITERIA)
    columns = seen.sites[0].evidence.site.values
    left = found.residual
    slopes = np.zeros((*left.values.shape, columns.shape[1]))
    slopes[left.rows[:, 0], left.rows[:, 1]] = columns
    return bad_readings(Fit(found.model, found.prediction, replace(left, slopes=slopes), 0), CRITERIA)
