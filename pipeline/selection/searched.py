"""One search of a campaign's effects, and the verdict on what it found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pipeline.attempt import Attempts
from pipeline.inference.fit import Fit, unfitted
from pipeline.selection.adequacy.judgement import HELD_OUT, judge
from pipeline.selection.adequacy.untested import untested
from pipeline.selection.cost import misfit
from pipeline.selection.exclusion import possible
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.rivals import Found
from pipeline.selection.search import first_root, search, search_one_by_one
from pipeline.selection.sensor_faults import more_than_zero, plain_zero
from pipeline.selection.verdict import Decision, ruled


@dataclass(frozen=True, eq=False)
class Chosen:
    """What the criteria choose of all fits. untested: why nothing can be tested, or ""."""

    found: Found
    decision: Decision
    untested: str = ""


def chosen(cache: FitCache, attempts: Attempts, alone: bool = False, begun: Sequence[Names] = ()) -> Chosen:
    """The verdict and what it rests on. What is optional and fails is said in the attempts. alone: whether no more than
    the best single effect is looked for. begun: the single effects beside the first root that were fitted, if any."""
    before = beginning(cache)
    if why := untested(before):
        found = Found(cache, frozenset(), ())
        return Chosen(found, Decision("nothing_tested", (frozenset(),), before), why)
    found = _zero_alone(before, cache) or _in_depth(cache, alone, begun)
    judgement = judge(cache.fit(found.best), cache.criteria)
    cache.on_progress("what else could explain it")
    return Chosen(found, ruled(found, judgement, attempts))


def _zero_alone(before: Fit, cache: FitCache) -> Found | None:
    """What single effects explain, where a sensor's zero explains far more; None where it does not."""
    if not plain_zero(before, cache.criteria):
        return None
    found = search_one_by_one(cache, frozenset())
    return None if more_than_zero(before, cache.fit(found.best), cache.criteria) else found


def _in_depth(cache: FitCache, alone: bool, begun: Sequence[Names]) -> Found:
    if alone:
        cache.ends = np.inf
        return search_one_by_one(cache, first_root(cache), begun)
    return _with_what_held_out_tests_need(search(cache, begun))


def _with_what_held_out_tests_need(found: Found) -> Found:
    """The same, or with an effect that is there or not added to the best set and its rivals.

    Tests that were held out decide on physics without a number to fit, where the fitted tests do not show it: whether
    bars have their geometric stiffness does not show under small loads, and a model without it is as good; tests with
    larger deflections that were held out then fail, though nothing is missing that is not known. No other choice is
    left to them: what has numbers is chosen by the fitted tests alone.
    """
    cache, best = found.cache, found.best
    if [check.name for check in judge(cache.fit(best), cache.criteria).checks if not check.passed] != [
        HELD_OUT
    ]:
        return found
    for name, effect in cache.candidates.items():
        more: Names = best | {name}
        if effect.parameters or more == best:
            continue
        # That the fitted tests may like it a little less is chance: what it leaves of them is noise as well.
        if judge(cache.fit(more), cache.criteria).noise:
            # With it the data may exclude less than they did without.
            worst = misfit(cache, best) + cache.criteria.held_out_gap
            near = [n for n in cache.fits if len(n) <= len(best) and misfit(cache, n) < worst]
            sets = list(dict.fromkeys(n | {name} for n in near))
            return replace(found, best=more, rivals=tuple(possible(cache, sets, more)), beyond=name)
    return found


def beginning(cache: FitCache) -> Fit:
    """The base model fitted, or as it is where no fitted test has a reading to fit it to."""
    whole = cache.whole
    if not (whole.predicted & whole.fitted[:, None]).any():
        cache.fits[frozenset()] = unfitted(cache.base, whole)
    return cache.fit(frozenset())
