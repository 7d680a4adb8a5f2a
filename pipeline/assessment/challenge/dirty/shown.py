"""How far a knocked reading shows: the mean of the score by which the best method sees it.

A reading that is off by s of its true sigmas moves the whitened residuals by s times a column c, and what tolerances
and unknown zeros can move of it is seen by none: about the true model its score is normal about s·|c'|, c' the rest of
the column (W. Baarda, A testing procedure for use in geodetic networks, Netherlands Geodetic Commission 2-5, 1968:
|c'|² is the redundancy number of the reading). What was prescribed and moves nothing that is read has |c'| near zero,
however far it is off. Bonferroni's bound over all readings is passed by nine of ten that are 1.28 beyond it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.stats import norm

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.dirty.dirt import Knock
from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.reading_errors import ReadingErrors
from pipeline.selection.criteria import CRITERIA
from vjm.effects import catalogue

POWER = 0.9
"""Probability of being seen from which a bad reading shows."""


def shown(whole: Campaign, knocks: Sequence[Knock]) -> frozenset[Knock]:
    """Those of the bad readings that such a method sees in nine of ten noises. whole: the campaign with them."""
    if not knocks:
        return frozenset()
    found = unfitted(Model().with_effects([catalogue()[ALWAYS]]), load_cases(whole))
    of = ReadingErrors.of(found)
    count = max(int(of.there.sum()), 1)
    enough = float(norm.isf(0.5 * CRITERIA.false_alarm / count) + norm.ppf(POWER))
    return frozenset(it for it in knocks if max(_scores(found, of, it), default=0.0) > enough)


def _scores(found: Fit, of: ReadingErrors, knock: Knock) -> Iterator[float]:
    """Its mean score, as what is compared and as what was prescribed."""
    cases = found.residual.load_cases
    row = int(np.flatnonzero(cases.test == knock.test)[knock.row])
    for number in np.flatnonzero(of.there[row] & (of.channels[row] == knock.channel)):
        column = np.zeros(of.columns.shape[:2])
        column[row] = of.columns[row, :, number]
        yield abs(knock.sigmas) * float(np.linalg.norm(found.residual.free(column)))
