"""Tests that were held out decide on physics without a number to fit, where the fitted tests do not show it.

Whether bars have their geometric stiffness does not show under small loads, and a model without it is as good; tests
with larger deflections that were held out then fail, though nothing is missing that is not known. No other choice is
left to them: what has numbers is chosen by the fitted tests alone.
"""

from __future__ import annotations

from dataclasses import replace

from pipeline.selection.adequacy.judgement import HELD_OUT, judge
from pipeline.selection.cost import misfit
from pipeline.selection.exclusion import possible
from pipeline.selection.fit_cache import Names
from pipeline.selection.rivals import Found


def with_what_held_out_tests_need(found: Found) -> Found:
    """The same, or with an effect that is there or not added to the best set and its rivals."""
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
