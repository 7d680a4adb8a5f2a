"""From a campaign and a model to a verdict: what is missing, what could be, or that nothing known explains it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from time import perf_counter

from pipeline.adequacy.judgement import Judgement, judge
from pipeline.adequacy.untested import untested
from pipeline.answer import Verdict
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.diagnose.alike_rows import NONE, AlikeRows, alike_rows
from pipeline.diagnose.apart import Likeness
from pipeline.diagnose.beyond import with_what_held_out_tests_need
from pipeline.diagnose.certain import certain
from pipeline.diagnose.doctor import Suspicion, suspicions
from pipeline.diagnose.faulty import has_one_fault, with_promising_faults
from pipeline.diagnose.folds import agreement
from pipeline.diagnose.next_test import NextTest, best_next_test
from pipeline.diagnose.readings import AS_DECLARED, Readings
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.ruling import Ruling, ruled
from pipeline.diagnose.search import search, search_one_by_one
from pipeline.diagnose.sensor_faults import Instead, asked_about, plain_zero
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.diagnose.signatures import Say
from pipeline.errors import InputError
from pipeline.inference.claims import trusted_and_fit
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.model import Model
from pipeline.inference.program import Program, program
from pipeline.inference.sigmas import completed
from pipeline.inference.suitable import check_suitable, scale_for, sized_model
from pipeline.selection.criteria import CRITERIA, Criteria
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault
from vjm.effects.sized import all_sized


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What was found. ruling: the verdict and what it rests on. untested: why nothing can be tested, or "".

    refused: effects that the rig or the campaign cannot have, and why. failed: optional parts that failed, and why.
    doctor: mistakes of the table, one of which comes before all physics. readings: what they are about the first set;
    given: the campaign with all of them as they were declared; with_all: the verdict by those. certain: effects that
    are there whatever the verdict. alike_rows: sensors whose noise is correlated from row to row.
    """

    campaign: Campaign
    found: Found
    ruling: Ruling
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
    certain: tuple[str, ...] = ()
    alike_rows: AlikeRows = NONE

    @property
    def verdict(self) -> Verdict:
        """One of the five."""
        return self.ruling.verdict

    @property
    def fit(self) -> Fit:
        """Of the first set."""
        return self.ruling.fit

    @property
    def instead(self) -> tuple[Instead, ...]:
        """Faults of sensors that explain as much as an effect of the best set."""
        return self.ruling.instead

    @property
    def alike(self) -> tuple[Likeness, ...]:
        """What could be taken for the effects of the best set."""
        return self.ruling.alike

    @property
    def sets(self) -> tuple[tuple[str, ...], ...]:
        """The effects to add, the simplest set first; one where the verdict is certain."""
        return tuple(self.shelf.order(names) for names in self.ruling.sets)

    @property
    def shelf(self) -> Shelf:
        """All that was fitted."""
        return self.found.shelf

    @property
    def possible(self) -> tuple[tuple[str, ...], ...]:
        """The sets, and those that need a fault of a sensor beside them."""
        beside = (self.shelf.order(it.without) for it in self.instead)
        return tuple(dict.fromkeys((*self.sets, *beside)))

    @property
    def model(self) -> Model:
        """The model with the first set, fitted."""
        return self.fit.model


def diagnose(
    campaign: Campaign,
    model: Model,
    known: Mapping[str, Effect],
    say: Say = lambda _: None,
    criteria: Criteria = CRITERIA,
) -> Diagnosis:
    """Look for what the model lacks. InputError for a campaign that cannot be judged or a model that it cannot have."""
    begin = perf_counter()
    shelf, refused = _prepared(campaign, model, known, say, criteria)
    attempts = Attempts()
    beginning(shelf)
    doctor = attempts.get("the look for mistakes of the table", lambda: suspicions(shelf), ())
    if doctor:
        return _unsettled(shelf, doctor, refused, attempts, _since(begin))
    it = chosen(shelf, attempts)
    given, with_all = shelf.whole, it.ruling.verdict
    readings = AS_DECLARED
    for _ in range(0 if it.untested else criteria.reading_rounds):
        new = attempts.get("what the readings are", partial(_readings, it, readings, given), readings)
        if new.same(readings):
            break
        say("with the readings as they are")
        readings, attempts = new, Attempts()
        applied = readings.applied(given.campaign)
        shelf, refused = _prepared(applied, model, known, say, criteria, it.found.shelf)
        it = chosen(shelf, attempts)
    it = attempts.get("whether a sensor is at fault", partial(_with_faults, it, known, attempts), it)
    shelf, whole = it.found.shelf, shelf.whole.campaign
    if it.untested:
        found, judgement = Found(shelf, frozenset(), ()), Judgement((), 1.0)
        return Diagnosis(
            whole, found, it.ruling, judgement, {}, None, refused, it.untested, (), _since(begin)
        )
    found, ruling = it.found, it.ruling
    next_test = attempts.get("the next test", lambda: _next_test(shelf, ruling), None)
    say("what is certain")
    sure = attempts.get("what is certain", lambda: certain(found, ruling.sets), ())
    stable = attempts.get("whether folds of the tests agree", lambda: _agreements(shelf, found.best), {})
    alike = attempts.get("whether rows are alike", lambda: alike_rows(shelf, ruling), NONE)
    return Diagnosis(
        whole,
        found,
        ruling,
        judge(ruling.fit, criteria),
        stable,
        next_test,
        refused,
        "",
        tuple(attempts.failed),
        _since(begin),
        (),
        readings,
        given.campaign,
        with_all,
        sure,
        alike,
    )


def _next_test(shelf: Shelf, ruling: Ruling) -> NextTest | None:
    """What tells the sets of a verdict apart, where there are several."""
    if len(ruling.sets) < 2:
        return None
    shelf.say("the next test")
    fits = [shelf.with_own_line(n) for n in ruling.sets[: shelf.criteria.next_test_sets]]
    return best_next_test(fits, shelf.whole)


def _readings(it: Chosen, before: Readings, given: Program) -> Readings:
    """What the readings are about the first set; about a part of it where that explains all but single bad ones: an
    effect that only explains those is none."""
    shelf, best = it.found.shelf, it.ruling.sets[0]
    criteria = shelf.criteria
    for names in sorted((n for n in shelf.fits if n < best), key=len):
        new = before.again(shelf.fit(names), given, criteria)
        if new.bad and new.leaves_noise(shelf.fit(names), given, criteria):
            return new
    return before.again(it.ruling.fit, given, criteria)


def _with_faults(it: Chosen, known: Mapping[str, Effect], attempts: Attempts) -> Chosen:
    """With faults of sensors among the effects, where that leaves noise and nothing else does; none of sensors that
    are vouched for."""
    shelf, best = it.found.shelf, it.found.best
    if it.untested or it.ruling.verdict != "unknown" or shelf.whole.campaign.vouched:
        return it
    if judge(shelf.fit(best), shelf.criteria).noise:
        return it
    kinds = all_sized(known, scale_for(shelf.whole.campaign))
    more = with_promising_faults(shelf, kinds.values(), best)
    if more is None:
        return it
    shelf.say("whether a sensor is at fault")
    new = chosen(more, attempts)
    explained = judge(more.fit(new.found.best), shelf.criteria).noise
    return new if explained and has_one_fault(more, new.found.best) else it


def _unsettled(
    shelf: Shelf, doctor: tuple[Suspicion, ...], refused: dict[str, str], attempts: Attempts, seconds: float
) -> Diagnosis:
    """Of a table with a mistake: nothing is named before that is settled."""
    nothing: Names = frozenset()
    before = shelf.fit(nothing)
    zero = attempts.get("which zero it is", lambda: asked_about(before, doctor, shelf.criteria), None)
    ruling = Ruling("unknown", (nothing,), before, zero=zero)
    judgement = judge(before, shelf.criteria)
    failed = tuple(attempts.failed)
    found = Found(shelf, nothing, ())
    return Diagnosis(
        shelf.whole.campaign, found, ruling, judgement, {}, None, refused, "", failed, seconds, doctor
    )


def fit_cache(
    campaign: Campaign, model: Model, known: Mapping[str, Effect], say: Say = lambda _: None
) -> Shelf:
    """Where fits of the campaign are kept, none made yet. InputError as of `diagnose`."""
    return _prepared(campaign, model, known, say, CRITERIA)[0]


def _prepared(
    campaign: Campaign,
    model: Model,
    known: Mapping[str, Effect],
    say: Say,
    criteria: Criteria,
    before: Shelf | None = None,
) -> tuple[Shelf, dict[str, str]]:
    """The empty fit cache, and the effects that are refused and why. before: of other readings of the same tests."""
    model, known = sized_model(model, campaign), all_sized(known, scale_for(campaign))
    check_suitable([term.effect for term in model.terms], campaign)
    whole, found = trusted_and_fit(completed(campaign), model, _fit_of_nothing(before))
    candidates, refused = suitable(whole, model, known)
    if found is None or model.free:
        return Shelf(program(whole), model, candidates, say, criteria, before=before), refused
    fits = {frozenset[str](): found}
    return Shelf(found.residual.program, model, candidates, say, criteria, fits, before=before), refused


def _fit_of_nothing(shelf: Shelf | None) -> Fit | None:
    return None if shelf is None else shelf.fits.get(frozenset())


@dataclass(frozen=True, eq=False)
class Chosen:
    """What the criteria choose of all fits. untested: why nothing can be tested, or ""."""

    found: Found
    ruling: Ruling
    untested: str = ""


def chosen(shelf: Shelf, attempts: Attempts) -> Chosen:
    """The verdict and what it rests on. What is optional and fails is said in the attempts."""
    before = beginning(shelf)
    if why := untested(before):
        found = Found(shelf, frozenset(), ())
        return Chosen(found, Ruling("nothing_tested", (frozenset(),), before), why)
    plain = plain_zero(before, shelf.criteria)
    found = search_one_by_one(shelf) if plain else with_what_held_out_tests_need(search(shelf))
    judgement = judge(shelf.fit(found.best), shelf.criteria)
    shelf.say("what else could explain it")
    return Chosen(found, ruled(found, judgement, attempts))


def beginning(shelf: Shelf) -> Fit:
    """The base model fitted, or as it is where no fitted test has a reading to fit it to."""
    whole = shelf.whole
    if not (whole.predicted & whole.fitted[:, None]).any():
        shelf.fits[frozenset()] = unfitted(shelf.base, whole)
    return shelf.fit(frozenset())


def _agreements(shelf: Shelf, best: Names) -> dict[str, float]:
    stable = {name: agreement(shelf, best, name) for name in best}
    return {name: share for name, share in stable.items() if share is not None}


def _since(begin: float) -> float:
    return round(perf_counter() - begin, 3)


def suitable(
    campaign: Campaign, model: Model, known: Mapping[str, Effect]
) -> tuple[dict[str, Effect], dict[str, str]]:
    """Effects that could be added, by name, and why the others cannot."""
    can, cannot = {}, {}
    for name, effect in known.items():
        if name in model.names or not _may_exceed(effect, campaign) or _needs_a_sensor(effect):
            continue
        try:
            check_suitable([effect], campaign)
            can[name] = effect
        except InputError as error:
            cannot[name] = str(error)
    return can, cannot


def _needs_a_sensor(effect: Effect) -> bool:
    """Whether an effect is a kind of fault that no sensor has yet."""
    return isinstance(effect, SensorFault) and not effect.column


def _may_exceed(effect: Effect, campaign: Campaign) -> bool:
    """Whether an effect is more than the excess of what is written exactly."""
    return not effect.nominal or any(campaign.tolerance.get(key) for key in effect.nominal)
