"""A fit in numbers for the answer: values with intervals, errors, what changed in every test."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from pipeline.answer.record import ModelError, NominalValue, SetAside, TestChange, TestNoise
from pipeline.answer.value import Value
from pipeline.compare.error import Discrepancy
from pipeline.inference.fit import Fit
from pipeline.inference.intervals import Interval
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, at_bound
from pipeline.inference.model_file import Uncertainty
from pipeline.inference.noise import chi_square, lag_one
from pipeline.inference.nuisances import nominals
from pipeline.inference.objective import Objective
from pipeline.parameter_names import parted, path_of
from pipeline.selection.adequacy.bad_readings import BadReading
from pipeline.selection.adequacy.judgement import Judgement
from pipeline.selection.criteria import Criteria

TAKEN = 1.2
"""Times what is left within the tolerances, from which it is said what is left as the rig is written."""


def values_of(model: Model, intervals: Sequence[Interval]) -> dict[str, Value]:
    """Every number of the model, in order; intervals: of those that were free."""
    found = {each.name: it for each, it in zip(model.free, intervals, strict=True)}
    out, bounded = {}, at_bound(model)
    for term in model.terms:
        for p in term.effect.parameters:
            name, value = path_of(term.effect.name, p.name), float(term.values[p.name])
            it = found.get(name)
            out[name] = Value(
                value=value,
                std=None if it is None or not np.isfinite(it.std) else it.std,
                low95=None if it is None else it.low,
                high95=None if it is None else it.high,
                interval="fixed" if it is None else it.kind,
                unit=p.unit,
                meaning=p.meaning,
                at_bound=name in bounded,
            )
    return out


def uncertainty_of(values: Mapping[str, Value], model: Model) -> dict[str, Uncertainty]:
    """Of every number that a fit of the model may move, for the model's file; empty of one that no reading sees."""
    free = {each.name for each in model.free}
    return {name: Uncertainty(it.std, it.low95, it.high95) for name, it in values.items() if name in free}


def nominals_of(found: Fit, criteria: Criteria) -> tuple[NominalValue, ...]:
    """What was written about the rig as it fits best, in the units of the table of tolerances."""
    numbers = nominals(found.residual.load_cases.campaign)
    if not found.residual.departure.size:
        return ()
    stds = np.sqrt(np.diag(found.nominal_covariance))
    return tuple(
        NominalValue(
            name=it.name,
            nominal=it.parameter.null,
            tolerance=it.deviation,
            value=it.parameter.null + float(u) * it.deviation,
            std=float(std) * it.deviation,
            pull=float(u),
            unit=it.parameter.unit,
            meaning=it.parameter.meaning,
            seen=bool(std < criteria.nominal_seen),
            moved=bool(abs(u) > criteria.nominal_moved),
        )
        for it, u, std in zip(numbers, found.residual.estimate, stds, strict=True)
    )


def error_of(found: Fit, cases: LoadCases, parameters: int, judged: Judgement | None = None) -> ModelError:
    """What a fit leaves, its numbers counted as fitted to these tests. judged: what its checks said."""
    gap = Discrepancy(cases, found.prediction, parameters)
    size, order = gap.size(), gap.order()
    return ModelError(
        effects=found.model.names,
        fit=float(np.sqrt(size.statistic / size.degrees)) if size is not None else found.rms,
        holdout=gap.rms(~cases.fitted),
        chi_square=None if size is None else size.statistic,
        degrees=max(gap.degrees, 0),
        chi_square_p=None if size is None else size.p_value,
        lag_one_p=None if order is None else order.p_value,
        lost=tuple(each.sentence for each in gap.lost()),
        not_noise=() if judged is None else tuple(check.words for check in judged.checks if not check.passed),
    )


def as_written(before: Fit, cases: LoadCases) -> float | None:
    """Whitened RMS that a model leaves of the fitted tests with the rig exactly as it is written; None where its
    tolerances take no part of it that is worth a word."""
    exact, cases = replace(before.model, nominals=()), replace(cases, by_nominal=None)
    there = Objective(exact, cases).at(exact.values, slopes=False, within=np.inf).prediction
    size = Discrepancy(cases, there).size()
    found = 0.0 if size is None else float(np.sqrt(size.statistic / size.degrees))
    return found if found > TAKEN * before.rms else None


def changes(before: Fit, after: Fit, cases: LoadCases) -> tuple[TestChange, ...]:
    """Every test before and after."""
    gaps = [Discrepancy(cases, each.prediction) for each in (before, after)]
    out = []
    for number, test in enumerate(cases.campaign.tests):
        rows = cases.test == number
        was, now = (_in_test(gap, rows) for gap in gaps)
        out.append(
            TestChange(
                test=test.id, q_deg=test.q_deg, role=test.role, rows=int(rows.sum()), before=was, after=now
            )
        )
    return tuple(out)


def _in_test(gap: Discrepancy, rows: np.ndarray) -> TestNoise:
    mask = gap.load_cases.predicted & rows[:, None]
    series = [gap.whitened[own, channel] for own, channel in gap.series(mask)]
    flat = np.concatenate(series) if series else np.zeros(0)
    return TestNoise(
        rms=gap.rms(rows),
        chi_square_p=chi_square(flat).p_value if flat.size else None,
        lag_one_p=lag_one(series).p_value if flat.size >= 3 and flat.any() else None,
        lost=int(gap.prediction.lost[rows].sum()),
    )


def undetermined(values: dict[str, Value], together: list[list[str]]) -> tuple[tuple[str, ...], ...]:
    """Sets that only show together, then the numbers that do not show at all."""
    grouped = {name for group in together for name in group}
    alone = [name for name, it in values.items() if it.interval == "undetermined" and name not in grouped]
    return (*(tuple(group) for group in together), *((name,) for name in alone))


def confusable(names: list[str], pairs: list[tuple[int, int, float]]) -> tuple[tuple[str, ...], ...]:
    """Pairs of different effects with parameters that go together."""
    effects = [parted(name)[0] for name in names]
    return tuple(dict.fromkeys((effects[i], effects[j]) for i, j, _ in pairs if effects[i] != effects[j]))


def set_aside_records(bad: Iterable[BadReading]) -> tuple[SetAside, ...]:
    """Readings that were left out, as an answer has them."""
    return tuple(
        SetAside(test=b.test, step=b.step, column=b.column, sigma=b.sigmas, instead=b.instead, line=b.line)
        for b in bad
    )
