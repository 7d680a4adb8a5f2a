"""The base models and a saved one against a campaign, each with its failure if it has no prediction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from time import perf_counter

import numpy as np

from pipeline.answer.record import DoctorFinding
from pipeline.attempt import Attempts, plain
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.compare.error import Discrepancy
from pipeline.compare.failure import findings, groups, too_short
from pipeline.compare.headline import headline
from pipeline.compare.record import Comparison, ModelError
from pipeline.inference.declared_sigmas import trusted
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import Fit, numbers_of, unfitted
from pipeline.inference.frame_prediction import predict_frame
from pipeline.inference.linear_prediction import predict_linear
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import nominals
from pipeline.inference.objective import Objective
from pipeline.inference.predicted import Prediction, moved_along
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual
from pipeline.inference.suitable import check_suitable, sized_model
from pipeline.provenance import made_with
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.adequacy.untested import in_units, untested
from pipeline.selection.examined import mistakes_of
from vjm.effects.bar_geometric_nonlinearity import BarGeometricNonlinearity

REACH = 2.0
"""Lengths of a bar: no linkage has its platform farther from where it was without load."""
FAR = "the platform would lie beyond the reach of the bars"
TITLES = {
    "lin": "LIN, constant stiffness",
    "vjm": "VJM, lumped springs (Eq. 1)",
    "saved": "VJM with",
    "fea": "FEA, frame elements as drawn",
}
FITTABLE = ("vjm", "saved")
"""Models whose derivative by what was written about the rig is known."""
SETTLED = 3.0
"""Whitened RMS below which a misfit moves the inputs by no more than their noise."""
Solve = Callable[[np.ndarray | None], Prediction]
"""A prediction at inputs shifted by (R, 7) from the measured ones."""


def compare_models(
    campaign: Campaign, saved: Model | None = None, on_progress: OnProgress = lambda _: None
) -> Comparison:
    """LIN, VJM, the saved model and FEA beside the measurements; nothing is fitted.

    A model that cannot be solved at all has its reason in `failed`; rows that cannot, in `lost`. FEA is given the
    tangent of virtual springs with refined bars, for the noise of its inputs. InputError for a sigma that is
    missing and cannot be estimated, and for an effect that the rig cannot have.
    """
    start = perf_counter()
    saved = None if saved is None else sized_model(saved, campaign)
    check_suitable([term.effect for term in saved.terms] if saved else [], campaign)
    whole = trusted(completed(campaign), saved or Model())
    cases = load_cases(whole)
    none = np.zeros_like(cases.input_sigma)
    tangent = cache(lambda: _tangent(cases))
    plans: dict[str, tuple[Model, Solve]] = {
        "lin": (Model(), lambda shift: moved_along(predict_linear(cases), none if shift is None else shift)),
        "vjm": (Model(), lambda shift: predict(Model(), cases, slopes=False, shift=shift)),
    }
    if saved is not None:
        plans["saved"] = (saved, _evaluated(saved, cases))
    plans["fea"] = (Model(), lambda shift: predict_frame(cases, tangent, shift))
    found: list[ModelError] = []
    for key, (model, solve) in plans.items():
        on_progress(TITLES[key])
        found.append(_error(key, model, cases, solve))
    shown = next(it for it in found if it.model == ("vjm" if saved is None else "saved"))
    doctor: tuple[DoctorFinding, ...] = ()
    attempts = Attempts()
    if shown.fit is not None and not shown.within_noise and not shown.untested:
        doctor = attempts.get(
            "the look for mistakes of the table",
            lambda: mistakes_of(campaign, saved or Model(), on_progress),
            (),
        )
    return Comparison(
        doctor=doctor,
        not_done=tuple(attempts.failed),
        campaign=whole.name,
        folder=str(whole.folder or ""),
        kind=whole.rig.kind,
        tests=len(whole.tests),
        rows=len(cases.test),
        readings=int(cases.predicted.sum()),
        shown=shown.model,
        groups={
            group.name: tuple(whole.tests[n].id for n in group.numbers)
            for group in groups(whole.tests, whole.gauges)
        },
        remarks=whole.remarks,
        models=tuple(found),
        seconds=round(perf_counter() - start, 3),
        data=dict(whole.digests),
        **made_with(),
    )


def _evaluated(model: Model, cases: LoadCases) -> Solve:
    """Of a model that may have kinks: each row on its better side, from there at other inputs."""
    first = cache(lambda: Objective(model, cases).at(model.values, slopes=False, within=np.inf).prediction)
    return lambda shift: (
        first() if shift is None else predict(model, cases, slopes=False, start=first(), shift=shift)
    )


def _settled(cases: LoadCases, solve: Solve) -> Prediction:
    """The prediction; where it leaves little, at the inputs that fit it best: the noise of the measured ones would look
    like a fault of their sensors."""
    first = _credible(cases, solve(None))
    left = residual(cases, first)
    flat = left.free(left.values)
    if not flat.size or float(np.sqrt(np.mean(flat**2))) > SETTLED:
        return first
    return _credible(cases, solve(left.shift))


def _error(key: str, model: Model, cases: LoadCases, solve: Solve) -> ModelError:
    start = perf_counter()
    title = f"{TITLES[key]} {', '.join(model.names) or 'no effect'}" if key == "saved" else TITLES[key]
    names = model.names if key == "saved" else ()
    try:
        # Absurd numbers may overflow on their way to being lost; the rows are looked at, not the warnings.
        with np.errstate(all="ignore"):
            prediction = _settled(cases, solve)
            discrepancy = Discrepancy(cases, prediction, numbers_of(model, cases, prediction))
            found = _judged(key, title, model, discrepancy)
    except (ValueError, ArithmeticError, RuntimeError) as error:
        return ModelError(model=key, title=title, effects=names, failed=plain(error))
    return found.model_copy(update={"seconds": round(perf_counter() - start, 3)})


def _tolerated(model: Model, cases: LoadCases) -> bool:
    """Whether a model is within the noise with what was written about the rig where it fits best."""
    return bool(nominals(cases.campaign)) and judge(unfitted(model, cases)).noise


def _judged(key: str, title: str, model: Model, discrepancy: Discrepancy) -> ModelError:
    cases, names = discrepancy.load_cases, model.names
    size, order = discrepancy.size(), discrepancy.order()
    flat = discrepancy.whitened[cases.fitted][cases.predicted[cases.fitted]]
    fit = float(np.sqrt(flat @ flat / discrepancy.degrees)) if discrepancy.degrees > 0 else None
    found, looks = findings(discrepancy)
    # As in a diagnosis: the inputs that fit best, and the same checks.
    as_it_is = Fit(Model(), discrepancy.prediction, residual(cases, discrepancy.prediction), 1)
    nothing = untested(as_it_is, discrepancy.parameters)
    checks = () if nothing else judge(as_it_is).checks
    failed = tuple(check.words for check in checks if not check.passed)
    tolerated = bool(failed) and key in FITTABLE and _tolerated(model, cases)
    return ModelError(
        model=key,
        title=title,
        effects=names,
        fit=fit,
        holdout=discrepancy.rms(~cases.fitted),
        degrees=max(discrepancy.degrees, 0),
        chi_square_p=None if size is None else size.p_value,
        lag_one_p=None if order is None else order.p_value,
        within_noise=not nothing and (tolerated or not failed),
        tolerated=tolerated,
        lost=discrepancy.lost(),
        tests=discrepancy.tests(),
        channels=discrepancy.channels(cases.fitted),
        holdout_channels=discrepancy.channels(~cases.fitted),
        findings=found,
        looks=looks,
        headline="" if nothing else headline(discrepancy),
        untested=nothing or "",
        in_units=in_units(as_it_is),
        too_short=too_short(discrepancy),
        not_noise=() if tolerated else failed,
    )


def _credible(cases: LoadCases, prediction: Prediction) -> Prediction:
    """Rows with numbers beyond all bounds are lost, and those where the platform lies beyond the bars' reach."""
    parts = (prediction.values, prediction.by_inputs)
    finite = np.all([np.isfinite(part.reshape(len(part), -1)).all(axis=1) for part in parts], axis=0)
    reach = REACH * np.array([test.rig.length for test in cases.campaign.tests])[cases.test]
    near = np.all(np.abs(np.nan_to_num(prediction.values[:, :3])) <= reach[:, None], axis=1)
    good = finite & near
    if good.all():
        return prediction
    said = {int(k): "the numbers overflow" if not finite[k] else FAR for k in np.flatnonzero(~good)}
    return replace(
        prediction,
        values=np.where(good[:, None], prediction.values, 0.0),
        by_inputs=np.where(good[:, None, None], prediction.by_inputs, 0.0),
        lost=prediction.lost | ~good,
        reasons=said | prediction.reasons,
    )


def _tangent(cases: LoadCases) -> Prediction:
    """Springs with refined bars; where they have no equilibrium, a constant stiffness."""
    refined = predict(Model().with_effects([BarGeometricNonlinearity()]), cases, slopes=False)
    if not refined.lost.any():
        return refined
    constant = predict_linear(cases)
    return replace(
        refined, by_inputs=np.where(refined.lost[:, None, None], constant.by_inputs, refined.by_inputs)
    )
