"""A diagnosis with the laws beyond the catalogue: of what nothing known explains, and against sets of effects.

What is left by a model that explains nothing more is looked at from what is certain, and a pattern inside the noise
from the model itself; sets that explain all compete with laws (`pipeline.discover.competition`).
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from time import perf_counter

from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.discover.competition import competing
from pipeline.discover.elements import NoSites
from pipeline.discover.looking import Looked, discovered, explains, less_certain, record
from pipeline.discover.search import Discovery
from pipeline.discover.words import law_sentences, sentences
from pipeline.selection.cost import root_of
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.fit_cache import Names


def with_laws(it: Diagnosis, on_progress: OnProgress = lambda _: None) -> Diagnosis:
    """The diagnosis with the laws that are found, and its verdict where they explain as much as its sets.

    Optional: what fails here is said and takes nothing else with it. On a rig without places of laws it is as it was.
    """
    return looked(it, on_progress)[0]


def looked(it: Diagnosis, on_progress: OnProgress = lambda _: None) -> Looked:
    """The diagnosis `with_laws`, and what was found on the way; None where laws were not looked for."""
    if not _asked(it):
        return it, None
    begin, attempts = perf_counter(), Attempts()
    nothing: Looked = (it, None)
    done, found = attempts.get(
        "the look for laws beyond the catalogue", partial(_where_there_are_sites, it, on_progress), nothing
    )
    seconds = round(it.seconds + perf_counter() - begin, 3)
    return replace(done, failed=(*it.failed, *attempts.failed), seconds=seconds), found


def _asked(it: Diagnosis) -> bool:
    """Whether anything is to be found by laws: not before the table is settled. A zero that is open is asked about
    first, but what is certain beside it has to stand against laws."""
    if it.untested or it.doctor or it.decision.unlooked or it.verdict == "nothing_tested":
        return False
    if it.decision.zero is not None and not it.certain:
        return False
    return bool(it.cache.whole.fitted.any())


def _where_there_are_sites(it: Diagnosis, on_progress: OnProgress) -> Looked:
    try:
        return _with_laws(it, on_progress)
    except NoSites:
        return it, None


def _with_laws(it: Diagnosis, on_progress: OnProgress) -> Looked:
    best, settled = frozenset(it.sets[0]), it.decision.zero is None
    if it.judgement.noise and settled and best - root_of(it.cache, best):
        return competing(it, best, on_progress)
    begin, found = perf_counter(), _beside_certain(it, on_progress)
    if not found.laws and (it.judgement.noise or not settled):
        return it, found
    if not settled and not explains(it, found):
        return it, found
    made = record(it, found, begin)
    words = law_sentences(made) if found.laws else sentences(made)[:1]
    done = less_certain(it, found) if found.laws else it
    return replace(done, laws=made.laws, law_words=words), found


def _beside_certain(it: Diagnosis, on_progress: OnProgress) -> Discovery:
    """Laws beside what is certain; without it where laws explain all by themselves and no worse: then it was a law by
    the name of what looks most like it."""
    sure: Names = frozenset(it.certain)
    start = it.cache.with_own_line(sure).model if sure else it.cache.base
    found = discovered(it, start, on_progress)
    if not sure or (explains(it, found) and not found.laws):
        return found
    alone = discovered(it, it.cache.base, on_progress)
    if not alone.laws or not explains(it, alone):
        return found
    no_worse = alone.end.chi_square <= found.end.chi_square + CRITERIA.law_alike
    return alone if no_worse or not explains(it, found) else found
