"""Whether neighbouring readings of a sensor are alike: noise that is correlated, one explanation of what has an order.

Beside a verdict it says how far intervals may be wider; where nothing known explains the rest, that this would, and
beside which effects: the fewest of the best set, since order along the load paths may have let others in.
"""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.adequacy.correlated import Correlated, correlated
from pipeline.diagnose.ruling import Ruling
from pipeline.diagnose.shelf import Names, Shelf


@dataclass(frozen=True)
class AlikeRows:
    """sensors: those whose noise is correlated from row to row, none where no such noise explains all that is left
    beside these effects."""

    sensors: tuple[Correlated, ...] = ()
    beside: Names = frozenset()


NONE = AlikeRows()


def alike_rows(shelf: Shelf, ruling: Ruling) -> AlikeRows:
    """Beside the first set of a verdict; where that is `unknown`, beside the smallest part of it that will do."""
    best, criteria = ruling.sets[0], shelf.criteria
    sensors = correlated(ruling.fit, criteria)
    if not sensors or ruling.verdict != "unknown":
        return AlikeRows(sensors, best)
    for names in sorted((n for n in shelf.fits if n < best), key=len):
        if fewer := correlated(shelf.fit(names), criteria):
            return AlikeRows(fewer, names)
    return AlikeRows(sensors, best)
