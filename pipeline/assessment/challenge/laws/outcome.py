"""One case with hidden laws, measured, diagnosed and looked at for laws, and judged: places, forms and names."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from time import process_time
from typing import Any

import numpy as np

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.laws.cases import Kind, LawCase, clean_case, law_case, pair_case
from pipeline.assessment.challenge.laws.measured import SEEN, Truth, measured
from pipeline.assessment.challenge.laws.names import FORMS, same_physics
from pipeline.assessment.extrapolation.correction import corrected
from pipeline.assessment.study import Tried
from pipeline.campaign import Campaign
from pipeline.discover.beyond_catalogue import looked
from pipeline.discover.evidence import Rest
from pipeline.discover.search import Added, Discovery, Law, discover
from pipeline.discrepancy.gaussian import gaussian
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.residual import residual
from pipeline.inference.suitable import scale_for
from pipeline.record import Record
from pipeline.selection.diagnosis import Diagnosis, diagnose, suitable
from vjm.effects import catalogue
from vjm.effects.sized import all_sized

MAKE: Mapping[Kind, Callable[[int, float], LawCase]] = {
    "law": law_case,
    "pair": pair_case,
    "clean": clean_case,
}


class HiddenLaw(Record):
    """What was hidden."""

    site: str
    law: str
    mu: float
    """Sigmas by which it shows in the fitted tests."""
    told: float = 0.0
    """Sigmas by which it shows beside all that the tolerances of the bench explain: no method tells it by more."""
    forms: tuple[str, ...]
    """Names of the forms that are the same law or hold it; none where there is none."""


class Place(Record):
    """What was found."""

    site: str
    """The best site, or the effect that entered the model."""
    group: tuple[str, ...]
    """All sites that are not told apart, with it."""
    forms: tuple[str, ...]
    """Forms that are ties, the chosen one first."""
    evidence: float


class LawOutcome(Tried):
    """A case and what became of it."""

    number: int
    kind: Kind
    poor: bool
    dirt: dict[str, float]
    hidden: tuple[HiddenLaw, ...]
    found: tuple[Place, ...] = ()
    whole: bool = False
    verdict: str = ""
    sets: tuple[tuple[str, ...], ...] = ()
    certain: tuple[str, ...] = ()
    told: tuple[str, ...] = ()
    """Sites of the laws that the diagnosis tells."""
    wrong_names: tuple[str, ...] = ()
    """Names of the catalogue that are not what was hidden: in the only set, in all of several without a law beside
    them, or certain."""
    held_out: tuple[float, ...] = ()
    """Whitened RMS of each held-out test that sees a law, by the model with what was found."""
    excess: float | None = None
    """sqrt(rms² - 1) over these tests together, at least 0."""
    excess_of_process: float | None = None
    """The same of a Gaussian process on the residual of the model without laws."""
    error: str = ""
    seconds: float = 0.0
    """Of the processor until the answer; without a diagnosis that of `discover`."""
    seconds_of_diagnosis: float = 0.0
    """Of them, before laws are looked for."""

    @property
    def size(self) -> float:
        """The least mu, 0 where nothing is hidden."""
        return min((law.mu for law in self.hidden), default=0.0)

    @property
    def told_by(self) -> float:
        """The least size beside the tolerances, 0 where nothing is hidden."""
        return min((law.told for law in self.hidden), default=0.0)

    @property
    def right(self) -> tuple[bool, ...]:
        """Of each hidden law, whether its site is in a group."""
        return tuple(any(law.site in place.group for place in self.found) for law in self.hidden)

    @property
    def form_among(self) -> tuple[bool, ...]:
        """Of each hidden law that has a form and whose site was found, whether that form is among the ties."""
        return tuple(
            any(law.site in place.group and set(law.forms) & set(place.forms) for place in self.found)
            for law, right in zip(self.hidden, self.right, strict=True)
            if law.forms and right
        )

    @property
    def false_places(self) -> int:
        """Of what was found, how many hold no hidden site."""
        true = {law.site for law in self.hidden}
        return sum(not true & set(place.group) for place in self.found)


def law_outcome(kind: Kind, number: int, commit: str, code: str, diagnosing: bool = True) -> LawOutcome:
    """The outcome of the case of that kind and number. diagnosing: with the diagnosis, which takes longer."""
    common: dict[str, Any] = {"number": number, "kind": kind, "commit": commit, "code": code}
    try:
        campaign, truth = measured(MAKE[kind], number)
    except RuntimeError as error:
        it = MAKE[kind](number, 1.0)
        return LawOutcome(**common, poor=it.poor, dirt=it.dirt.words, hidden=(), error=f"bench: {error}")
    common |= {
        "poor": truth.case.poor,
        "dirt": truth.case.dirt.words,
        "hidden": hidden_laws(truth, campaign),
    }
    try:
        began = process_time()
        found: Discovery | None = None
        if diagnosing:
            plain = diagnose(campaign, Model(), catalogue())
            common["seconds_of_diagnosis"] = round(process_time() - began, 2)
            answer, found = looked(plain)
            common |= _named(answer, truth) | {"seconds": round(process_time() - began, 2)}
        if found is None:
            found = discovered(campaign)
            common.setdefault("seconds", round(process_time() - began, 2))
        common |= _judged(found, campaign, truth)
    except (RuntimeError, ArithmeticError, ValueError) as error:
        common["error"] = f"{type(error).__name__}: {error}"
    return LawOutcome(**common)


def discovered(campaign: Campaign, but: str = "") -> Discovery:
    """The laws of a campaign's fitted tests beside the plain model. but: effect that the catalogue lacks. ValueError
    for a rig without sites."""
    known = {name: effect for name, effect in catalogue().items() if name != but}
    effects, _ = suitable(campaign, Model(), all_sized(known, scale_for(campaign)))
    fitted = tuple(test for test in campaign.tests if test.role == "fit")
    return discover(load_cases(replace(campaign, tests=fitted)), Model(), effects)


def reference(campaign: Campaign) -> Rest:
    """What the plain model with bars that bend far leaves of the fitted tests, with the tolerances beside it."""
    fitted = tuple(test for test in campaign.tests if test.role == "fit")
    cases = load_cases(replace(campaign, tests=fitted))
    return Rest.of(unfitted(Model().with_effects([catalogue()[ALWAYS]]), cases).residual)


def hidden_laws(truth: Truth, campaign: Campaign) -> tuple[HiddenLaw, ...]:
    """What was hidden in a campaign, and by how much it shows there."""
    if not truth.laws:
        return ()
    rest = reference(campaign)
    return tuple(
        HiddenLaw(
            site=law.placed.site,
            law=law.name,
            mu=law.mu,
            told=float(np.linalg.norm(rest.weakened(rest.seen(law.shown)))),
            forms=FORMS.get(law.name, ()),
        )
        for law in truth.laws
    )


def _judged(found: Discovery, campaign: Campaign, truth: Truth) -> dict[str, Any]:
    seen = [name for name, mu in truth.held_out_mu.items() if mu >= SEEN]
    errors = _errors(found.end.model, campaign, seen)
    out: dict[str, Any] = {"found": tuple(_places(found)), "whole": found.whole}
    if truth.laws and errors:
        out |= {"held_out": tuple(_rms(each) for each in errors), "excess": _excess(errors)}
        out["excess_of_process"] = _excess(_of_process(found, campaign, seen))
    return out


def _places(found: Discovery) -> Iterator[Place]:
    for step in found.steps:
        if isinstance(step, Law):
            group = tuple(it.site.name for it in step.group)
            forms = tuple(way.formed.form.name for way in step.ways)
            yield Place(site=group[0], group=group, forms=forms, evidence=step.evidence)
        elif isinstance(step, Added):
            sites = tuple(it.site.name for it in step.sites)
            yield Place(site=step.body.effect.name, group=sites, forms=(), evidence=step.body.value)


def _errors(model: Model, campaign: Campaign, names: list[str]) -> list[np.ndarray]:
    """Whitened residuals of some held-out tests."""
    whole = load_cases(campaign)
    left = unfitted(model, whole).residual.left
    return [
        left[whole.test == k][whole.predicted[whole.test == k]]
        for k, test in enumerate(campaign.tests)
        if test.id in names
    ]


def _of_process(found: Discovery, campaign: Campaign, names: list[str]) -> list[np.ndarray]:
    """The same by a Gaussian process that learned the residual of the model without laws."""
    fitted = tuple(test for test in campaign.tests if test.role == "fit")
    held = tuple(replace(test, role="fit") for test in campaign.tests if test.id in names)
    cases, asked = (load_cases(replace(campaign, tests=tests)) for tests in (fitted, held))
    model = found.begin.model
    base, there = unfitted(model, cases), unfitted(model, asked)
    learned = corrected(gaussian, cases, base.prediction, asked, there.prediction)
    left = residual(asked, learned).left
    return [left[asked.test == k][asked.predicted[asked.test == k]] for k in range(len(held))]


def _rms(residuals: np.ndarray) -> float:
    return float(np.sqrt(np.mean(residuals**2)))


def _excess(errors: list[np.ndarray]) -> float:
    return float(np.sqrt(max(_rms(np.concatenate(errors)) ** 2 - 1.0, 0.0)))


def _named(answer: Diagnosis, truth: Truth) -> dict[str, Any]:
    sets = tuple(tuple(n for n in names if n != ALWAYS) for names in answer.possible)
    sure = tuple(n for n in answer.certain if n != ALWAYS)
    told = tuple(law.site for law in answer.laws)
    allowed = {name for law in truth.laws for name in same_physics(law.name, law.placed.site)}
    wrong = {n for n in sure if n not in allowed}
    if answer.verdict == "identified" or (answer.verdict == "ambiguous" and not answer.decision.law):
        false = [set(names) - allowed for names in sets]
        if all(false):
            wrong |= set.union(*false)
    return {
        "verdict": answer.verdict,
        "sets": sets,
        "certain": sure,
        "told": told,
        "wrong_names": tuple(sorted(wrong)),
    }
