"""Laws of the tests of a diagnosis, looked for from a model, and what they are to the effects that it knows."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

from pipeline.callbacks import OnProgress
from pipeline.discover.by_name import effects_of
from pipeline.discover.record import Discovered
from pipeline.discover.recording import recorded
from pipeline.discover.search import Discovery, discover, in_its_place
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.fit_cache import Names

Looked = tuple[Diagnosis, Discovery | None]


def fitted(it: Diagnosis) -> LoadCases:
    """The tests that may be fitted, as they were settled."""
    whole = it.campaign
    return load_cases(replace(whole, tests=tuple(test for test in whole.tests if test.role == "fit")))


def discovered(it: Diagnosis, start: Model, on_progress: OnProgress, but: Names = frozenset()) -> Discovery:
    """What is found from a model. but: effects that may not enter it."""
    effects = {name: effect for name, effect in it.cache.candidates.items() if name not in but}
    return discover(fitted(it), start, effects, on_progress)


def explains(it: Diagnosis, found: Discovery) -> bool:
    """Whether nothing but noise is left beside what was found, and no place at which a function explains it."""
    if found.end.lost or found.last.best >= it.cache.criteria.law_proposed:
        return False
    return judge(found.end, it.cache.criteria).noise


def less_certain(it: Diagnosis, found: Discovery) -> Diagnosis:
    """What laws explain without an effect makes that effect less than certain, and so does a law at a place where a
    function does what the effect does, but where it is that effect by another name."""
    acting = {name for law in found.laws for name in in_its_place(law, constant=False)}
    there = (set(found.end.model.names) - acting) | effects_of(found, it.cache.candidates)
    return replace(it, certain=tuple(name for name in it.certain if name in there))


def record(it: Diagnosis, found: Discovery, begin: float) -> Discovered:
    """What was found since that time (`perf_counter`), as a record."""
    return recorded(found, it.campaign, perf_counter() - begin)
