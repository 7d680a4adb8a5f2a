"""Whether neighbouring readings of a sensor are alike: noise that is correlated, one explanation of what has an order.

Beside a verdict it says how far intervals may be wider; where nothing known explains the rest, that this would, and
beside which effects: the fewest of the best set, since order along the load paths may have let others in.
"""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.selection.adequacy.correlated import Correlated, correlated
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.verdict import Decision


@dataclass(frozen=True)
class AlikeRows:
    """sensors: those whose noise is correlated from row to row, none where no such noise explains all that is left
    beside these effects."""

    sensors: tuple[Correlated, ...] = ()
    beside: Names = frozenset()


NONE = AlikeRows()


def alike_rows(cache: FitCache, decision: Decision) -> AlikeRows:
    """Beside the first set of a verdict; where that is `unknown`, beside the smallest part of it that will do."""
    best, criteria = decision.sets[0], cache.criteria
    sensors = correlated(decision.fit, criteria)
    if not sensors or decision.verdict != "unknown":
        return AlikeRows(sensors, best)
    for names in sorted((n for n in cache.fits if n < best), key=len):
        if fewer := correlated(cache.fit(names), criteria):
            return AlikeRows(fewer, names)
    return AlikeRows(sensors, best)
