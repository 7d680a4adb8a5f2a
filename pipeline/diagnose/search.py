"""The sets of effects that explain a campaign: looked for to first order, fitted, grown and pruned.

One effect at a time is misled where one alone makes things worse, so pairs are looked at from the start, and every
set that competes is fitted with the full model.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from pipeline.diagnose.evidence import APART, PLAUSIBLE, RAW, apart, entry, numbers
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.fit import Fit

WIDTH = 4
"""Sets of one size that are fitted, at most, of those that compete."""
MOST = 5
"""Effects in a set."""
ENOUGH = 24
"""Fits after which a search that has found nothing good goes on no further."""
FEW, NEARLY, BEAM = 20, 0.9, 3
"""Rows up to which a fit costs so little that every rival is fitted that promises a tenth of what it stands for, and
the sets that are grown by everything, side by side."""
FAR, SLOW = 2.0, 0.7
"""Sigmas from which an explanation is far from one; growth that leaves more than this part of chi-square is slow. What
is far from explained and falls slowly is not explained by more effects: so it ends as unknown."""
LEADERS = 7
"""Candidates of which pairs are looked at."""
DOUBT, KINKED = 0.15, 0.6
"""Part of what an effect explains by which its first-order estimate may be wrong; of one with kinks, from a probe."""


HOPELESS = 300.0
"""Times the least chi-square of the roots, beyond which a root is left out unseen."""


@dataclass(frozen=True)
class Estimate:
    """A set that could be fitted: to first order its cost, and where effects with kinks begin."""

    names: Names
    cost: float
    probes: dict[str, float]


@dataclass(frozen=True, eq=False)
class Found:
    """What was found. best: the set of least cost. rivals: sets as simple that the data do not exclude. beyond: an
    effect of the best set that only tests held out show, "" if there is none."""

    shelf: Shelf
    best: Names
    rivals: tuple[Names, ...]
    beyond: str = ""


def cost(shelf: Shelf, names: Names) -> float:
    """Chi-square of the fit, how far its numbers are from plausible ones, and what each effect has to show."""
    return badness(shelf, names) + price(shelf, names) + shelf.fit(names).residual.spread


def badness(shelf: Shelf, names: Names) -> float:
    """Chi-square of the fit, what choices of sides took off it, and of its numbers, each `PLAUSIBLE` typical sizes a
    sigma."""
    found = shelf.fit(names)
    return found.chi_square + found.residual.doubt + implausibility(found)


def implausibility(found: Fit) -> float:
    """Chi-square of the numbers alone."""
    return float(
        sum(
            ((value - f.parameter.null) / (PLAUSIBLE * f.parameter.typical)) ** 2
            for f, value in zip(found.model.free, found.model.values, strict=True)
        )
    )


def price(shelf: Shelf, names: Iterable[str]) -> float:
    """What the effects of a set have to show, in chi-square."""
    return sum(entry(shelf.candidates[name], len(shelf.candidates)) for name in names)


def search(shelf: Shelf) -> Found:
    """The best set, and those that may as well be true."""
    roots = _roots(shelf)
    starts: list[Names] = list(roots)
    for root in roots:
        starts += [e.names for e in _competing(shelf, root, 1)]
        # Where one effect leaves noise, a second is looked for about that fit: to first order about the root, the
        # curvature of a large effect looks like another.
        if not any(_is_noise(shelf, names) for names in starts):
            starts += [e.names for e in _competing(shelf, root, 2)]
    if _few(shelf):
        # Fits cost little, and what is far from a solution is too curved for first-order estimates: all are made,
        # about every root that explains nothing yet, since what the best root is shows only then.
        for root in roots:
            like = {root, *(names for names in starts if _root(shelf, names) == root)}
            if any(_is_noise(shelf, names) for names in like):
                continue
            for names in _leading(shelf, like - {root}):
                starts += [e.names for e in _estimates(shelf, names, (1,)) if e.names != names]
    best = min(starts, key=lambda names: cost(shelf, names))
    while True:
        better = _pruned(shelf, _grown(shelf, best))
        if cost(shelf, better) >= cost(shelf, best):
            break
        slow = shelf.fit(better).chi_square > SLOW * shelf.fit(best).chi_square
        best = better
        if slow and shelf.fit(best).rms > FAR:
            break
    return Found(shelf, best, ()) if shelf.fit(best).rms > FAR else with_rivals(shelf, best)


def _few(shelf: Shelf) -> bool:
    return int(shelf.whole.fitted.sum()) <= FEW


def _leading(shelf: Shelf, sets: set[Names]) -> list[Names]:
    """The best of these sets, as many as are grown side by side: where every row is lost no slope says by what."""
    rows = shelf.whole.fitted
    able = [names for names in sets if not shelf.fit(names).prediction.lost[rows].all()]
    return sorted(able, key=lambda names: cost(shelf, names))[:BEAM]


def _root(shelf: Shelf, names: Names) -> Names:
    """Those effects of a set that are there or not."""
    return frozenset(name for name in names if not shelf.candidates[name].parameters)


def _is_noise(shelf: Shelf, names: Names) -> bool:
    """Whether chi-square is no larger than noise makes it, within three of its standard deviations."""
    found = shelf.fit(names)
    return bool(found.chi_square < found.degrees + 3.0 * np.sqrt(2.0 * max(found.degrees, 1)))


def _roots(shelf: Shelf) -> list[Names]:
    """Sets of effects that are there or not, from which to look on; one that promises far less is left out."""
    switches = [name for name, effect in shelf.candidates.items() if not effect.parameters]
    roots = [frozenset(some) for k in range(len(switches) + 1) for some in combinations(switches, k)]
    least = min(shelf.fit(root).chi_square for root in roots)
    roots = [root for root in roots if shelf.fit(root).chi_square < HOPELESS * least]
    if len(roots) == 1:
        return roots
    promise = {
        root: min(cost(shelf, root), *(e.cost for e in _estimates(shelf, root, (1, 2)))) for root in roots
    }
    least = min(promise.values())
    return [root for root in roots if promise[root] < least + max(100.0, 0.5 * abs(least))]


def _estimates(shelf: Shelf, start: Names, counts: Iterable[int]) -> list[Estimate]:
    """Sets with so many further effects, to first order, best first; always at least one."""
    found = shelf.picture(start)
    every = [name for name in found.signatures if start >= set(shelf.candidates[name].includes)]
    left = found.fit.residual
    base = found.fit.chi_square + left.doubt + left.spread + price(shelf, start)
    single = {name: found.gain([name]) for name in every}
    leaders = sorted(single, key=lambda name: -single[name].value)[:LEADERS]
    out = [Estimate(start, base, {})]
    for count in counts:
        groups = [(n,) for n in single] if count == 1 else list(combinations(leaders, count))
        for group in groups:
            gain = single[group[0]] if count == 1 else found.gain(group)
            out.append(Estimate(start | set(group), base - gain.value + price(shelf, group), gain.probes))
    return sorted(out, key=lambda e: e.cost)


def _competing(shelf: Shelf, start: Names, count: int) -> list[Estimate]:
    """Those sets that may turn out best: fitted."""
    here = cost(shelf, start)
    every = [e for e in _estimates(shelf, start, (count,)) if e.names != start]
    best = min([here, *(cost(shelf, n) for n in shelf.fits), *(e.cost for e in every)])
    hoped = {e.names: e.cost - _doubt(shelf, e.names - start) * max(here - e.cost, 0.0) for e in every}
    within = [e for e in every if e.cost < here and hoped[e.names] < best + 2 * APART]
    within = sorted(within, key=lambda e: hoped[e.names])[:WIDTH]
    for e in within:
        shelf.fit(e.names, e.probes)
    return within


def _doubt(shelf: Shelf, names: Names) -> float:
    return DOUBT if all(shelf.candidates[name].smooth for name in names) else KINKED


def _grown(shelf: Shelf, start: Names) -> Names:
    """The best set with one effect more, or two; the same if none is better."""
    if len(start) >= MOST or len(shelf.fits) >= ENOUGH:
        return start
    here = shelf.fit(start)
    if here.rms > FAR and _estimates(shelf, start, (1, 2))[0].cost > SLOW * here.chi_square:
        return start
    # Where noise is all that is left, two that show only together have nothing to show.
    counts = (1,) if _is_noise(shelf, start) else (1, 2)
    more = [start, *(e.names for k in counts for e in _competing(shelf, start, k)[:2])]
    return min(more, key=lambda names: cost(shelf, names))


def _pruned(shelf: Shelf, names: Names) -> Names:
    """The set without what is no longer needed."""
    while names:
        fewer = [names - {name} for name in names if _dispensable(shelf, names, name)]
        best = min(fewer, key=lambda each: cost(shelf, each), default=names)
        if not fewer or cost(shelf, best) > cost(shelf, names):
            return names
        names = best
    return names


def _dispensable(shelf: Shelf, names: Names, name: str) -> bool:
    """Whether an effect, by its own numbers and their covariance, explains no more than a few times its price.

    One that is there or not is, unless what is there would be a hopeless root without it.
    """
    if not shelf.candidates[name].parameters:
        root = _root(shelf, names)
        return shelf.fit(root - {name}).chi_square < HOPELESS * shelf.fit(root).chi_square
    found = shelf.fit(names)
    mine = np.array([each.effect == name for each in found.model.free], dtype=bool)
    if not shelf.candidates[name].smooth:
        return True
    null = np.array([each.parameter.null for each in found.model.free])
    away = (found.model.values - null)[mine]
    covariance = found.covariance[np.ix_(mine, mine)]
    known = np.isfinite(np.diag(covariance))
    if not known.any():
        return True
    inner = covariance[np.ix_(known, known)]
    return float(away[known] @ np.linalg.solve(inner, away[known])) < 4.0 * price(shelf, [name])


def with_rivals(shelf: Shelf, best: Names) -> Found:
    """Every effect of the set is exchanged for every other; those that do as well are rivals."""
    for name in [n for n in best if shelf.candidates[n].parameters]:
        start = best - {name}
        gap = cost(shelf, start) - cost(shelf, best)
        few = _few(shelf)
        limit = cost(shelf, best) + max(25.0, (NEARLY if few else DOUBT) * gap)
        near = [
            e
            for e in _estimates(shelf, start, (1,))
            if e.names not in (start, best) and _raw(shelf, e) < limit
        ]
        for e in near[: None if few else WIDTH]:
            shelf.fit(e.names, e.probes)
    if _few(shelf):
        _fit_together(shelf, best)
    winner = min(shelf.fits, key=lambda names: cost(shelf, names))
    if winner != best:
        return with_rivals(shelf, winner)
    simple = [n for n in shelf.fits if len(n) <= len(best) or taken(shelf, n) <= taken(shelf, best)]
    return Found(shelf, best, tuple(sorted(possible(shelf, simple, best), key=lambda n: badness(shelf, n))))


def _fit_together(shelf: Shelf, best: Names) -> None:
    """Fit those that explain only together and take no more numbers than the best set: one of many numbers, that is
    looked at alone, would hide them."""
    root, room = _root(shelf, best), taken(shelf, best)
    begun = {
        n
        for n in shelf.fits
        if n != root and _root(shelf, n) == root and taken(shelf, n) < room and not _is_noise(shelf, n)
    }
    for start in _leading(shelf, begun):
        for e in _estimates(shelf, start, (1,)):
            if e.names != start and taken(shelf, e.names) <= room:
                shelf.fit(e.names, e.probes)


def possible(shelf: Shelf, sets: list[Names], best: Names) -> list[Names]:
    """Of these sets those that may as well be true.

    Several that fit alike are excluded together or not at all: each weighs as its likelihood, and what all that are
    excluded weigh together is no more than one of them may.
    """
    others = [n for n in sets if not n <= best and not best < n]
    kept = [n for n in others if not excluded(shelf, n, best)]
    kept = [n for n in kept if not any(other < n for other in kept)]
    gaps = {n: worse(shelf, n, best) - needed(shelf, n, best) for n in others if n not in kept}
    left = [
        n
        for n in gaps
        if not any(o < n for o in kept) and not any(o < n and gaps[o] <= gaps[n] for o in gaps)
    ]
    left.sort(key=lambda n: gaps[n])
    while left and sum(np.exp(-0.5 * gaps[n]) for n in left) > 1.0:
        kept.append(left.pop(0))
    return kept


def _raw(shelf: Shelf, e: Estimate) -> float:
    """Cost without the advantage of having few numbers."""
    return e.cost - price(shelf, e.names) + min(price(shelf, [n]) for n in e.names) * len(e.names)


def excluded(shelf: Shelf, rival: Names, best: Names) -> bool:
    """Whether the data speak against a rival."""
    return worse(shelf, rival, best) > max(RAW, needed(shelf, rival, best))


def worse(shelf: Shelf, rival: Names, best: Names) -> float:
    """Chi-square by which a rival is worse."""
    return badness(shelf, rival) - badness(shelf, best)


def needed(shelf: Shelf, rival: Names, best: Names) -> float:
    """Chi-square by which a rival has to be worse to be excluded: what tells two sets of as many numbers apart, what
    the numbers take up that one of them has more, as far as the data see them, and where rows choose sides in one of
    them alone, by how much that varies."""
    more = seen(shelf, best) - seen(shelf, rival)
    return apart(more) + abs(shelf.fit(rival).residual.spread - shelf.fit(best).residual.spread)


def seen(shelf: Shelf, names: Names) -> int:
    """Degrees of freedom that a set takes from these data: directions of its numbers that plausible sizes move by a
    sigma, and one for an effect that is there or not. What the data do not see fits no noise."""
    found = shelf.fit(names)
    scale = np.array([PLAUSIBLE * f.parameter.typical for f in found.model.free])
    sizes = np.linalg.svd(found.jacobian * scale, compute_uv=False) if scale.size else np.zeros(0)
    switches = sum(not shelf.candidates[name].parameters for name in names)
    return int(np.sum(sizes > 1.0)) + switches


def taken(shelf: Shelf, names: Iterable[str]) -> int:
    """Degrees of freedom that a set takes."""
    return sum(numbers(shelf.candidates[name]) for name in names)
