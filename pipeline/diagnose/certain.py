"""What is certain though not all is explained: effects without which far more is left, whatever sensors did beside.

For an effect of the best set the rival is the best set without it, other effects allowed. Both may have patterns of
sensors (`pipeline.adequacy.free_patterns`): the best set as many as its rest needs to look like noise, the rival two
more. The effect is certain where the rival is still worse by far.
"""

from __future__ import annotations

from pipeline.adequacy.free_patterns import falls
from pipeline.diagnose.estimates import estimates
from pipeline.diagnose.merit import badness, cost
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.shelf import Names, Shelf


def certain(found: Found, sets: tuple[Names, ...]) -> tuple[str, ...]:
    """Names of the effects with numbers that are in all sets of a verdict and that nothing else replaces."""
    shelf, criteria = found.shelf, found.shelf.criteria
    best = sets[0]
    common = frozenset.intersection(*sets)
    names = [n for n in shelf.order(common) if shelf.candidates[n].parameters]
    if not names:
        return ()
    fit = shelf.fit(best)
    mine = falls(fit, criteria, criteria.certain_patterns)
    limit = fit.degrees + criteria.excess_deviations * (2.0 * max(fit.degrees, 1)) ** 0.5
    count = next((k for k, left in enumerate(mine) if left <= limit), len(mine) - 1)
    beside = badness(shelf, best) - mine[0]
    needed = (criteria.certain_sigmas * max(1.0, fit.rms)) ** 2
    least = mine[count] + beside + needed
    return tuple(name for name in names if _beaten(shelf, best, name, count + criteria.certain_more, least))


def _beaten(shelf: Shelf, best: Names, name: str, patterns: int, least: float) -> bool:
    """Whether every rival without an effect leaves more than this with so many patterns."""
    for rival in _rivals(shelf, best, name):
        left = falls(shelf.fit(rival), shelf.criteria, patterns)
        if badness(shelf, rival) - left[0] + left[-1] < least:
            return False
    return True


def _rivals(shelf: Shelf, best: Names, name: str) -> list[Names]:
    """The set without the effect and what cannot be without it, with the best other effects beside, and the best sets
    without it that were fitted."""
    needs = {n for n in best if name in shelf.candidates[n].includes}
    start = best - {name} - needs
    shelf.fit_all({start: {}})
    wanted = shelf.criteria.certain_rivals
    near = [e for e in estimates(shelf, start, (1,)) if e.names != start and name not in e.names]
    shelf.fit_all({e.names: e.probes for e in near[:wanted]})
    known = sorted((n for n in shelf.fits if name not in n), key=lambda n: cost(shelf, n))
    return list(dict.fromkeys([start, *(e.names for e in near[:wanted]), *known[:wanted]]))
