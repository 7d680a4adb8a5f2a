"""From a campaign and a model to a verdict: what is missing, what could be, or that nothing known explains it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

from pipeline.answer.law import LawFound
from pipeline.answer.record import Verdict
from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.campaign.order import by_name
from pipeline.errors import InputError
from pipeline.inference.declared_sigmas import trusted_and_fit
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, at_bound
from pipeline.inference.suitable import check_suitable, scale_for, sized_model
from pipeline.selection.adequacy.judgement import Judgement, judge
from pipeline.selection.allotted import for_faults
from pipeline.selection.certain import certain
from pipeline.selection.confusability import Likeness, likenesses
from pipeline.selection.correlated_rows import NONE, AlikeRows, alike_rows
from pipeline.selection.criteria import CRITERIA, Criteria
from pipeline.selection.cross_validation import agreement
from pipeline.selection.doctor import Suspicion, suspicions
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.named_faults import with_named_faults
from pipeline.selection.next_test import NextTest, best_next_test
from pipeline.selection.noise_rounds import Again, Settled, as_declared, settled, with_faults
from pipeline.selection.reading_noise import AS_DECLARED, Readings
from pipeline.selection.rivals import Found
from pipeline.selection.searched import beginning
from pipeline.selection.sensor_faults import Instead, asked_about
from pipeline.selection.verdict import UNSURE_OF_TABLE, Decision
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault
from vjm.effects.sized import all_sized
from vjm.site_law import SiteLaw


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What was found. decision: the verdict and what it rests on. untested: why nothing can be tested, or "".

    refused: effects that the rig or the campaign cannot have, and why. failed: optional parts that failed, and why.
    doctor: mistakes of the table, one of which comes before all physics. readings: what they are about the first set;
    given: the campaign with all of them as they were declared; with_all: the verdict by those, alone: whether
    of the best single effect only. certain: effects that are there whatever the verdict. alike_rows: sensors whose
    noise is correlated from row to row. laws, law_words: beyond the catalogue (`pipeline.discover.beyond_catalogue`).
    """

    campaign: Campaign
    found: Found
    decision: Decision
    judgement: Judgement
    agreement: Mapping[str, float]
    next_test: NextTest | None
    refused: Mapping[str, str]
    untested: str = ""
    failed: tuple[str, ...] = ()
    seconds: float = 0.0
    doctor: tuple[Suspicion, ...] = ()
    readings: Readings = AS_DECLARED
    given: Campaign | None = None
    with_all: Verdict = "unknown"
    alone: bool = False
    certain: tuple[str, ...] = ()
    alike_rows: AlikeRows = NONE
    laws: tuple[LawFound, ...] = ()
    law_words: tuple[str, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """One of the five."""
        return self.decision.verdict

    @property
    def fit(self) -> Fit:
        """Of the first set."""
        return self.decision.fit

    @property
    def instead(self) -> tuple[Instead, ...]:
        """Faults of sensors that explain as much as an effect of the best set."""
        return self.decision.instead

    @property
    def alike(self) -> tuple[Likeness, ...]:
        """What could be taken for the effects of the best set."""
        return self.decision.alike

    @property
    def sets(self) -> tuple[tuple[str, ...], ...]:
        """The effects to add, the simplest set first; one where the verdict is certain."""
        return tuple(self.cache.order(names) for names in self.decision.sets)

    @property
    def cache(self) -> FitCache:
        """All that was fitted."""
        return self.found.cache

    @property
    def possible(self) -> tuple[tuple[str, ...], ...]:
        """The sets, and those that need a fault of a sensor beside them."""
        beside = (self.cache.order(it.without) for it in self.instead)
        return tuple(dict.fromkeys((*self.sets, *beside)))

    @property
    def model(self) -> Model:
        """The model with the first set, fitted."""
        return self.fit.model

    def about(self, names: tuple[str, ...]) -> Diagnosis:
        """The same with another of its sets as the first: its fit, checks, bounds and what could be taken for it.

        The fit goes along its own line of what was written about the rig, as that of the first set does. Nothing is
        known of how often it would be chosen without a test. ValueError for a set that is none of them.
        """
        order = [self.sets.index(names), *(k for k in range(len(self.sets)) if self.sets[k] != names)]
        sets = tuple(self.decision.sets[k] for k in order)
        fit = self.cache.with_own_line(sets[0])
        decision = replace(
            self.decision,
            sets=sets,
            fit=fit,
            alike=tuple(likenesses(self.cache, sets[0])),
            at_bound=at_bound(fit.model),
        )
        test = self.next_test
        if test is not None:
            place = {k: number for number, k in enumerate(order)}
            test = replace(test, parted={(place[a], place[b]): v for (a, b), v in test.parted.items()})
        judgement = judge(fit, self.cache.criteria)
        return replace(self, decision=decision, judgement=judgement, agreement={}, next_test=test)


def diagnose(
    campaign: Campaign,
    model: Model,
    known: Mapping[str, Effect],
    on_progress: OnProgress = lambda _: None,
    criteria: Criteria = CRITERIA,
) -> Diagnosis:
    """Look for what the model lacks. InputError for a campaign that cannot be judged or a model that it cannot have."""
    begin, campaign = perf_counter(), by_name(campaign)
    cache, refused = _prepared(campaign, model, known, on_progress, criteria)
    attempts = Attempts()
    beginning(cache)
    doctor = attempts.get("the look for mistakes of the table", lambda: suspicions(cache), ())
    unlooked = tuple(attempts.failed)
    if doctor:
        return _unsettled(cache, doctor, refused, attempts, _since(begin))
    again = partial(_cache_of, model, known)
    if unlooked:
        # Where a mistake of the table may be left nothing is named: what explains most alone is enough to show.
        done = as_declared(cache, attempts)
    else:
        done = settled(cache, again, attempts)
        kinds = all_sized(dict(sorted(known.items())), scale_for(campaign)).values()
        done = _of_sensors(done, kinds, again)
    it, attempts, cache = done.it, done.attempts, done.it.found.cache
    whole = cache.whole.campaign
    if it.untested:
        found, judgement = Found(cache, frozenset(), ()), Judgement((), 1.0)
        return Diagnosis(
            whole, found, it.decision, judgement, {}, None, refused, it.untested, (), _since(begin)
        )
    found, decision = it.found, it.decision.of_one(UNSURE_OF_TABLE) if unlooked else it.decision
    next_test = attempts.get("the next test", lambda: _next_test(cache, decision), None)
    on_progress("what is certain")
    doubted = {it.effect for it in decision.instead}
    sure: tuple[str, ...] = ()
    if not unlooked:
        sure = attempts.get("what is certain", lambda: certain(found, decision.sets, doubted), ())
    stable = attempts.get("whether folds of the tests agree", lambda: _agreements(cache, found.best), {})
    alike = attempts.get("whether rows are alike", lambda: alike_rows(cache, decision), NONE)
    return Diagnosis(
        whole,
        found,
        decision,
        judge(decision.fit, criteria),
        stable,
        next_test,
        refused,
        "",
        tuple(dict.fromkeys((*unlooked, *attempts.failed))),
        _since(begin),
        (),
        done.readings,
        done.given.campaign,
        done.with_all,
        done.alone,
        sure,
        alike,
    )


def _of_sensors(done: Settled, kinds: Iterable[Effect], again: Again) -> Settled:
    """With faults of sensors: in the place of what is not explained, then of each effect that one explains as well."""
    for what, look in (
        ("whether a sensor is at fault", partial(with_faults, again=again)),
        ("which fault of a sensor explains as much", with_named_faults),
    ):
        done = done.attempts.get(what, partial(_within_its_share, look, done, kinds), done)
    return done


def _within_its_share(
    look: Callable[[Settled, Iterable[Effect]], Settled], done: Settled, kinds: Iterable[Effect]
) -> Settled:
    with for_faults(done.it.found.cache):
        return look(done, kinds)


def _next_test(cache: FitCache, decision: Decision) -> NextTest | None:
    """What tells the sets of a verdict apart, where there are several."""
    if len(decision.sets) < 2:
        return None
    cache.on_progress("the next test")
    fits = [cache.with_own_line(n) for n in decision.sets[: cache.criteria.next_test_sets]]
    return best_next_test(fits, cache.whole)


def _unsettled(
    cache: FitCache,
    doctor: tuple[Suspicion, ...],
    refused: dict[str, str],
    attempts: Attempts,
    seconds: float,
) -> Diagnosis:
    """Of a table with a mistake: nothing is named before that is settled."""
    nothing: Names = frozenset()
    before = cache.fit(nothing)
    zero = attempts.get("which zero it is", lambda: asked_about(before, doctor, cache.criteria), None)
    decision = Decision("unknown", (nothing,), before, zero=zero)
    judgement = judge(before, cache.criteria)
    failed = tuple(attempts.failed)
    found = Found(cache, nothing, ())
    return Diagnosis(
        cache.whole.campaign, found, decision, judgement, {}, None, refused, "", failed, seconds, doctor
    )


def cached_fits(
    campaign: Campaign, model: Model, known: Mapping[str, Effect], on_progress: OnProgress = lambda _: None
) -> FitCache:
    """Where fits of the campaign are kept, none made yet. InputError as of `diagnose`."""
    return _prepared(by_name(campaign), model, known, on_progress, CRITERIA)[0]


def _prepared(
    campaign: Campaign,
    model: Model,
    known: Mapping[str, Effect],
    on_progress: OnProgress,
    criteria: Criteria,
    before: FitCache | None = None,
) -> tuple[FitCache, dict[str, str]]:
    """The empty fit cache, and the effects that are refused and why. before: of other readings of the same tests."""
    model, known = sized_model(model, campaign), all_sized(known, scale_for(campaign))
    check_suitable([term.effect for term in model.terms], campaign)
    whole, found = trusted_and_fit(completed(campaign), model, _fit_of_nothing(before))
    candidates, refused = suitable(whole, model, known)
    if found is None or model.free:
        return FitCache(load_cases(whole), model, candidates, on_progress, criteria, before=before), refused
    fits = {frozenset[str](): found}
    return FitCache(
        found.residual.load_cases, model, candidates, on_progress, criteria, fits, before=before
    ), refused


def _cache_of(model: Model, known: Mapping[str, Effect], campaign: Campaign, before: FitCache) -> FitCache:
    """The empty fit cache of a campaign that is another's with other readings."""
    return _prepared(campaign, model, known, before.on_progress, before.criteria, before)[0]


def _fit_of_nothing(cache: FitCache | None) -> Fit | None:
    return None if cache is None else cache.fits.get(frozenset())


def _agreements(cache: FitCache, best: Names) -> dict[str, float]:
    stable = {name: agreement(cache, best, name) for name in best}
    return {name: share for name, share in stable.items() if share is not None}


def _since(begin: float) -> float:
    return round(perf_counter() - begin, 3)


def suitable(
    campaign: Campaign, model: Model, known: Mapping[str, Effect]
) -> tuple[dict[str, Effect], dict[str, str]]:
    """Effects that could be added, by name and in the order of names, and why the others cannot."""
    can, cannot = {}, _of_users(model, known)
    for name, effect in sorted(known.items()):
        if (
            name in cannot
            or name in model.names
            or not _may_exceed(effect, campaign)
            or _needs_a_sensor(effect)
        ):
            continue
        try:
            check_suitable([effect], campaign)
            can[name] = effect
        except InputError as error:
            cannot[name] = str(error)
    return can, cannot


def _of_users(model: Model, known: Mapping[str, Effect]) -> dict[str, str]:
    """Effects of the catalogue that a law of a user is, number for number, and why they are not looked for."""
    every = [*known.values(), *(term.effect for term in model.terms)]
    return {
        name: f"{law.name} is the same law and is looked for in its place"
        for law in every
        if isinstance(law, SiteLaw) and "@" not in law.site
        for name in law.law_form.effects.get(law.site, ())
        if name in known and len(known[name].parameters) == len(law.parameters)
    }


def _needs_a_sensor(effect: Effect) -> bool:
    """Whether an effect is a kind of fault that no sensor has yet."""
    return isinstance(effect, SensorFault) and not effect.column


def _may_exceed(effect: Effect, campaign: Campaign) -> bool:
    """Whether an effect is more than the excess of what is written exactly."""
    return not effect.nominal or any(campaign.tolerance.get(key) for key in effect.nominal)
