"""From a campaign and a model to a verdict: what is missing, what could be, or that nothing known explains it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from pipeline.add.summary import changes, confusable, error_of, undetermined, values_of
from pipeline.adequacy.judgement import Judgement, judge
from pipeline.adequacy.untested import untested
from pipeline.answer import Answer, Candidate, Correlation, UnknownZero, Verdict
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.campaign.names import COORDINATES
from pipeline.diagnose.apart import Likeness
from pipeline.diagnose.beyond import with_what_held_out_tests_need
from pipeline.diagnose.folds import agreement, crossvalidated, crossvalidated_with
from pipeline.diagnose.menu import Choice
from pipeline.diagnose.merit import taken
from pipeline.diagnose.next_test import NextTest, best_next_test
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.ruling import Ruling, ruled
from pipeline.diagnose.search import search, search_one_by_one
from pipeline.diagnose.sensor_faults import Instead, plain_zero
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.diagnose.signatures import Say
from pipeline.diagnose.zeros import Zero
from pipeline.errors import InputError
from pipeline.inference.claims import trusted
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.intervals import correlations, intervals, landscape, only_together, straight
from pipeline.inference.model import Model
from pipeline.inference.program import program
from pipeline.inference.sigmas import completed
from pipeline.inference.suitable import check_suitable, scale_for, sized_model
from pipeline.provenance import commit, versions
from pipeline.selection.criteria import CRITERIA, Criteria
from vjm.effects.base import Effect
from vjm.effects.sized import all_sized


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What was found. ruling: the verdict and what it rests on. untested: why nothing can be tested, or "".

    refused: effects that the rig or the campaign cannot have, and why. failed: optional parts that failed, and why.
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
    whole, attempts = shelf.whole.campaign, Attempts()
    it = chosen(shelf, attempts)
    if it.untested:
        found, judgement = Found(shelf, frozenset(), ()), Judgement((), 1.0)
        return Diagnosis(
            whole, found, it.ruling, judgement, {}, None, refused, it.untested, (), _since(begin)
        )
    found, ruling = it.found, it.ruling
    next_test = None
    if len(ruling.sets) > 1:
        say("the next test")
        fits = [shelf.fit(n) for n in ruling.sets[: criteria.next_test_sets]]
        next_test = attempts.get("the next test", lambda: best_next_test(fits, shelf.whole), None)
    stable = attempts.get("whether folds of the tests agree", lambda: _agreements(shelf, found.best), {})
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
    )


def fit_cache(campaign: Campaign, model: Model, known: Mapping[str, Effect]) -> Shelf:
    """Where fits of the campaign are kept, none made yet. InputError as of `diagnose`."""
    return _prepared(campaign, model, known, lambda _: None, CRITERIA)[0]


def _prepared(
    campaign: Campaign, model: Model, known: Mapping[str, Effect], say: Say, criteria: Criteria
) -> tuple[Shelf, dict[str, str]]:
    """The empty fit cache, and the effects that are refused and why."""
    model, known = sized_model(model, campaign), all_sized(known, scale_for(campaign))
    check_suitable([term.effect for term in model.terms], campaign)
    whole = trusted(completed(campaign), model)
    candidates, refused = suitable(whole, model, known)
    return Shelf(program(whole), model, candidates, say, criteria), refused


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
        if name in model.names:
            continue
        try:
            check_suitable([effect], campaign)
            can[name] = effect
        except InputError as error:
            cannot[name] = str(error)
    return can, cannot


def answer_of(it: Diagnosis, sentences: tuple[str, ...] = (), found: Fit | None = None) -> Answer:
    """The diagnosis as a record. found: whose numbers it has, default those of the first set."""
    shelf, whole, found = it.shelf, it.shelf.whole, found or it.fit
    before, attempts = shelf.fit(frozenset()), Attempts()
    land = landscape(found, whole)
    surely = it.judgement.noise and not it.untested
    ends = attempts.get("intervals", lambda: intervals(land) if surely else straight(land), None) or straight(
        land
    )
    values = values_of(found.model, ends)
    pairs = attempts.get("correlations of the numbers", lambda: correlations(land), [])
    together = attempts.get("what is seen only together", lambda: only_together(land), [])
    names = [each.name for each in found.model.free]
    steps = [before, *_steps(it)]
    return Answer(
        campaign=it.campaign.name,
        verdict=it.verdict,
        effects=it.model.names,
        added=it.sets[0],
        alternatives=tuple((*shelf.base.names, *names) for names in it.possible[1:]),
        parameters=values,
        error=tuple(
            error_of(each, whole, len(each.model.free), it.judgement if each is steps[-1] else None)
            for each in steps
        ),
        tests=changes(before, it.fit, whole),
        # Where nothing is tested no candidate promises anything.
        candidates=()
        if it.untested
        else attempts.get("the table of candidates", lambda: candidates_of(it), ()),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=undetermined(values, [[names[k] for k in group] for group in together]),
        confusable=confusable(names, pairs) + _alike(it),
        next_test=next_test_record(it.next_test, it.sets),
        at_bound=it.ruling.at_bound,
        out_by_plausibility=tuple((*shelf.base.names, *shelf.order(n)) for n in it.ruling.out),
        zeros=()
        if it.ruling.zero is None or it.ruling.zero.zero is None
        else (zero_record(it.ruling.zero.zero),),
        not_done=(*it.failed, *attempts.failed),
        sentences=sentences,
        evaluations=shelf.evaluations + land.evaluations,
        seconds=it.seconds,
        commit=commit(),
        versions=versions(),
        data=dict(it.campaign.digests),
    )


def zero_record(it: Zero) -> UnknownZero:
    """As a record."""
    return UnknownZero(
        column=it.column, tests=it.tests, value=it.value, std=it.std, unit=it.unit, chi_square=it.gain
    )


def _steps(it: Diagnosis) -> list[Fit]:
    """Fits on the way to the first set, the effect that explains most first; those that were made."""
    shelf, goal = it.shelf, frozenset(it.sets[0])
    here: Names = frozenset()
    out = []
    while here != goal:
        ahead = [here | {name} for name in goal - here if here | {name} in shelf.fits]
        if not ahead:
            out.append(shelf.fit(goal))
            break
        here = min(ahead, key=lambda names: shelf.fit(names).chi_square)
        out.append(shelf.fit(here))
    return out


def _alike(it: Diagnosis) -> tuple[tuple[str, ...], ...]:
    return tuple(
        dict.fromkeys(
            (a.effect, a.rival) for a in it.alike if 1.0 - a.correlation < it.shelf.criteria.confusable_within
        )
    )


def candidates_of(it: Diagnosis) -> tuple[Candidate, ...]:
    """Every effect that was tried: what it promised, what it did, how it does in tests it did not see."""
    shelf, best = it.shelf, it.found.best
    root = frozenset(name for name in best if not shelf.candidates[name].parameters)
    # After a search that took too long there is no time for what was not looked at.
    about = shelf.pictures.get(root) if it.found.ended else shelf.picture(root)
    least = _bic(shelf, best)
    out = []
    for name in shelf.candidates:
        mine = [names for names in shelf.fits if name in names]
        top = min(mine, key=lambda names: _bic(shelf, names), default=None)
        screen = cross = None
        if about is not None and name in about.signatures:
            left = about.fit.chi_square - about.gain([name]).value
            screen = float(np.sqrt(max(left, 0.0) / max(about.fit.degrees, 1)))
            cross = crossvalidated_with(about, name)
        fitted = None if top is None else shelf.fit(top)
        out.append(
            Candidate(
                effect=name,
                screen=screen,
                fit=None if fitted is None else fitted.rms,
                crossvalidated=cross if fitted is None else crossvalidated(fitted),
                evidence=None if top is None else _bic(shelf, top) - least,
            )
        )
    return tuple(sorted(out, key=lambda c: (c.evidence is None, c.evidence or 0.0, c.screen or np.inf)))


def _bic(shelf: Shelf, names: Names) -> float:
    found = shelf.fit(names)
    return found.chi_square + taken(shelf, names) * float(np.log(max(found.whitened.size, 2)))


def next_test_record(it: NextTest | None, sets: tuple[tuple[str, ...], ...]) -> dict[str, object] | None:
    """The next test as JSON, what it would tell apart, and a second one where only both together tell."""
    if it is None or not it.apart:
        return None
    first, *others = [_test_record(choice) for choice in it.choices]
    return {
        **first,
        "tells_apart": [[list(sets[a]), list(sets[b])] for a, b in it.apart],
        "expected_chi_square": [it.parted[pair] for pair in it.apart],
        "together_with": others,
    }


def _test_record(choice: Choice) -> dict[str, object]:
    return {
        "q_deg": choice.test.q_deg,
        "control": dict(zip(COORDINATES, choice.test.control, strict=True)),
        "driven": COORDINATES[choice.shape.coordinate],
        "largest": choice.limit,
        "why": in_words(choice),
    }


def in_words(choice: Choice) -> str:
    """A test of the menu."""
    unit = ("N", "mm", "mm", "rad", "rad", "rad")[choice.shape.coordinate]
    warm = ", 10 K warmer" if choice.warmer else ""
    return f"q = {choice.test.q_deg:g}°, {choice.shape.words}, there and back to ±{choice.limit:.3g} {unit}{warm}"
