"""What the parts of a diagnosis may take beside its searches.

A search has a bound of its own (`FitCache.work`), and none is begun where as much was done (`FitCache.worn_out`). The
looks before it are counted from where the campaign was first looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager

from pipeline.inference.solvers import WORK, allowance
from pipeline.selection.fit_cache import FitCache
from vjm.work import at_most, spent

MISTAKES = 2.0
"""Works of a search, for the look for mistakes of the table: up to 1.4 in tables that have one, 0.34 in right ones of
the tests, 0.02 in benches of the challenge."""
BESIDE = 1.0 / 7.0
"""The same for a look at one mistake, once another leaves hardly more than noise: those that end took up to 0.09."""
TWO = 3.0
"""The same with the look for two smooth effects that explain as much as a mistake."""
KINKED = 3.0
"""The same with that for effects with kinks as well: up to 2.6 (an axis that was not zeroed)."""

EXCHANGED = 0.5
"""Of what is left of a search's work, for effects in the places of others: rivals and faults of sensors come after."""


@contextmanager
def until(cache: FitCache, searches: float) -> Iterator[None]:
    """TooMuch where more is done in it than is left of so many searches."""
    with at_most(searches * cache.work - (spent() - cache.since)):
        yield


def for_exchange(cache: FitCache) -> AbstractContextManager[None]:
    """TooMuch where more is done in it than that."""
    return at_most(EXCHANGED * (cache.work - (spent() - cache.since)))


def for_faults(cache: FitCache) -> AbstractContextManager[None]:
    """TooMuch where the look for faults of sensors takes more than fits of those that are looked at, each with all that
    a fit may take: 0.6 works of a search, of which benches took up to 0.24."""
    return at_most(cache.criteria.faults_looked_at * WORK * allowance(cache.whole))
