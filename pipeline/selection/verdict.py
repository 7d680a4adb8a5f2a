"""The verdict on what a search has found: a name is given only to what nothing else explains as well.

Never from a number that nothing determines, or that ends at its bound; never without a reading left to test it by, and
never where a sensor that was not zeroed would do.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from pipeline.answer.record import Verdict
from pipeline.attempt import Attempts
from pipeline.inference.fit import Fit
from pipeline.inference.model import at_bound
from pipeline.inference.prior import implausibility
from pipeline.selection.adequacy.judgement import Judgement
from pipeline.selection.confusability import Likeness, likenesses
from pipeline.selection.cost import is_noise, taken
from pipeline.selection.determined import determined, undetermined
from pipeline.selection.exclusion import needed, worse
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.rivals import Found
from pipeline.selection.sensor_faults import Instead, faults_instead, zero_first

ENDED = "the search ended before all that might explain it as well was looked at, as it takes long"
UNSURE_OF_TABLE = "the look for mistakes of the table, which come first, did not come to its end"


@dataclass(frozen=True, eq=False)
class Decision:
    """A verdict. sets: the simplest first; one where the verdict is certain. fit: of the first, numbers that nothing
    determines at null. instead: faults of sensors that explain as much; zero: a sensor that
    may not have been zeroed, which comes before all physics.

    at_bound: numbers of the first set that end at their bound. out: sets that only an implausible size excludes.
    because: why the best set is not named though it explains all. law: a law beyond the catalogue that explains as
    much as the sets, in words. unlooked: why sets of several effects were not looked for.
    """

    verdict: Verdict
    sets: tuple[Names, ...]
    fit: Fit
    instead: tuple[Instead, ...] = ()
    zero: Instead | None = None
    alike: tuple[Likeness, ...] = ()
    at_bound: tuple[str, ...] = ()
    out: tuple[Names, ...] = ()
    because: str = ""
    law: str = ""
    unlooked: str = ""

    def withheld(self, because: str) -> Decision:
        """Without the name, where one is given."""
        return self if self.verdict != "identified" else replace(self, verdict="unknown", because=because)

    def of_one(self, because: str) -> Decision:
        """Of single effects alone, with why no more was looked for: without a name, and without names of which one is
        said to be right."""
        if self.verdict not in ("identified", "ambiguous"):
            return replace(self, unlooked=because)
        return replace(self, verdict="unknown", sets=self.sets[:1], because=because, unlooked=because)


def ruled(found: Found, judgement: Judgement, attempts: Attempts) -> Decision:
    """The decision. What is optional and fails is said in the attempts."""
    cache, best = found.cache, found.best
    here = cache.with_own_line(best)
    alike = tuple(attempts.get("what could be taken for what", lambda: likenesses(cache, best), []))
    zero = attempts.get("whether a sensor was not zeroed", lambda: zero_first(found, judgement.noise), None)
    bounded = at_bound(here.model)
    out = tuple(_implausible(found))
    if zero is not None and _nothing_but(zero, cache):
        return Decision("nothing_tested", (zero.without,), cache.fit(zero.without), (), zero)
    if not judgement.noise:
        if zero is not None and not zero.without:
            # What a sensor's zero hides is named when that is settled.
            return Decision("unknown", (zero.without,), cache.fit(zero.without), (), zero)
        return Decision("unknown", (best,), here, (), zero, alike, bounded, out)
    if found.ended and best:
        return Decision("unknown", (best,), here, (), zero, alike, bounded, out, ENDED)
    instead = attempts.get("what a sensor's fault would explain", lambda: faults_instead(found), ())
    rivals = _with_equals(found, alike, bounded)
    if zero is not None:
        instead = (*instead, zero)
    sets = tuple(sorted(dict.fromkeys((best, *rivals)), key=lambda n: _simplicity(cache, n)))
    if not best and zero is None and not rivals:
        return Decision("within_noise", (best,), here, (), None, alike, (), out)
    if len(sets) > 1 or instead:
        return Decision(
            "ambiguous",
            sets,
            cache.with_own_line(sets[0]),
            instead,
            # It is sooner looked at than anything about the rig.
            zero or next((it for it in instead if it.zero is not None), None),
            alike,
            at_bound(cache.fit(sets[0]).model),
            tuple(names for names in out if names not in sets),
        )
    settled = determined(here, cache.whole, cache.criteria)
    # One that nothing determines may end at its bound as well as beside it; it is at null now.
    bounded = at_bound(settled.model)
    because = _not_named(settled, cache, bounded)
    verdict: Verdict = "unknown" if because else "identified"
    return Decision(verdict, (best,), settled, (), None, alike, bounded, out, because)


def _nothing_but(zero: Instead, cache: FitCache) -> bool:
    """Whether all that was read is one constant of a channel of which the model expects nothing."""
    alone = zero.zero is not None and zero.zero.unloaded and not zero.without
    return alone and cache.fit(zero.without).degrees <= 1


def _not_named(settled: Fit, cache: FitCache, bounded: tuple[str, ...]) -> str:
    """Why a set that explains all is not named; empty where it may be."""
    if bounded:
        return f"{', '.join(bounded)} ends at the bound of what it may be"
    if settled.degrees < 1:
        return "it takes as many numbers as there are readings, so none is left to test it by"
    blind = undetermined(settled, cache.whole)
    if blind:
        return f"these tests do not determine {', '.join(blind)}"
    return ""


def _with_equals(found: Found, alike: tuple[Likeness, ...], bounded: tuple[str, ...]) -> list[Names]:
    """The rivals, and those that are one with an effect of the best set in all readings; where a number of the best set
    ends at its bound it excludes nothing that leaves noise."""
    cache, best = found.cache, found.best
    rivals = list(found.rivals)
    for each in alike:
        other = best - {each.effect} | {each.rival}
        if (
            1.0 - each.correlation < cache.criteria.equal_within
            and cache.affords(other)
            and _whole(cache, other)
        ):
            cache.fit(other)
            if worse(cache, other, best) <= max(cache.criteria.exclusion_least, needed(cache, other, best)):
                rivals.append(other)
    if bounded:
        room = taken(cache, best)
        rivals += [n for n in cache.fits if n != best and taken(cache, n) <= room and is_noise(cache, n)]
    return [n for n in dict.fromkeys(rivals) if n != best]


def _whole(cache: FitCache, names: Names) -> bool:
    """Whether every effect of a set has those that it cannot be without."""
    there = names | set(cache.base.names)
    return all(set(cache.candidates[name].includes) <= there for name in names)


def _implausible(found: Found) -> Iterator[Names]:
    """Sets as simple as the best one that fit as well and are out only because their numbers would be implausible."""
    cache, best = found.cache, found.best
    mine = _implausibility(cache, best)
    for names in cache.fits:
        if names == best or names in found.rivals or not names or best < names or names < best:
            continue
        if len(names) > len(best) and taken(cache, names) > taken(cache, best):
            continue
        far = _implausibility(cache, names) - mine
        limit = max(cache.criteria.exclusion_least, needed(cache, names, best))
        if worse(cache, names, best) > limit >= worse(cache, names, best) - max(far, 0.0):
            yield names


def _implausibility(cache: FitCache, names: Names) -> float:
    model = cache.fit(names).model
    return implausibility(model.free, model.values, cache.criteria.plausible)


def _simplicity(cache: FitCache, names: Names) -> tuple[int, int, float]:
    return len(names), taken(cache, names), cache.fit(names).chi_square
