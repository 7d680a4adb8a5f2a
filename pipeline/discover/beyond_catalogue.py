"""A diagnosis with the laws beyond the catalogue: of what nothing known explains, and against sets of several effects.

Sets of effects mimic laws: a bushing that stiffens with load looks like a compliance and a contact together. So a set
of several effects and the laws that are found without it compete by one number,

    chi-square of the fitted tests + what implausible sizes cost + k ln n,

k numbers and n readings (G. Schwarz, The Annals of Statistics 6 (1978) 461-464). What is left by a model that explains
nothing more is looked at from what is certain, and a pattern inside the noise from the model itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import numpy as np

from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.discover.elements import NoSites
from pipeline.discover.locating import mapped
from pipeline.discover.record import Discovered
from pipeline.discover.recording import recorded
from pipeline.discover.search import Discovery, discover, fitted_to
from pipeline.discover.words import law_sentences, sentences
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.bad_readings import set_aside
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.cost import misfit, root_of, taken
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.fit_cache import Names

Looked = tuple[Diagnosis, Discovery | None]


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
    """Whether anything is to be found by laws: not before the table is settled."""
    if it.untested or it.doctor or it.decision.unlooked or it.decision.zero is not None:
        return False
    if it.verdict == "nothing_tested":
        return False
    return bool(it.cache.whole.fitted.any())


def _where_there_are_sites(it: Diagnosis, on_progress: OnProgress) -> Looked:
    try:
        return _with_laws(it, on_progress)
    except NoSites:
        return it, None


def _with_laws(it: Diagnosis, on_progress: OnProgress) -> Looked:
    best = frozenset(it.sets[0])
    if it.judgement.noise and best:
        return _competing(it, best, on_progress)
    begin, found = perf_counter(), _beside_certain(it, on_progress)
    if not found.laws and it.verdict == "within_noise":
        return it, found
    record = _record(it, found, begin)
    words = law_sentences(record) if found.laws else sentences(record)[:1]
    done = _less_certain(it, found) if found.laws else it
    return replace(done, laws=record.laws, law_words=words), found


def _beside_certain(it: Diagnosis, on_progress: OnProgress) -> Discovery:
    """Laws beside what is certain; without it where laws explain all by themselves, and beside it they do not: then it
    was a law by the name of what looks most like it."""
    sure: Names = frozenset(it.certain)
    start = it.cache.with_own_line(sure).model if sure else it.cache.base
    found = _discovered(it, start, on_progress)
    if not sure or _explains(it, found):
        return found
    alone = _discovered(it, it.cache.base, on_progress)
    return alone if alone.laws and _explains(it, alone) else found


def _explains(it: Diagnosis, found: Discovery) -> bool:
    """Whether nothing but noise is left beside what was found."""
    return not found.end.lost and judge(found.end, it.cache.criteria).noise


def _competing(it: Diagnosis, best: Names, on_progress: OnProgress) -> Looked:
    """A set of effects against what laws explain without it. One effect alone mimics no law as well as that explains
    itself: it competes only where it leaves a pattern, and keeps its name against what is no better."""
    several = len(best - root_of(it.cache, best)) >= CRITERIA.law_several
    on_progress("whether a law explains as much")
    if not (_leaves_a_pattern(it, best) or (several and _may_compete(it, best))):
        return it, None
    begin, found = perf_counter(), _discovered(it, it.cache.base, on_progress)
    law, own = _standing(it, found), best - root_of(it.cache, best)
    if law is None or not 0 < len(found.laws) <= len(own) or _effects_of(found) | law.beside == own:
        return it, found
    behind = law.cost - min(_cost_of_set(it, names) for names in map(frozenset, it.sets))
    if law.beside:
        # No rival by itself, but what it explains as well without an effect takes that off what is certain.
        return (it if behind > 0.0 else _less_certain(it, found)), found
    # Where each row chooses its side of a gap that takes up noise: it is never better than a set by that alone.
    kinked = any(each.ways[0].formed.form.kinked for each in found.laws)
    alone = -CRITERIA.law_alike if kinked else 0.0
    if behind > (CRITERIA.law_alike if several else alone):
        return it, found
    told = _told(found, law)
    if kinked or behind >= -CRITERIA.law_alike:
        decision = replace(it.decision, verdict="ambiguous", law=told)
    else:
        decision = replace(
            it.decision, verdict="unknown", because=f"{told} explains it by {-behind:.0f} better"
        )
    done, record = _less_certain(replace(it, decision=decision), found), _record(it, found, begin)
    return replace(done, laws=record.laws, law_words=law_sentences(record)), found


def _less_certain(it: Diagnosis, found: Discovery) -> Diagnosis:
    """What laws explain without an effect makes that effect less than certain."""
    there = {*found.end.model.names, *_effects_of(found)}
    return replace(it, certain=tuple(name for name in it.certain if name in there))


def _leaves_a_pattern(it: Diagnosis, best: Names) -> bool:
    """Whether a function at any site explains what a set leaves, its own numbers fitted anew beside it."""
    found = fitted_to(it.cache.fit(best).model, _fitted(it))
    sizes = it.cache.criteria.plausible * np.array([abs(f.parameter.typical) for f in found.model.free])
    own = found.residual.without_zeros(found.residual.slopes) * sizes
    return mapped(found, it.cache.candidates, own).best >= CRITERIA.law_left_by_set


def _may_compete(it: Diagnosis, best: Names) -> bool:
    """Whether any site explains nearly as much as a set: a law gains little more of chi-square than twice the evidence
    of a free function at its site."""
    without = it.cache.fit(root_of(it.cache, best))
    seen = mapped(fitted_to(without.model, _fitted(it)), it.cache.candidates)
    gained = without.chi_square - misfit(it.cache, best)
    return 2.0 * CRITERIA.law_gains * seen.best + CRITERIA.law_gains_more >= gained


@dataclass(frozen=True)
class _Law:
    """What all laws together leave and cost. numbers: of them. beside: effects that entered the model with them, and
    cost what they cost a set."""

    cost: float
    numbers: int
    beside: Names


def _standing(it: Diagnosis, found: Discovery) -> _Law | None:
    """What the laws that were found cost; None where they do not explain all, or by other readings."""
    if found.bad or not all(law.ways for law in found.laws):
        return None
    if not _explains(it, found):
        return None
    numbers = sum(law.ways[0].numbers for law in found.laws) + int(found.bent)
    # Choices of sides cost a law what they cost an effect.
    left = found.end.chi_square + found.end.residual.doubt + found.end.residual.spread
    beside = frozenset(found.end.model.names) & set(it.cache.candidates) - {*found.begin.model.names}
    return _Law(left + (numbers + taken(it.cache, beside)) * _of_one(it), numbers, beside)


def _cost_of_set(it: Diagnosis, names: Names) -> float:
    own = names - root_of(it.cache, names)
    return misfit(it.cache, names) + taken(it.cache, own) * _of_one(it)


def _of_one(it: Diagnosis) -> float:
    """What a number costs."""
    whole = it.cache.whole
    return float(np.log(max(int(np.sum(whole.predicted & whole.fitted[:, None])), 1)))


def _effects_of(found: Discovery) -> Names:
    """The effects of the catalogue that the laws are by another name."""
    every = [law.ways[0].formed.form.effects.get(law.site.name, ()) for law in found.laws if law.ways]
    return frozenset(name for names in every for name in names)


def _told(found: Discovery, law: _Law) -> str:
    places = " and ".join(each.site.name for each in found.laws)
    numbers = f"{law.numbers} number{'s' if law.numbers > 1 else ''}"
    return f"a law of {numbers} at {places}"


def _fitted(it: Diagnosis) -> LoadCases:
    """The tests that may be fitted, as they were settled."""
    whole = it.campaign
    return load_cases(replace(whole, tests=tuple(test for test in whole.tests if test.role == "fit")))


def _discovered(it: Diagnosis, start: Model, on_progress: OnProgress) -> Discovery:
    return discover(_fitted(it), start, it.cache.candidates, on_progress)


def _record(it: Diagnosis, found: Discovery, begin: float) -> Discovered:
    return recorded(found, load_cases(set_aside(it.campaign, found.bad)), perf_counter() - begin)
