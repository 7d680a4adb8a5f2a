"""Which discrete mistake of a table explains most of a misfit: asked before any physics.

A mistake is told where, with the best single effect on both sides (its numbers as implausible as they are), what is
left falls by a factor, where no two effects explain the table as it is as well, and where the columns it is in are then
explained by the model: a factor that only silences a column explains nothing. Of all mistakes a first-order look is
taken, with the differences of what is prescribed through the constant stiffness; those that promise much are fitted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter, itemgetter
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit
from pipeline.inference.linear_prediction import predict_linear
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import at_bound
from pipeline.inference.multistart import best_fit
from pipeline.inference.predicted import Prediction
from pipeline.inference.prior import implausibility
from pipeline.inference.residual import residual
from pipeline.inference.rounding import ROUNDING
from pipeline.inference.solvers import Effort
from pipeline.inference.suitable import scale_for
from pipeline.selection.allotted import BESIDE, KINKED, MISTAKES, TWO, until
from pipeline.selection.criteria import Criteria
from pipeline.selection.faulty_sensor import least_with_a_fault
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.mended_table import Left, Table, is_far, prescribed
from pipeline.selection.mistakes import possible
from pipeline.selection.mistakes.base import Mistake, columns_of, with_readings
from pipeline.selection.signatures import look
from vjm.effects import catalogue
from vjm.effects.base import Effect
from vjm.effects.sized import all_sized
from vjm.work import TooMuch, at_most

Array = NDArray[np.float64]
T = TypeVar("T")


@dataclass(frozen=True)
class Suspicion:
    """A mistake that explains most. before, after: chi-square that is left with the best single effect, without and
    with it mended. beside: the set with that effect, with it mended. heard: whether its columns say something once it
    is mended: then it does not silence them."""

    mistake: Mistake
    before: float
    after: float
    beside: Names
    heard: bool = False


def suspicions(cache: FitCache) -> tuple[Suspicion, ...]:
    """The mistake of the table that explains most, with those that explain as much; none where none does, or the table
    was checked by hand. TooMuch where that takes more work than a few searches may."""
    if cache.whole.campaign.table_checked:
        return ()
    with until(cache, MISTAKES):
        table = _table(cache)
        found = [] if table is None else _mended(table, cache)
    if table is None or not found:
        return ()
    with _told(found), until(cache, TWO):
        found = _better_than_two(table, found)
    if not found:
        return ()
    criteria, noise, share = cache.criteria, max(table.fit.degrees, 1), _share(table, cache)
    if not any(_sure(it, noise, criteria) for it in found):
        # A column of which the model predicts little is silenced by a factor: effects with kinks explain it too.
        with _told(found), until(cache, KINKED):
            enough = [max(it.after, noise) * criteria.doctor_factor / share for it in found]
            kinked = _least_with_kinks(cache, table, enough)
        if all(kinked.clears(it.after / share, noise / share, criteria.doctor_factor) for it in found):
            return ()
    least = max(min(it.after for it in found), noise)
    tie = least + criteria.doctor_tie * least / noise
    kept = [it for it in found if it.after < tie]
    # Less than one of chi-square says nothing: then in the order of the columns.
    kept.sort(key=lambda it: (int(it.after - least), *_place(it.mistake, cache.whole)))
    with suppress(TooMuch), until(cache, KINKED):
        kept.extend(_beside_unusual(table, found, tie))
    return tuple(kept)


def _beside_unusual(table: Table, found: Sequence[Suspicion], tie: float) -> Iterator[Suspicion]:
    """Other mistakes of these kinds that leave no more than a tie beside an effect of an unusual size: a clamp may give
    more than is usual, and of which unit it was the table does not tell then."""
    told = {it.mistake.words: it.mistake.kind for it in found}
    for mistake in possible(table.cache.whole.campaign, table.cache.criteria):
        if mistake.kind in told.values() and mistake.words not in told:
            new = table.mended(mistake)
            left = _within_its_share(new, attrgetter("left_at_any_size"), BESIDE)
            near = left is not None and left[0] < tie
            if left and near and _explained(new.cache.fit(left[1]), mistake, new.cache.criteria, False):
                yield Suspicion(mistake, found[0].before, *left)


@contextmanager
def _told(found: Sequence[Suspicion]) -> Iterator[None]:
    """Where that takes too long what was found before is said with it: whoever wrote the table can look."""
    try:
        yield
    except TooMuch as error:
        words = min(found, key=lambda it: it.after).mistake.words
        raise TooMuch(f"{error}; until then it looked as if {words}: check that by hand") from error


def _place(mistake: Mistake, whole: LoadCases) -> tuple[int, int]:
    """How many columns have a mistake, and where the first of them stands."""
    places = [k for k, name in enumerate(columns_of(whole.campaign)) if name in mistake.columns]
    return len(mistake.columns), min(places, default=0)


def _sure(it: Suspicion, noise: float, criteria: Criteria) -> bool:
    """Whether a mistake leaves hardly more than noise of what without it is far more, and silences nothing."""
    explained = it.after < criteria.doctor_factor * noise and it.before > criteria.doctor_sure * it.after
    return it.heard and explained


def _table(cache: FitCache) -> Table | None:
    """What is looked at of a table; None where there is nothing to be found."""
    criteria = cache.criteria
    # A mistake that explains most is seen in few rows, and by effects that need no search.
    some = look(cache.whole, criteria.doctor_steps).load_cases
    if not (some.predicted & some.fitted[:, None]).any():
        return None
    plain = {name: it for name, it in cache.candidates.items() if it.smooth}
    table = Table.of(FitCache(some, cache.base, plain, cache.on_progress, criteria, before=cache))
    few = table.fit.degrees < criteria.doctor_readings
    return None if few or _near(table.fit, criteria) or _near(table.plain.fit, criteria) else table


def _share(table: Table, cache: FitCache) -> float:
    """Of what noise leaves in all rows, the part in those that are looked at."""
    return max(table.fit.degrees, 1) / max(cache.fit(table.root).degrees, 1)


def _mended(table: Table, cache: FitCache) -> list[Suspicion]:
    """Mistakes that explain more than one smooth effect or the fault of one sensor."""
    cache.on_progress("whether the table has a mistake")
    promising = _promising(table)
    if not promising:
        return []
    # A faulty sensor is none of the table, and may look like one to a few of its columns.
    fault = least_with_a_fault(cache, table.root, _kinds(cache.whole.campaign))
    return _found(table, promising, fault * _share(table, cache))


def _better_than_two(table: Table, found: list[Suspicion]) -> list[Suspicion]:
    """These, where one explains more than two smooth effects, as ties of it explain as much; else none: a table may be
    right and the rig lack two, of which neither alone explains most."""
    noise, criteria = max(table.fit.degrees, 1), table.cache.criteria
    factor = criteria.doctor_factor
    rival = factor * criteria.doctor_far * max(noise, min(it.after for it in found))
    two = table.beside_rival(rival).left_by_two({it.beside for it in found})
    return [] if all(two.clears(it.after, noise, factor) for it in found) else found


def _least_with_kinks(cache: FitCache, table: Table, enough: Sequence[float]) -> Left:
    """Chi-square that one effect that needs a search leaves (friction, play, yielding), alone or with the smooth one
    that is best alone: hinges that spring back and rub are two. A fit that does not come near what is enough ends
    before; none is made once one leaves less than all of that. Those that take longest come last."""
    smooth = table.left[1]
    beside = {name: cache.candidates[name] for name in smooth - table.root}
    before, known = cache.fit(table.root), smooth | set(cache.base.names)
    plausible, out = cache.criteria.plausible, Left(np.inf)
    kinked = [it for it in cache.candidates.values() if not it.smooth and known >= set(it.includes)]
    for effect in sorted(kinked, key=lambda it: cache.quickness(frozenset({it.name})), reverse=True):
        if out.usual < min(enough):
            break
        cache.on_progress(f"whether {effect.name} explains as much")
        model = before.model.with_effects([*beside.values(), effect])
        effort = Effort(known=max(enough))
        there = best_fit(
            model, cache.whole, [*beside, effect.name], before.prediction, None, plausible, effort
        )
        sizes = implausibility(there.model.free, there.model.values, plausible)
        out = out.or_that(there, there.chi_square + sizes, cache.criteria)
    return out


def _kinds(campaign: Campaign) -> list[Effect]:
    return list(all_sized(catalogue(), scale_for(campaign)).values())


def _found(table: Table, promising: list[Mistake], fault: float) -> list[Suspicion]:
    """Every mistake that is enough, of the first ones and then of those of the kinds that were found: a sign lost in
    the load or in the displacement reads alike. fault: what the fault of one sensor leaves."""
    if fault < table.cache.criteria.doctor_factor * max(table.fit.degrees, 1):
        return []
    count, out, skipped, rest = table.cache.criteria.doctor_fitted, list[Suspicion](), False, promising
    # To first order the best come first, but of a table that is far off that order says little.
    while rest and not out and (rest is promising or is_far(table.fit)):
        out, one = _looked_at(table, rest[:count], fault)
        skipped, rest = skipped or one, rest[count:]
    if skipped and not out:
        raise TooMuch("it would take too long")
    alike = [mistake for mistake in rest if mistake.kind in {it.mistake.kind for it in out}]
    return [*out, *_looked_at(table, alike[:count], fault, out)[0]]


def _looked_at(
    table: Table, mistakes: list[Mistake], fault: float, known: Sequence[Suspicion] = ()
) -> tuple[list[Suspicion], bool]:
    """Those that are enough, to first order, then fitted, and whether one was not looked at for want of work. Fits far
    from an explanation are slow, so that they are made of the table as it is and of what may be right alone. known:
    those that were found before, of which one that leaves far more is no tie."""
    criteria, enough, skipped = table.cache.criteria, list[tuple[Mistake, Table]](), False
    share, noise = 1.0 / criteria.doctor_fitted, max(table.fit.degrees, 1)
    near = criteria.doctor_factor * noise
    plain = _without_buckling(table, mistakes)
    for alone, mistake, mended in plain:
        if any(it.after < near for it in known) or any(it.first_order < near for _, it in enough):
            if alone > criteria.doctor_far * max(plain[0][0], noise):
                continue
            share = BESIDE
        left = _within_its_share(mended, attrgetter("first_order"), share)
        skipped |= left is None
        if left is not None and left * criteria.doctor_factor < min(table.alone, fault):
            enough.append((mistake, mended))
    out: list[Suspicion] = []
    if not enough:
        return out, skipped
    before = min(table.alone, table.plain.alone, fault)
    least = min(mended.first_order for _, mended in enough)
    if before < criteria.doctor_sure * least or table.leaves_bounds:
        table = table.beside_rival(criteria.doctor_factor * criteria.doctor_far * max(least, near))
        before = min(before, table.left[0])
    for mistake, mended in sorted(enough, key=lambda it: it[1].first_order):
        there = [it.after for it in (*known, *out)]
        if there and mended.first_order > criteria.doctor_far * max(min(there), noise):
            continue
        told = _within_its_share(
            mended,
            partial(_suspicion, mistake=mistake, before=before, table=table),
            1.0 / criteria.doctor_fitted,
        )
        skipped |= told is None
        out += told or ()
    return out, skipped


def _without_buckling(table: Table, mistakes: Sequence[Mistake]) -> list[tuple[float, Mistake, Table]]:
    """What is left where each is mended, least first, to first order without the geometric stiffness of bars and
    whatever else is there or not: loads that would buckle bars take longest, and are none of a table that is right."""
    out = list[tuple[float, Mistake, Table]]()
    for mistake in mistakes:
        table.cache.on_progress(f"whether {mistake.words}")
        mended = table.mended(mistake)
        left = _within_its_share(mended.plain, attrgetter("first_order"), BESIDE)
        out.append((np.inf if left is None else left, mistake, mended))
    return sorted(out, key=itemgetter(0))


def _suspicion(mended: Table, mistake: Mistake, before: float, table: Table) -> tuple[Suspicion, ...]:
    """The mistake, where it leaves so much less than was left before, the model what it is of, and its columns are not
    silenced; else none."""
    criteria = mended.cache.criteria
    prescribes = prescribed(mended.cache.whole, mistake)
    # With zeros in its columns far more has to be left than with what they prescribe.
    silent = _silenced(mended, mistake).first_order if prescribes else np.inf
    silences = silent <= mended.first_order + criteria.doctor_explains
    if silences or mended.left[0] * criteria.doctor_factor > before:
        return ()
    larger = _size(mended, mistake) >= (1.0 - ROUNDING) * _size(table, mistake)
    heard = larger or (prescribes and silent > criteria.doctor_follows * mended.first_order)
    explained = _explained(mended.cache.fit(mended.left[1]), mistake, criteria, heard)
    return (Suspicion(mistake, before, *mended.left, heard),) if explained else ()


def _size(table: Table, mistake: Mistake) -> float:
    """Root mean square of the columns of a mistake, in what they are read in."""
    cases = table.cache.whole
    names = np.isin(columns_of(cases.campaign), mistake.columns)
    return float(np.sqrt(np.nansum(cases.measured[:, names] ** 2)))


def _within_its_share(mended: Table, look: Callable[[Table], T], share: float) -> T | None:
    """What a look at one mistake says; None where that takes more than its share of a search's work: a column that is
    as good as silenced is fitted in vain, and would leave the others no work."""
    try:
        with at_most(share * mended.cache.work):
            return look(mended)
    except TooMuch:
        return None


def _promising(table: Table) -> list[Mistake]:
    """Those that a first-order look at all does not exclude: the best of each kind, then the others, best first."""
    criteria, whole, base = table.cache.criteria, table.cache.whole, table.fit
    before = table.alone
    if min(before, table.plain.alone) < criteria.doctor_factor * max(base.degrees, 1):
        return []
    linear, far = predict_linear(whole), is_far(base)
    out: list[tuple[bool, float, Mistake]] = []
    for mistake in possible(whole.campaign, criteria):
        mended = mistake.mended(whole.campaign)
        cases = load_cases(mended)
        every = [
            replace(base.prediction, values=it) for it in _foreseen(base.prediction, whole, cases, linear)
        ]
        fits = [Fit(base.model, there, residual(cases, there), 0) for there in every]
        found = min(fits, key=lambda it: it.chi_square)
        # What leaves more when it is mended is none, but of a table so far off chi-square says nothing.
        off = is_far(found)
        better = far or found.chi_square < base.chi_square
        left = table.first_order_of(found) if better else np.inf
        if left * criteria.doctor_look < before:
            out.append((off, left, mistake))
    out.sort(key=lambda it: it[:2])
    # One of each kind first: several units that silence a column leave alike, and a sign with what it spoilt more.
    best = {mistake.kind: mistake for *_, mistake in reversed(out)}
    out.sort(key=lambda it: (it[0], best[it[2].kind] is not it[2]))
    return [mistake for *_, mistake in out]


def _foreseen(base: Prediction, whole: LoadCases, cases: LoadCases, linear: Prediction) -> Iterator[Array]:
    """(R, C) what is predicted of a mended table: as before, and by how much a constant stiffness predicts otherwise
    what is prescribed otherwise. Of bars that are far softer or stiffer than they were that says nothing, but what the
    constant stiffness itself predicts."""
    one, other = whole.campaign, cases.campaign
    pairs = list(zip(one.tests, other.tests, strict=True))
    if any(a.rig is not b.rig or a.q_deg != b.q_deg for a, b in pairs):
        values = predict_linear(cases).values
        yield values
        yield np.asarray(base.values + values - linear.values)
        return
    more = np.concatenate([b.inputs(other.gauges) - a.inputs(one.gauges) for a, b in pairs])
    yield base.values + np.einsum("rci,ri->rc", linear.by_inputs[..., :6], np.nan_to_num(more))


def _near(found: Fit, criteria: Criteria) -> bool:
    """Whether nothing could take a factor off what is left but to fit noise."""
    return found.chi_square < criteria.doctor_factor * max(found.degrees, 1)


def _silenced(mended: Table, mistake: Mistake) -> Table:
    """The table with zeros in the columns of a mistake."""
    names = np.isin(columns_of(mended.cache.whole.campaign), mistake.columns)

    def silenced(campaign: Campaign) -> Campaign:
        return with_readings(campaign, lambda values: np.where(names, 0.0 * values, values))

    return mended.mended(replace(mistake, mended=silenced))


def _explained(found: Fit, mistake: Mistake, criteria: Criteria, heard: bool) -> bool:
    """Whether the model explains the columns of a mistake, where it predicts them and they read more than noise: a
    factor that silences a column explains nothing, nor does a model that is far off in one of them, or that has a
    number at the bound of what it may be."""
    parts = list(_signals(found, mistake))
    if at_bound(found.model):
        return False
    if not parts:
        return True
    loud = [(signal, left) for signal, left, count in parts if signal > criteria.doctor_explains * count]
    # As far off as what is of the same size and has nothing to do with it.
    if any(left > 2.0 * signal for signal, left in loud):
        return False
    if not loud:
        # What is read of them is noise; where they prescribe, what is left without them was looked at.
        return heard and prescribed(found.residual.load_cases, mistake)
    signal, left = sum(s for s, _ in loud), sum(x for _, x in loud)
    return left * criteria.doctor_factor < signal


def _signals(found: Fit, mistake: Mistake) -> Iterator[tuple[float, float, int]]:
    """Of each predicted column: chi-square of its readings, of what is left of them, and their number."""
    cases = found.residual.load_cases
    names = columns_of(cases.campaign)
    for column in mistake.columns:
        if column not in names:
            continue
        channel = names.index(column)
        rows = cases.predicted[:, channel] & cases.fitted & ~found.prediction.lost
        if rows.any():
            sigma, read = cases.spread[rows, channel], cases.measured[rows, channel]
            off = read - found.prediction.values[rows, channel]
            squares = float(np.sum((read / sigma) ** 2)), float(np.sum((off / sigma) ** 2))
            yield *squares, int(rows.sum())
