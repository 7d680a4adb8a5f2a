"""A campaign, a model and what a diagnosis said, as one record for a page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from pipeline.answer.record import Answer
from pipeline.answer.value import Value
from pipeline.answer.wording.added import verdict_sentence
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.inference.driving import column_name, unit_of
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.model_file import Uncertainty
from pipeline.inference.suitable import Known, check_suitable
from pipeline.page.curves import rig_of, tests_of
from pipeline.page.dossier import dossier
from pipeline.page.record import CandidatePage, Dossier, EffectPage, Isolability, Page, RivalPage, Sigma
from pipeline.page.stages import Stages, stages
from pipeline.page.words import SOURCES, assumptions, by_hand, following, reading, tolerances_of, why
from pipeline.parameter_names import path_of
from pipeline.provenance import made_with
from reports.quantities import sigma
from vjm.effects import effect_of
from vjm.effects.base import Effect


@dataclass(frozen=True, eq=False)
class Subject:
    """What a page is about. uncertainty: of the model's numbers, as its file has it. answer: of a diagnosis that
    began with this model, if there was one; isolability, rivals: found with it. given: the campaign as it was
    written, where the diagnosis took its readings otherwise. fitted: the fit of the answer to the campaign, where it is
    at hand, with all that was fitted beside its effects."""

    campaign: Campaign
    model: Model
    known: Known
    uncertainty: Mapping[str, Uncertainty]
    answer: Answer | None = None
    isolability: Isolability | None = None
    rivals: tuple[RivalPage, ...] = ()
    given: Campaign | None = None
    fitted: Fit | None = None


def collect(it: Subject, commands: tuple[str, ...] = (), on_progress: OnProgress = lambda _: None) -> Page:
    """The page of a model that is as saved, or as the diagnosis leaves it. InputError for what does not fit."""
    whole = completed(it.campaign)
    model = shown_model(it)
    check_suitable([term.effect for term in model.terms], whole)
    cases = load_cases(whole)
    found = stages(model, cases, on_progress)
    record, failed = _dossier(it, model, cases, on_progress)
    answer = it.answer or _plain_answer(it, model, found)
    known = it.known.effects
    catalogue = [effect_of(name, known) for name in model.names]
    return Page(
        campaign=whole.name,
        folder=str(whole.folder or ""),
        rig=rig_of(whole),
        remarks=whole.remarks,
        verdict=answer.verdict,
        diagnosed=it.answer is not None,
        headline=headline(answer, found, it.answer is not None),
        sentences=answer.sentences[1:],
        effects=model.names,
        proposed=tuple(name for name in model.names if name not in it.model.names),
        error=found.error,
        parameters=answer.parameters,
        correlations=answer.correlations,
        out_by_plausibility=answer.out_by_plausibility,
        tests=tests_of(found.before, found.after),
        candidates=_candidates(answer, it.known),
        doctor=answer.doctor,
        nominals=answer.nominals,
        set_aside=answer.set_aside,
        by_hand=tuple(by_hand(whole)),
        noise=answer.noise,
        titles=_titles(answer, model, known),
        certain=answer.certain,
        alternatives=answer.alternatives,
        rivals=it.rivals,
        zeros=answer.zeros,
        laws=answer.laws,
        not_done=(*answer.not_done, *failed),
        dossier=record,
        following=tuple(following(whole, answer, it.answer is not None)),
        tolerances=tuple(tolerances_of(whole)),
        isolability=it.isolability,
        next_test=answer.next_test,
        catalogue=_catalogue(catalogue),
        sigmas=_sigmas(it.given or it.campaign, cases),
        assumptions=(*assumptions(whole, model.names, known), *reading(whole.rig.axes)),
        sources=(*SOURCES, *dict.fromkeys(f"{e.name}: {e.source}." for e in catalogue)),
        commands=commands,
        **made_with(),
    )


def _dossier(
    it: Subject, model: Model, cases: LoadCases, on_progress: OnProgress
) -> tuple[Dossier | None, tuple[str, ...]]:
    """Where it was looked for what is missing, the model's predictions beside the readings; and why not, if not."""
    if it.answer is None or not cases.predicted.any():
        return None, ()
    on_progress("predicted against measured")
    return dossier(it.campaign, model, it.fitted)


def _catalogue(effects: list[Effect]) -> tuple[EffectPage, ...]:
    return tuple(
        EffectPage(
            name=e.name,
            title=e.title,
            equation=e.equation,
            signature=e.signature,
            limits=e.limits,
            source=e.source,
        )
        for e in effects
    )


def shown_model(it: Subject) -> Model:
    """As saved, or as a diagnosis leaves it."""
    if it.answer is None:
        return it.model
    return proposed(it.model, it.answer, it.known) if it.fitted is None else it.fitted.model


def proposed(model: Model, answer: Answer, known: Known) -> Model:
    """The model that an answer leaves: its effects with its values."""
    terms = []
    for name in answer.effects:
        effect = effect_of(name, known.effects)
        values = {p.name: answer.parameters[path_of(name, p.name)].value for p in effect.parameters}
        terms.append(Term(effect, values))
    return replace(model, terms=tuple(terms))


def headline(answer: Answer, found: Stages, diagnosed: bool) -> str:
    """The verdict in one sentence."""
    cases = found.before.load_cases
    if not (cases.predicted | cases.unweighted).any():
        return "not measured yet: no reading that a model predicts; plan says what these tests can show."
    if diagnosed and answer.sentences:
        return answer.sentences[0]
    if found.untested:
        return found.untested
    if len(found.error) > 1:
        return verdict_sentence(answer.model_copy(update={"error": (found.error[0], found.error[-1])}))
    left = found.error[0].fit
    if answer.verdict == "within_noise":
        return (
            f"within_noise: plain virtual springs explain the measurements, {sigma(left)} sigma are left "
            "(1 is noise)."
        )
    return f"plain virtual springs leave {sigma(left)} sigma (1 is noise); what is missing has not been looked for."


def _plain_answer(it: Subject, model: Model, found: Stages) -> Answer:
    return Answer(
        campaign=it.campaign.name,
        verdict=found.verdict,
        effects=model.names,
        parameters=_parameters(model, it.uncertainty),
        error=found.error,
    )


def _parameters(model: Model, uncertainty: Mapping[str, Uncertainty]) -> dict[str, Value]:
    """Values with what the model's file says of them."""
    out = {}
    for term in model.terms:
        for p in term.effect.parameters:
            name = path_of(term.effect.name, p.name)
            known = uncertainty.get(name)
            out[name] = Value(
                value=float(term.values[p.name]),
                std=None if known is None else known.std,
                low95=None if known is None else known.low95,
                high95=None if known is None else known.high95,
                interval=_kind(known),
                unit=p.unit,
                meaning=p.meaning,
            )
    return out


def _kind(known: Uncertainty | None) -> Literal["fixed", "undetermined", "profile"]:
    """How an interval is known from a model's file."""
    if known is None:
        return "fixed"
    nothing = known.std is None and known.low95 is None and known.high95 is None
    return "undetermined" if nothing else "profile"


def _candidates(answer: Answer, known: Known) -> tuple[CandidatePage, ...]:
    return tuple(
        CandidatePage(
            effect=c.effect,
            title=effect_of(c.effect, known.effects).title,
            chosen=c.effect in answer.effects,
            screen=c.screen,
            fit=c.fit,
            crossvalidated=c.crossvalidated,
            evidence=c.evidence,
            why=why(c, answer),
        )
        for c in answer.candidates
    )


def _titles(answer: Answer, model: Model, known: Mapping[str, Effect]) -> dict[str, str]:
    """In words, every effect that the page names."""
    sets = (model.names, answer.effects, *answer.alternatives, *answer.out_by_plausibility)
    names = [name for each in sets for name in each]
    names += [it.effect for it in answer.certain] + [it.effect for it in answer.candidates]
    return {name: effect_of(name, known).title for name in dict.fromkeys(names)}


def _sigmas(given: Campaign, cases: LoadCases) -> tuple[Sigma, ...]:
    """Of every channel that is measured."""
    told = np.concatenate([given.noise.displacement, given.noise.wrench, given.noise.gauges])
    return tuple(
        Sigma(
            column=column_name(int(k), given.gauges),
            value=float(cases.sigma[k]),
            unit=unit_of(int(k)),
            given=bool(np.isfinite(told[k])),
        )
        for k in np.flatnonzero(np.isfinite(cases.measured).any(axis=0) & np.isfinite(cases.sigma))
    )
