"""One search of a campaign's effects, and the verdict on what it found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pipeline.adequacy.judgement import judge
from pipeline.adequacy.untested import untested
from pipeline.attempt import Attempts
from pipeline.diagnose.beyond import with_what_held_out_tests_need
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.ruling import Ruling, ruled
from pipeline.diagnose.search import first_root, search, search_one_by_one
from pipeline.diagnose.sensor_faults import plain_zero
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.inference.fit import Fit, unfitted


@dataclass(frozen=True, eq=False)
class Chosen:
    """What the criteria choose of all fits. untested: why nothing can be tested, or ""."""

    found: Found
    ruling: Ruling
    untested: str = ""


def chosen(shelf: Shelf, attempts: Attempts, alone: bool = False, begun: Sequence[Names] = ()) -> Chosen:
    """The verdict and what it rests on. What is optional and fails is said in the attempts. alone: whether no more than
    the best single effect is looked for. begun: the single effects beside the first root that were fitted, if any."""
    before = beginning(shelf)
    if why := untested(before):
        found = Found(shelf, frozenset(), ())
        return Chosen(found, Ruling("nothing_tested", (frozenset(),), before), why)
    if plain_zero(before, shelf.criteria):
        found = search_one_by_one(shelf, frozenset())
    elif alone:
        shelf.ends = np.inf
        found = search_one_by_one(shelf, first_root(shelf), begun)
    else:
        found = with_what_held_out_tests_need(search(shelf, begun))
    judgement = judge(shelf.fit(found.best), shelf.criteria)
    shelf.say("what else could explain it")
    return Chosen(found, ruled(found, judgement, attempts))


def beginning(shelf: Shelf) -> Fit:
    """The base model fitted, or as it is where no fitted test has a reading to fit it to."""
    whole = shelf.whole
    if not (whole.predicted & whole.fitted[:, None]).any():
        shelf.fits[frozenset()] = unfitted(shelf.base, whole)
    return shelf.fit(frozenset())
