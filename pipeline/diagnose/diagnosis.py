"""From a campaign and a model to a verdict: what is missing, what could be, or that nothing known explains it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from pipeline.add.summary import changes, confusable, error_of, undetermined, values_of
from pipeline.answer import Answer, Candidate, Correlation, Verdict
from pipeline.campaign import Campaign
from pipeline.campaign.names import COORDINATES
from pipeline.diagnose.apart import Likeness, likenesses
from pipeline.diagnose.beyond import with_what_held_out_tests_need
from pipeline.diagnose.folds import agreement, crossvalidated, crossvalidated_with
from pipeline.diagnose.menu import Choice
from pipeline.diagnose.merit import taken
from pipeline.diagnose.next_test import NextTest, best_next_test
from pipeline.diagnose.refuse import Judgement, judge
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.search import search
from pipeline.diagnose.sensor_faults import Instead, faults_instead
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.diagnose.signatures import Say
from pipeline.errors import InputError
from pipeline.inference.fit import Fit
from pipeline.inference.intervals import correlations, intervals, landscape, only_together, straight
from pipeline.inference.model import Model
from pipeline.inference.program import program
from pipeline.inference.sigmas import completed
from pipeline.inference.suitable import check_suitable
from pipeline.provenance import commit, versions
from vjm.effects.base import Effect

FEW = 3
"""Rivals for which the next test is sought."""


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What was found. sets: the effects to add, the simplest first; one where the verdict is certain. instead: faults
    of sensors that explain as much as an effect of the best set.

    refused: effects that the rig or the campaign cannot have, and why.
    """

    campaign: Campaign
    verdict: Verdict
    found: Found
    sets: tuple[tuple[str, ...], ...]
    instead: tuple[Instead, ...]
    judgement: Judgement
    alike: tuple[Likeness, ...]
    agreement: Mapping[str, float]
    next_test: NextTest | None
    refused: Mapping[str, str]
    seconds: float = 0.0
    fit: Fit = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "fit", self.shelf.fit(frozenset(self.sets[0])))

    @property
    def shelf(self) -> Shelf:
        """All that was fitted."""
        return self.found.shelf

    @property
    def possible(self) -> tuple[tuple[str, ...], ...]:
        """The sets, and those that need a fault of a sensor beside them."""
        return (*self.sets, *dict.fromkeys(self.shelf.order(it.without) for it in self.instead))

    @property
    def model(self) -> Model:
        """The model with the first set, fitted."""
        return self.fit.model


def diagnose(
    campaign: Campaign, model: Model, known: Mapping[str, Effect], say: Say = lambda _: None
) -> Diagnosis:
    """Look for what the model lacks. InputError for a campaign that cannot be judged or a model that it cannot have."""
    begin = perf_counter()
    whole = completed(campaign)
    check_suitable([term.effect for term in model.terms], whole)
    candidates, refused = suitable(whole, model, known)
    cases = program(whole)
    if not (cases.predicted & cases.fitted[:, None]).any():
        raise InputError(
            f"{campaign.name}: no fitted test has a reading that a model predicts, so nothing to diagnose"
        )
    shelf = Shelf(cases, model, candidates, say)
    found = with_what_held_out_tests_need(search(shelf))
    judgement = judge(shelf.fit(found.best))
    sets = sorted((found.best, *found.rivals), key=lambda n: _simplicity(shelf, n))
    say("what a sensor's fault would explain")
    instead = faults_instead(found) if judgement.noise else ()
    verdict = _verdict(found, judgement, instead)
    if verdict != "ambiguous":
        sets = [found.best]
    say("what could be taken for what")
    next_test = None
    if len(sets) > 1:
        say("the next test")
        next_test = best_next_test([shelf.fit(n) for n in sets[:FEW]], shelf.whole)
    named = tuple(shelf.order(names) for names in sets)
    stable = {name: agreement(shelf, found.best, name) for name in found.best}
    return Diagnosis(
        whole,
        verdict,
        found,
        named,
        instead,
        judge(shelf.fit(sets[0])),
        tuple(likenesses(shelf, found.best)),
        {name: share for name, share in stable.items() if share is not None},
        next_test,
        refused,
        round(perf_counter() - begin, 3),
    )


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


def _verdict(found: Found, judgement: Judgement, instead: tuple[Instead, ...]) -> Verdict:
    if not judgement.noise:
        return "unknown"
    if not found.best:
        return "within_noise"
    return "ambiguous" if found.rivals or instead else "identified"


def _simplicity(shelf: Shelf, names: Names) -> tuple[int, int, float]:
    return len(names), taken(shelf, names), shelf.fit(names).chi_square


def answer_of(it: Diagnosis, sentences: tuple[str, ...] = (), found: Fit | None = None) -> Answer:
    """The diagnosis as a record. found: whose numbers it has, default those of the first set."""
    shelf, whole, found = it.shelf, it.shelf.whole, found or it.fit
    before = shelf.fit(frozenset())
    land = landscape(found, whole)
    values = values_of(found.model, intervals(land) if it.judgement.noise else straight(land))
    pairs = correlations(land)
    names = [each.name for each in found.model.free]
    steps = [before, *_steps(it)]
    return Answer(
        campaign=it.campaign.name,
        verdict=it.verdict,
        effects=it.model.names,
        added=it.sets[0],
        alternatives=tuple((*shelf.base.names, *names) for names in it.possible[1:]),
        parameters=values,
        error=tuple(error_of(each, whole, len(each.model.free)) for each in steps),
        tests=changes(before, it.fit, whole),
        candidates=candidates_of(it),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=undetermined(values, [[names[k] for k in group] for group in only_together(land)]),
        confusable=confusable(names, pairs) + _alike(it),
        next_test=next_test_record(it.next_test, it.sets),
        sentences=sentences,
        evaluations=shelf.evaluations + land.evaluations,
        seconds=it.seconds,
        commit=commit(),
        versions=versions(),
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
    return tuple(dict.fromkeys((a.effect, a.rival) for a in it.alike if a.correlation > 0.9))


def candidates_of(it: Diagnosis) -> tuple[Candidate, ...]:
    """Every effect that was tried: what it promised, what it did, how it does in tests it did not see."""
    shelf, best = it.shelf, it.found.best
    root = frozenset(name for name in best if not shelf.candidates[name].parameters)
    about = shelf.picture(root)
    least = _bic(shelf, best)
    out = []
    for name in shelf.candidates:
        mine = [names for names in shelf.fits if name in names]
        top = min(mine, key=lambda names: _bic(shelf, names), default=None)
        screen = cross = None
        if name in about.signatures:
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
