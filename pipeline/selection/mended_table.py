"""A table as it is or mended, and what single effects and two of them leave of it.

An effect of an unusual size (`pipeline.inference.prior.in_tails`) may be there: a base a hundred times softer than any.
But forces in kgf look like a hinge that is as soft. So it clears a table only where it leaves less than the mistake
does, one of a usual size where it leaves no more than a few times as much.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.declared_sigmas import trusted
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.prior import in_tails
from pipeline.inference.suitable import scale_for, sized_model
from pipeline.selection.cost import misfit
from pipeline.selection.criteria import Criteria
from pipeline.selection.determined import blind
from pipeline.selection.first_order import FirstOrder
from pipeline.selection.first_order_costs import estimates
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.mistakes.base import Mistake, columns_of
from vjm.effects.sized import all_sized

Array = NDArray[np.float64]


def usual(found: Fit, criteria: Criteria) -> bool:
    """Whether all effects have usual sizes."""
    return not in_tails(found.model.free, found.model.values, criteria.plausible)


def prescribed(cases: LoadCases, mistake: Mistake) -> bool:
    """Whether a column of a mistake prescribes anything."""
    names = np.isin(columns_of(cases.campaign), mistake.columns)
    return bool(np.any(np.isin(cases.channels, np.flatnonzero(names))))


def is_far(found: Fit) -> bool:
    """Whether a fit is off by more than half of what is read or predicted, as with every unit but the true one: there
    a first-order look says nothing."""
    cases, it = found.residual.load_cases, found.prediction
    there = cases.predicted & cases.fitted[:, None] & ~it.lost[:, None]
    read, said, sigma = (values[there] for values in (cases.measured, it.values, cases.spread))
    size = np.maximum(np.abs(read), np.abs(said))
    return bool(2.0 * np.linalg.norm((read - said) / sigma) > np.linalg.norm(size / sigma))


@dataclass(frozen=True)
class Left:
    """The least that effects leave, with what their sizes cost: of usual sizes, and of unusual ones."""

    usual: float
    unusual: float = np.inf

    def or_that(self, found: Fit, left: float, criteria: Criteria) -> Left:
        """Or what a further fit leaves."""
        if usual(found, criteria):
            return replace(self, usual=min(self.usual, left))
        return replace(self, unusual=min(self.unusual, left))

    def clears(self, after: float, noise: float, factor: float) -> bool:
        """Whether a table is right by these, of which a mistake leaves so much where it is mended. What leaves less
        than noise explains no more than noise does."""
        return max(after, noise) * factor > self.usual or after >= self.unusual


@dataclass(frozen=True, eq=False)
class Table:
    """Fits of a table, and the set beside which mistakes are looked for: what is there or not."""

    cache: FitCache
    root: Names

    @classmethod
    def of(cls, cache: FitCache) -> Table:
        """Beside all that is there or not, with no number to fit: a right table is better explained with it."""
        return cls(cache, frozenset(name for name, it in cache.candidates.items() if not it.parameters))

    @property
    def fit(self) -> Fit:
        """Without any further effect."""
        return self.cache.fit(self.root)

    @property
    def plain(self) -> Table:
        """Beside nothing."""
        return replace(self, root=frozenset())

    def beside_rival(self, left: float) -> Table:
        """The same, of which no further fit goes on that would stay far above what another table leaves; such fits are
        kept for both."""
        return replace(self, cache=replace(self.cache, rival=left))

    @cached_property
    def first_order(self) -> float:
        """What the best single effect leaves, to first order."""
        return self.first_order_of(self.fit)

    def first_order_of(self, found: Fit) -> float:
        """The same of a fit of a table that is like this one."""
        here = self.cache.first_order_about(found, self.root)
        gains = [here.within(name, *self._bounds(name)) for name in here.signatures]
        return max(found.chi_square - max(gains, default=0.0), 0.0)

    @cached_property
    def alone(self) -> float:
        """What the best single effect leaves of the table as it is: to first order, which says nothing of readings that
        are a few times what is predicted (dials in inches are a modulus of 25 times, far from null): then fitted."""
        near = self.first_order < self.cache.criteria.doctor_factor * max(self.fit.degrees, 1)
        return self.left[0] if near and is_far(self.fit) else self.first_order

    @cached_property
    def leaves_bounds(self) -> bool:
        """Whether an effect would explain most with a number beyond its bounds, to first order: what it does within
        them only a fit can tell."""
        here = self.cache.first_order_about(self.fit, self.root)
        gains = {name: here.gain([name]).value for name in here.signatures}
        return bool(gains) and not self._allowed(here, max(gains, key=gains.__getitem__))

    def _allowed(self, here: FirstOrder, name: str) -> bool:
        """Whether the numbers of an effect lie within its bounds, to first order: a stiffness below zero explains a
        lost sign."""
        _, sizes = here.alone(name)
        low, high = self._bounds(name)
        return bool(np.all((sizes >= low) & (sizes <= high)))

    def _bounds(self, name: str) -> tuple[Array, Array]:
        """(p,) each, of the numbers of an effect, in typical sizes from null."""
        parameters = self.cache.candidates[name].parameters
        ends = [[(bound - p.null) / p.typical for bound in (p.low, p.high)] for p in parameters]
        low, high = np.sort(np.array(ends), axis=1).T
        return low, high

    @cached_property
    def sets(self) -> tuple[Names, ...]:
        """Single effects that promise most, fitted."""
        cache, root = self.cache, self.root
        there = cache.first_order(root)
        known = root | set(cache.base.names)
        single = {
            name: there.gain([name]).value
            for name in there.signatures
            if known >= set(cache.candidates[name].includes)
        }
        leaders = sorted(single, key=lambda name: -single[name])[: cache.criteria.doctor_effects]
        sets = tuple(root | {name} for name in leaders)
        cache.fit_all({names: {} for names in sets})
        return sets

    @cached_property
    def left(self) -> tuple[float, Names]:
        """What the best of them that has a usual size leaves, and the set."""
        cache, root, sets = self.cache, self.root, self.sets
        best = min(
            [root, *(n for n in sets if usual(cache.fit(n), cache.criteria))], key=lambda n: misfit(cache, n)
        )
        return misfit(cache, best), best

    @cached_property
    def left_at_any_size(self) -> tuple[float, Names]:
        """The same of one of any size; nothing is fitted where to first order none takes nearly all."""
        cache, root = self.cache, self.root
        doubt = cache.criteria.estimate_error**2 * self.fit.chi_square + cache.criteria.doctor_tie
        sets = self.sets if self.first_order < doubt else ()
        best = min((root, *sets), key=lambda names: cache.fit(names).order)
        return cache.fit(best).chi_square, best

    def left_by_two(self, singles: Iterable[Names]) -> Left:
        """What the best two effects leave, one of them that of these sets: of the second ones those that promise most,
        fitted. The best single effect, where that leaves less."""
        cache, two = self.cache, list[Names]()
        for single in singles:
            more = [each.names for each in estimates(cache, single, (1,)) if each.names != single]
            some = more[: cache.criteria.doctor_effects]
            cache.fit_all({names: {} for names in some})
            two += some
        out = Left(self.left[0])
        for names in (*self.sets, *two):
            new = out.or_that(cache.fit(names), misfit(cache, names), cache.criteria)
            # Two that do the same go beyond what one of them may be.
            if new != out and (names in self.sets or not blind(cache.fit(names), cache.whole)):
                out = new
        return out

    def mended(self, mistake: Mistake) -> Table:
        """The table without a mistake, with the sigmas that its scatter then allows. Where it prescribes otherwise no
        state and no number of the table as it is is near."""
        it, campaign = self.cache, mistake.mended(self.cache.whole.campaign)
        # Bars that are a thousand times stiffer have other typical sizes.
        base, candidates = sized_model(it.base, campaign), all_sized(it.candidates, scale_for(campaign))
        cases = load_cases(trusted(campaign, base))
        before = None if prescribed(it.whole, mistake) else it
        new = FitCache(cases, base, candidates, it.on_progress, it.criteria, before=before, since=it.since)
        return replace(self, cache=new)
