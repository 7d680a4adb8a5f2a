"""Adds effects to the model of a campaign, fits it to the measurements, and says what that changed."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from pipeline.answer.record import Answer, Correlation
from pipeline.answer.summary import (
    changes,
    confusable,
    error_of,
    nominals_of,
    uncertainty_of,
    undetermined,
    values_of,
)
from pipeline.answer.wording.added import sentences
from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.campaign.order import by_name
from pipeline.errors import InputError
from pipeline.inference.declared_sigmas import trusted
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import Fit, fit, numbers_of, unfitted
from pipeline.inference.intervals import correlations, intervals, only_together, profile_likelihood, straight
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model, at_bound
from pipeline.inference.model_file import Uncertainty
from pipeline.inference.multistart import best_fit
from pipeline.inference.prediction import predict
from pipeline.inference.suitable import check_suitable, scale_for, sized_model
from pipeline.provenance import made_with
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.adequacy.untested import in_units, untested
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.fit_cache import FitCache
from vjm.effects.base import Effect
from vjm.effects.sized import sized

WORSE = 1.0
"""Chi-square by which a fit may leave more than the model before: a step that noise takes."""
NOTHING = 1e-9
"""Of chi-square: a fall by less is rounding."""


@dataclass(frozen=True, eq=False)
class Added:
    """The model at its best fit, and the answer about it. keep: why it should not take the place of a saved model, ""
    if nothing speaks against it."""

    model: Model
    answer: Answer
    keep: str = ""

    @property
    def uncertainty(self) -> dict[str, Uncertainty]:
        """Of every fitted number, for the model's file."""
        return uncertainty_of(self.answer.parameters, self.model)


def add(
    campaign: Campaign, model: Model, effects: Sequence[Effect], on_progress: OnProgress = lambda _: None
) -> Added:
    """The campaign's model with further effects, all its free numbers fitted to the tests that may be fitted.

    No diagnosis is made: the verdict is "within_noise" where what is left passes the same checks as in a diagnosis,
    "nothing_tested" where no reading is left to test it by, else "unknown". Tests that are held out only have their
    error said. Effects enter one after the other, each from where the fit without it stands, so that a larger model
    never leaves more. InputError for an effect that is in the model already or that the campaign cannot have.
    """
    start = perf_counter()
    for effect in effects:
        if effect.name in model.names:
            raise InputError(f"{effect.name} is in the model already, allowed are effects that are not")
    model, scale = sized_model(model, campaign), scale_for(campaign)
    effects = [sized(effect, scale) for effect in effects]
    check_suitable([*(term.effect for term in model.terms), *effects], campaign)
    whole = trusted(completed(by_name(campaign)), model)
    cases = load_cases(whole)
    on_progress("the model as it was")
    before = unfitted(model, cases)
    cache = FitCache(cases, model, {effect.name: effect for effect in effects}, on_progress)
    new = tuple(effect.name for effect in effects)
    if (cases.predicted & cases.fitted[:, None]).any():
        for count in range(len(new)):
            cache.fit(frozenset(new[: count + 1]))
        after = cache.fit(frozenset(new))
        # Without the pull of plausible sizes: intervals are about the least chi-square itself, and where only
        # combinations of numbers are seen, it may be elsewhere on their ridge. One that ran out of its work would
        # do so again.
        if not any(each.ended for each in cache.fits.values()):
            polished = fit(after.model, cases, after.prediction)
            anew = best_fit(
                model.with_effects(effects), cases, new, predict(model, cases, slopes=False), on_progress
            )
            after = min(polished, anew, key=lambda each: each.order)
    else:
        after = unfitted(model.with_effects(effects), cases)
    return _compared(cases, (before, after), model, new, on_progress, start, cache.unseen if new else ())


def remove(
    campaign: Campaign, model: Model, names: Sequence[str], on_progress: OnProgress = lambda _: None
) -> Added:
    """The campaign's model without some of its effects, what it has left fitted again.

    Verdict and errors as in `add`. InputError for an effect that is not in the model.
    """
    start = perf_counter()
    for name in names:
        if name not in model.names:
            there = ", ".join(model.names) or "none"
            raise InputError(f"{name} is not in the model, allowed are its effects: {there}")
    model = sized_model(model, campaign)
    check_suitable([term.effect for term in model.terms], campaign)
    whole = trusted(completed(by_name(campaign)), model)
    cases = load_cases(whole)
    on_progress("the model as it was")
    before = unfitted(model, cases)
    less = model
    for name in names:
        less = less.without(name)
    return _compared(cases, (before, fit(less, cases)), model, (), on_progress, start)


def _compared(
    cases: LoadCases,
    fits: tuple[Fit, Fit],
    was: Model,
    new: Sequence[str],
    on_progress: OnProgress,
    start: float,
    unseen: Collection[str] = (),
) -> Added:
    """The answer about a fit, beside the one before, of the model as it was, which was fitted to these tests. unseen:
    numbers that stayed at null because these readings do not see them."""
    before, after = fits
    numbers = numbers_of(was, cases, before.prediction)
    on_progress("intervals")
    attempts = Attempts()
    land = profile_likelihood(after, cases)
    nothing = untested(before, numbers) or untested(after)
    judged = None if nothing else judge(after)
    # As in a diagnosis.
    surely = judged is not None and judged.noise
    ends = attempts.get("intervals", lambda: intervals(land) if surely else straight(land), None) or straight(
        land
    )
    values = {
        name: it.model_copy(update={"interval": "undetermined"}) if name in unseen else it
        for name, it in values_of(after.model, ends).items()
    }
    pairs = attempts.get("correlations of the numbers", lambda: correlations(land), [])
    together = attempts.get("what is seen only together", lambda: only_together(land), [])
    names = [each.name for each in after.model.free]
    errors = (error_of(before, cases, numbers), error_of(after, cases, after.numbers, judged))
    answer = Answer(
        campaign=cases.campaign.name,
        verdict="unknown" if judged and not judged.noise else "within_noise" if judged else "nothing_tested",
        effects=after.model.names,
        added=tuple(new),
        parameters=values,
        error=errors,
        tests=changes(before, after, cases),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=undetermined(values, [[names[k] for k in group] for group in together]),
        confusable=confusable(names, pairs),
        at_bound=at_bound(after.model),
        nominals=attempts.get("what was written about the rig", lambda: nominals_of(after, CRITERIA), ()),
        not_done=tuple(attempts.failed),
        evaluations=1 + after.evaluations + land.evaluations,
        seconds=round(perf_counter() - start, 3),
        **made_with(),
        data=dict(cases.campaign.digests),
    )
    keep = _keeps(before, after, numbers, nothing) if new else ""
    said = sentences(answer, cases.campaign.remarks, nothing or "", in_units(after), keep)
    return Added(after.model, answer.model_copy(update={"sentences": said}), keep)


def _keeps(before: Fit, after: Fit, numbers: int, nothing: str | None) -> str:
    """Why a fit should not take the place of the model before it, which had so many fitted numbers."""
    rows = after.residual.load_cases.fitted
    lost = int(np.sum(after.prediction.lost & ~before.prediction.lost & rows))
    if nothing:
        return "nothing was tested"
    if after.prediction.lost[rows].all():
        return "it has no prediction for any fitted row"
    if lost:
        return f"it has no prediction for {lost} rows for which the model before has one"
    if after.chi_square > before.chi_square + WORSE:
        return "it leaves more than the model before"
    if after.numbers > numbers and after.chi_square >= before.chi_square * (1.0 - NOTHING):
        return "its further numbers take nothing off what the model before leaves"
    return ""
