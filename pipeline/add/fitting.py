"""Adds effects to the model of a campaign, fits it to the measurements, and says what that changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from pipeline.add.sentences import sentences
from pipeline.answer import LEVEL, Answer, Correlation, ModelError, TestChange, TestNoise, Value
from pipeline.campaign import Campaign
from pipeline.compare.error import Discrepancy
from pipeline.errors import InputError
from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import correlations, intervals, landscape, only_together
from pipeline.inference.landscape import Landscape
from pipeline.inference.model import Model
from pipeline.inference.model_file import Uncertainty
from pipeline.inference.program import Program, program
from pipeline.inference.sigmas import completed
from pipeline.inference.starts import best_fit
from pipeline.inference.suitable import check_suitable
from pipeline.noise import chi_square, lag_one
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
    say("intervals")
    land = landscape(after, cases)
    values = _values(after.model, land)
    pairs = correlations(land)
    names = [each.name for each in after.model.free]
    errors = (_error(before, cases, len(model.free)), _error(after, cases, len(after.model.free)))
    answer = Answer(
        campaign=whole.name,
        verdict="within_noise" if _noise(errors[-1]) else "unknown",
        effects=after.model.names,
        added=tuple(new),
        parameters=values,
        error=errors,
        tests=_changes(before, after, cases),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=_undetermined(values, [[names[k] for k in group] for group in only_together(land)]),
        confusable=_confusable(names, pairs),
        evaluations=1 + after.evaluations + land.evaluations,
        seconds=round(perf_counter() - start, 3),
        commit=commit(),
        versions=versions(),
    )
    return Added(after.model, answer.model_copy(update={"sentences": sentences(answer, whole.remarks)}))


def _values(model: Model, land: Landscape) -> dict[str, Value]:
    """Every number of the model, in order."""
    found = {each.name: it for each, it in zip(model.free, intervals(land), strict=True)}
    out = {}
    for term in model.terms:
        for p in term.effect.parameters:
            name, value = f"{term.effect.name}.{p.name}", float(term.values[p.name])
            it = found.get(name)
            out[name] = Value(
                value=value,
                std=None if it is None or not np.isfinite(it.std) else it.std,
                low95=None if it is None else it.low,
                high95=None if it is None else it.high,
                interval="fixed" if it is None else it.kind,
                unit=p.unit,
                meaning=p.meaning,
            )
    return out


def _error(found: Fit, cases: Program, parameters: int) -> ModelError:
    """What a fit leaves, its numbers counted as fitted to these tests."""
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
    )


def _noise(error: ModelError) -> bool:
    checks = [p for p in (error.chi_square_p, error.lag_one_p) if p is not None]
    return bool(checks) and min(checks) >= LEVEL and not error.lost


def _changes(before: Fit, after: Fit, cases: Program) -> tuple[TestChange, ...]:
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
    mask = gap.program.predicted & rows[:, None]
    series = [gap.whitened[own, channel] for own, channel in gap.series(mask)]
    flat = np.concatenate(series) if series else np.zeros(0)
    return TestNoise(
        rms=gap.rms(rows),
        chi_square_p=chi_square(flat).p_value if flat.size else None,
        lag_one_p=lag_one(series).p_value if flat.size >= 3 and flat.any() else None,
        lost=int(gap.prediction.lost[rows].sum()),
    )


def _undetermined(values: dict[str, Value], together: list[list[str]]) -> tuple[tuple[str, ...], ...]:
    """Sets that only show together, then the numbers that do not show at all."""
    grouped = {name for group in together for name in group}
    alone = [name for name, it in values.items() if it.interval == "undetermined" and name not in grouped]
    return (*(tuple(group) for group in together), *((name,) for name in alone))


def _confusable(names: list[str], pairs: list[tuple[int, int, float]]) -> tuple[tuple[str, ...], ...]:
    """Pairs of different effects with parameters that go together."""
    effects = [name.partition(".")[0] for name in names]
    return tuple(dict.fromkeys((effects[i], effects[j]) for i, j, _ in pairs if effects[i] != effects[j]))
