"""With few rows a fit costs little, and what is far from a solution is too curved for first-order estimates: sets are
grown by everything, side by side.
"""

from __future__ import annotations

from pipeline.diagnose.estimates import estimates
from pipeline.diagnose.merit import cost, is_noise, root_of, taken
from pipeline.diagnose.shelf import Names, Shelf


def few(shelf: Shelf) -> bool:
    """Whether no more rows are fitted than that."""
    return int(shelf.whole.fitted.sum()) <= shelf.criteria.few_steps


def leading(shelf: Shelf, sets: set[Names]) -> list[Names]:
    """The best of these sets, as many as are grown side by side: where every row is lost no slope says by what."""
    rows = shelf.whole.fitted
    able = [names for names in sets if not shelf.fit(names).prediction.lost[rows].all()]
    return sorted(able, key=lambda names: cost(shelf, names))[: shelf.criteria.few_sets]


def grown_by_everything(shelf: Shelf, starts: list[Names], roots: list[Names]) -> list[Names]:
    """The best sets of every root that explains nothing yet, with one effect more: what the best root is shows then."""
    grown: list[Names] = []
    for root in roots:
        like = {root, *(names for names in (*starts, *grown) if root_of(shelf, names) == root)}
        if any(is_noise(shelf, names) for names in like):
            continue
        for names in leading(shelf, like - {root}):
            grown += [e.names for e in estimates(shelf, names, (1,)) if e.names != names]
    return grown


def fit_together(shelf: Shelf, best: Names) -> None:
    """Fit those that explain only together and take no more numbers than the best set: one of many numbers, that is
    looked at alone, would hide them."""
    root, room = root_of(shelf, best), taken(shelf, best)
    begun = {
        n
        for n in shelf.fits
        if n != root and root_of(shelf, n) == root and taken(shelf, n) < room and not is_noise(shelf, n)
    }
    for start in leading(shelf, begun):
        for e in estimates(shelf, start, (1,)):
            if e.names != start and taken(shelf, e.names) <= room:
                shelf.fit(e.names, e.probes)
