"""Laws against the effects of a verdict, by one number.

Sets of effects mimic laws: a bushing that stiffens with load looks like a compliance and a contact together. So a set
and the laws that are found without it compete by

    chi-square of the fitted tests + what implausible sizes cost + k ln n,

k numbers and n readings (G. Schwarz, The Annals of Statistics 6 (1978) 461-464). Of one effect alone those numbers
count that it needs: a compliance of six directions that gives in one is no dearer than a law there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from pipeline.callbacks import OnProgress
from pipeline.discover.by_name import effects_of, held_by
from pipeline.discover.locating import mapped
from pipeline.discover.looking import Looked, discovered, explains, fitted, less_certain, record
from pipeline.discover.search import Discovery, Law, fitted_to
from pipeline.discover.words import law_sentences
from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.selection.cost import misfit, root_of, taken
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.fit_cache import Names
from vjm.effects.sensor_fault import SensorFault

AT_NULL = 1e-3
"""Standard errors within which a number stands at null."""


def competing(it: Diagnosis, best: Names, on_progress: OnProgress) -> Looked:
    """The diagnosis after its sets have competed with laws, and what was found, where laws were looked for.

    best: the first set. A set of several is not named against laws that explain as much; one effect keeps its name
    where it is better by what is strong evidence, and wherever the laws are that effect by other words."""
    own = best - root_of(it.cache, best)
    several = len(own) >= CRITERIA.law_several
    on_progress("whether a law explains as much")
    if not (_may_compete(it, best) or (several and _leaves_a_pattern(it, best))):
        return it, None
    begin, last = perf_counter(), None
    for start, but in _starts(it, own, several):
        last = discovered(it, start, on_progress, but)
        known = it.cache.candidates
        last = last if effects_of(last, known) == own else _without_sides(it, last)
        rival = _standing(it, last, best)
        if rival is not None and rival.things <= len(own) and effects_of(last, known) | rival.beside != own:
            done = _judged(it, last, rival, own, begin)
            if done is not it:
                return done, last
    return it, last


def _starts(it: Diagnosis, own: Names, several: bool) -> Iterator[tuple[Model, Names]]:
    """Models to look for laws from, with effects that may not enter them: without anything, then beside what all sets
    have in common that is no sensor's fault."""
    yield it.cache.base, frozenset() if several else own
    common = frozenset.intersection(*map(frozenset, it.sets)) & own
    some = frozenset(name for name in common if not isinstance(it.cache.candidates[name], SensorFault))
    if some and some != own:
        yield it.cache.with_own_line(some).model, frozenset()


def _leaves_a_pattern(it: Diagnosis, best: Names) -> bool:
    """Whether a function at any site explains what a set leaves, its own numbers fitted anew beside it."""
    found = fitted_to(it.cache.fit(best).model, fitted(it))
    sizes = it.cache.criteria.plausible * np.array([abs(f.parameter.typical) for f in found.model.free])
    own = found.residual.without_zeros(found.residual.slopes) * sizes
    return mapped(found, it.cache.candidates, own).best >= CRITERIA.law_left_by_set


def _may_compete(it: Diagnosis, best: Names) -> bool:
    """Whether any site explains nearly as much as a set: a law gains little more of chi-square than twice the evidence
    of a free function at its site."""
    without = it.cache.fit(root_of(it.cache, best))
    seen = mapped(fitted_to(without.model, fitted(it)), it.cache.candidates)
    gained = without.chi_square - misfit(it.cache, best)
    return 2.0 * CRITERIA.law_gains * seen.best + CRITERIA.law_gains_more >= gained


@dataclass(frozen=True)
class _Rival:
    """Laws that explain as much as effects may. cost: what they leave and cost together. numbers: of them. things: laws
    and effects. beside: effects that are in the model with them, and cost what they cost a set. whole: whether they
    leave nothing but noise. kinked: whether rows choose their sides of one."""

    cost: float
    numbers: int
    things: int
    beside: Names
    whole: bool
    kinked: bool


def _without_sides(it: Diagnosis, found: Discovery) -> Discovery:
    """With another form of the last law in the place of one whose rows choose their sides of a gap, where one is no
    worse by what tells forms apart: a choice that takes up noise is no reason to hear no law."""
    law = found.steps[-1] if found.steps else None
    if not isinstance(law, Law) or not law.ways or not law.ways[0].formed.form.kinked or found.settled:
        return found
    ways = tuple(sorted(law.ways, key=lambda way: way.formed.form.kinked))
    if ways[0].formed.form.kinked:
        return found
    last = mapped(ways[0].fit, it.cache.candidates, known=[each.group[0] for each in found.laws])
    return replace(found, steps=(*found.steps[:-1], replace(law, ways=ways)), end=ways[0].fit, last=last)


def _standing(it: Diagnosis, found: Discovery, best: Names) -> _Rival | None:
    """What the laws that were found cost; None where there are none, where one has no form, or by other readings."""
    if found.settled or found.end.lost or not found.laws or not all(law.ways for law in found.laws):
        return None
    numbers = sum(law.ways[0].numbers for law in found.laws)
    # That bars bend far costs nothing where the set has it too.
    numbers += int(found.bent and not root_of(it.cache, best))
    # What the model has from the start is there in all that compete.
    there = frozenset(found.end.model.names) & set(it.cache.candidates)
    beside = there - root_of(it.cache, there)
    kinked = any(each.ways[0].formed.form.kinked for each in found.laws)
    # Choices of sides cost a law what they cost an effect.
    left = found.end.chi_square + found.end.residual.doubt + found.end.residual.spread
    cost = left + (numbers + taken(it.cache, beside)) * _of_one(it)
    things = len(found.laws) + len(beside)
    return _Rival(cost, numbers, things, beside, explains(it, found), kinked)


def _judged(it: Diagnosis, found: Discovery, rival: _Rival, own: Names, begin: float) -> Diagnosis:
    """The diagnosis as it is, or with a verdict that the laws leave. own: effects of the first set."""
    several = len(own) >= CRITERIA.law_several
    behind = rival.cost - min(_cost_of_set(it, names, several) for names in map(frozenset, it.sets))
    # Where each row chooses its side of a gap that takes up noise, and where something is left: never better than a
    # set by that alone.
    doubtful = rival.kinked or not rival.whole
    # A law that holds the effect and more has to be better by what it has more.
    more = 0.0 if own <= held_by(found, it.cache.candidates) else CRITERIA.law_named
    alone = -CRITERIA.law_alike if doubtful else more
    if behind > (CRITERIA.law_alike if several and rival.whole else alone):
        return it
    told = _told(found, rival)
    if doubtful or behind >= -CRITERIA.law_alike:
        decision = replace(it.decision, verdict="ambiguous", law=told)
    else:
        decision = replace(
            it.decision, verdict="unknown", because=f"{told} explains it by {-behind:.0f} better"
        )
    done, made = less_certain(replace(it, decision=decision), found), record(it, found, begin)
    return replace(done, laws=made.laws, law_words=law_sentences(made))


def _cost_of_set(it: Diagnosis, names: Names, several: bool) -> float:
    """Of one effect with the numbers that it needs, of several with all."""
    own, one = names - root_of(it.cache, names), _of_one(it)
    priced = taken(it.cache, own) * one if several else _needed(it.cache.fit(names), own, one)
    return misfit(it.cache, names) + priced


def _needed(found: Fit, own: Names, one: float) -> float:
    """What the numbers of some effects of a fit cost at one each where those are taken out, the one that explains least
    first, that explain less than they cost, and what is left more without them, to first order."""
    free = found.model.free
    moved = np.array([v - f.parameter.null for f, v in zip(free, found.model.values, strict=True)])
    columns = found.jacobian
    aim = found.whitened + columns @ moved
    other = [k for k, each in enumerate(free) if each.effect not in own]
    # What stands at null, as at its bound, is not needed.
    there = np.flatnonzero(np.abs(moved) > AT_NULL * found.std)
    kept = [int(k) for k in there if free[k].effect in own]
    first = left = _left(columns[:, other + kept], aim)
    while kept:
        each = {k: _left(columns[:, other + [j for j in kept if j != k]], aim) for k in kept}
        least = min(each, key=lambda k: each[k])
        if each[least] - left >= one:
            break
        kept.remove(least)
        left = each[least]
    return left - first + len(kept) * one


def _left(columns: np.ndarray, aim: np.ndarray) -> float:
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0.0] = 1.0
    off = aim - (columns / scale) @ np.linalg.lstsq(columns / scale, aim, rcond=1e-10)[0]
    return float(off @ off)


def _of_one(it: Diagnosis) -> float:
    """What a number costs."""
    whole = it.cache.whole
    return float(np.log(max(int(np.sum(whole.predicted & whole.fitted[:, None])), 1)))


def _told(found: Discovery, rival: _Rival) -> str:
    places = " and ".join(each.site.name for each in found.laws)
    numbers = f"{rival.numbers} number{'s' if rival.numbers > 1 else ''}"
    beside = f" beside {' and '.join(sorted(rival.beside))}" if rival.beside else ""
    return f"a law of {numbers} at {places}{beside}"
