"""One search of a campaign's effects, and the verdict on what it found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pipeline.attempt import Attempts
from pipeline.inference.fit import Fit, unfitted
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.adequacy.untested import untested
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.held_out import with_what_held_out_tests_need
from pipeline.selection.rivals import Found
from pipeline.selection.search import first_root, search, search_one_by_one
from pipeline.selection.sensor_faults import plain_zero
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
    if plain_zero(before, cache.criteria):
        found = search_one_by_one(cache, frozenset())
    elif alone:
        cache.ends = np.inf
        found = search_one_by_one(cache, first_root(cache), begun)
    else:
        found = with_what_held_out_tests_need(search(cache, begun))
    judgement = judge(cache.fit(found.best), cache.criteria)
    cache.on_progress("what else could explain it")
    return Chosen(found, ruled(found, judgement, attempts))


def beginning(cache: FitCache) -> Fit:
    """The base model fitted, or as it is where no fitted test has a reading to fit it to."""
    whole = cache.whole
    if not (whole.predicted & whole.fitted[:, None]).any():
        cache.fits[frozenset()] = unfitted(cache.base, whole)
    return cache.fit(frozenset())
