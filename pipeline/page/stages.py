"""The error on the way from plain virtual springs to a model, one effect more at each stage."""

from __future__ import annotations

from dataclasses import dataclass, replace

from pipeline.answer.record import ModelError, Verdict
from pipeline.answer.summary import error_of
from pipeline.callbacks import OnProgress
from pipeline.compare.error import Discrepancy
from pipeline.inference.fit import fit, numbers_of, unfitted
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.adequacy.untested import untested


@dataclass(frozen=True, eq=False)
class Stages:
    """error: of every stage, the plain model first. before, after: the first and the last against the data. verdict: on
    the last; untested: why nothing can be tested, "" if something can."""

    error: tuple[ModelError, ...]
    before: Discrepancy
    after: Discrepancy
    verdict: Verdict
    untested: str


def stages(model: Model, cases: LoadCases, on_progress: OnProgress = lambda _: None) -> Stages:
    """Every stage fitted from the model's own values; the model itself is taken as it is."""
    on_progress("plain virtual springs")
    plain = unfitted(Model(), cases)
    found = [(plain, 0)]
    for count in range(1, len(model.terms)):
        part = replace(model, terms=model.terms[:count])
        on_progress(" + ".join(part.names))
        fitted = fit(part, cases, plain.prediction)
        found.append((fitted, fitted.numbers))
    if model.terms:
        on_progress(" + ".join(model.names))
        as_saved = unfitted(model, cases)
        found.append((as_saved, numbers_of(model, cases, as_saved.prediction)))
    nothing = untested(found[-1][0])
    judged = None if nothing else judge(found[-1][0])
    errors = tuple(
        error_of(each, cases, free, judged if each is found[-1][0] else None) for each, free in found
    )
    first, last = (Discrepancy(cases, each.prediction, free) for each, free in (found[0], found[-1]))
    verdict: Verdict = "nothing_tested" if judged is None else "within_noise" if judged.noise else "unknown"
    return Stages(errors, first, last, verdict, nothing or "")
