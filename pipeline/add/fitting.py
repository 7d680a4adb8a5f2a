"""Adds effects to the model of a campaign, fits it to the measurements, and says what that changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from pipeline.add.sentences import sentences
from pipeline.add.summary import changes, confusable, error_of, is_noise, undetermined, values_of
from pipeline.answer import Answer, Correlation
from pipeline.campaign import Campaign
from pipeline.errors import InputError
from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import correlations, intervals, landscape, only_together
from pipeline.inference.model import Model
from pipeline.inference.model_file import Uncertainty
from pipeline.inference.program import Program, program
from pipeline.inference.sigmas import completed
from pipeline.inference.starts import best_fit
from pipeline.inference.suitable import check_suitable
from pipeline.provenance import commit, versions
from vjm.effects.base import Effect

Say = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Added:
    """The model at its best fit, and the answer about it."""

    model: Model
    answer: Answer

    @property
    def uncertainty(self) -> dict[str, Uncertainty]:
        """Of every fitted number, for the model's file."""
        return {
            name: Uncertainty(value.std, value.low95, value.high95)
            for name, value in self.answer.parameters.items()
            if value.interval != "fixed"
        }


def add(campaign: Campaign, model: Model, effects: Sequence[Effect], say: Say = lambda _: None) -> Added:
    """The campaign's model with further effects, all its free numbers fitted to the tests that may be fitted.

    No diagnosis is made: the verdict is "within_noise" where what is left looks like noise by its size
    and by its order along the load paths, else "unknown". Tests that are held out only have their error said.
    InputError for an effect that is in the model already or that the campaign cannot have, RuntimeError if the
    model has no prediction for any row that is fitted.
    """
    start = perf_counter()
    for effect in effects:
        if effect.name in model.names:
            raise InputError(f"{effect.name} is in the model already, allowed are effects that are not")
    check_suitable([*(term.effect for term in model.terms), *effects], campaign)
    whole = completed(campaign)
    cases = program(whole)
    say("the model as it was")
    before = fit(replace(model, fixed=frozenset(f.name for f in model.free) | model.fixed), cases)
    new = [effect.name for effect in effects]
    after = best_fit(model.with_effects(effects), cases, new, before.prediction, say)
    if after.prediction.lost[cases.fitted].all():
        reason = next(iter(after.prediction.reasons.values()))
        raise RuntimeError(
            f"the model with {', '.join(after.model.names)} cannot be solved anywhere: {reason}"
        )
    return _compared(cases, (before, after), len(model.free), new, say, start)


def remove(campaign: Campaign, model: Model, names: Sequence[str], say: Say = lambda _: None) -> Added:
    """The campaign's model without some of its effects, what it has left fitted again.

    Verdict and errors as in `add`. InputError for an effect that is not in the model.
    """
    start = perf_counter()
    for name in names:
        if name not in model.names:
            there = ", ".join(model.names) or "none"
            raise InputError(f"{name} is not in the model, allowed are its effects: {there}")
    whole = completed(campaign)
    cases = program(whole)
    say("the model as it was")
    before = fit(replace(model, fixed=frozenset(f.name for f in model.free) | model.fixed), cases)
    less = model
    for name in names:
        less = less.without(name)
    return _compared(cases, (before, fit(less, cases)), len(model.free), (), say, start)


def _compared(
    cases: Program, fits: tuple[Fit, Fit], numbers: int, new: Sequence[str], say: Say, start: float
) -> Added:
    """The answer about a fit, beside the one before, which had so many fitted numbers."""
    before, after = fits
    say("intervals")
    land = landscape(after, cases)
    values = values_of(after.model, intervals(land))
    pairs = correlations(land)
    names = [each.name for each in after.model.free]
    errors = (error_of(before, cases, numbers), error_of(after, cases, len(after.model.free)))
    answer = Answer(
        campaign=cases.campaign.name,
        verdict="within_noise" if is_noise(errors[-1]) else "unknown",
        effects=after.model.names,
        added=tuple(new),
        parameters=values,
        error=errors,
        tests=changes(before, after, cases),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=undetermined(values, [[names[k] for k in group] for group in only_together(land)]),
        confusable=confusable(names, pairs),
        evaluations=1 + after.evaluations + land.evaluations,
        seconds=round(perf_counter() - start, 3),
        commit=commit(),
        versions=versions(),
    )
    return Added(
        after.model, answer.model_copy(update={"sentences": sentences(answer, cases.campaign.remarks)})
    )
