"""One bench of the study: hidden effects, one noise, the fit, and how far from the truth it came."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from time import process_time
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.coverage.cases import BASE, is_size, typical
from pipeline.assessment.virtual.bench import read_out, true_readings
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.compare.error import Discrepancy
from pipeline.inference.fit import Fit
from pipeline.inference.intervals import holds_null, intervals, profile_likelihood
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.inference.predicted import Prediction
from pipeline.record import Record
from pipeline.simulate import bench_rig
from vjm.effects import catalogue

Kind = Literal["there", "absent"]
_near: dict[tuple[str, ...], Prediction] = {}
"""Of each fit the first prediction in this process: its equilibria are where those of other noise begin."""


class Trial(Record):
    """What one bench gave.

    kind: whether the effects were hidden or added to a bench without them. residuals: that were fitted. rms: over
    the degrees of freedom. holdout: whitened RMS of each held-out test. deviations: error of each parameter in its
    own standard errors, those of the side on which the truth is, None where it has none. symmetric: in those of a
    parabola. inside: whether the 95 % interval of each size holds null. steps: of each test. lost: rows without a
    prediction. seconds: of processor time. commit: of the code.
    """

    kind: Kind
    effects: tuple[str, ...]
    seed: int
    steps: int
    residuals: int
    degrees: int
    chi_square: float
    holdout: tuple[float, ...]
    deviations: dict[str, float | None] = {}  # noqa: RUF012 (pydantic copies it)
    symmetric: dict[str, float | None] = {}  # noqa: RUF012
    inside: dict[str, bool] = {}  # noqa: RUF012
    lost: int
    seconds: float
    commit: str

    @property
    def rms(self) -> float:
        """Whitened RMS of the fitted tests over their degrees of freedom."""
        return float(np.sqrt(self.chi_square / self.degrees))


def trial(kind: Kind, effects: Sequence[str], seed: int, steps: int, commit: str) -> Trial:
    """Hide the effects at typical size, or nothing, on a bench of so many steps a test; add them and fit."""
    began = process_time()
    hidden = typical(effects) if kind == "there" else {}
    cases = load_cases(campaign(tuple(hidden.items()), seed, steps))
    named = [catalogue()[name] for name in dict.fromkeys([BASE, *effects])]
    case = (kind, str(steps), *effects)
    best = best_fit(Model().with_effects(named), cases, effects, _near.get(case))
    # The inputs that fit best are those of this noise alone.
    _near.setdefault(case, replace(best.prediction, shift=np.zeros_like(best.prediction.shift)))
    names = [each.name for each in best.model.free]
    known = dict(zip(names, intervals(profile_likelihood(best, cases)), strict=True)) if hidden else {}
    off = {name: (it.value - hidden[name], it) for name, it in known.items()}
    return Trial(
        kind=kind,
        effects=tuple(effects),
        seed=seed,
        steps=steps,
        residuals=int(best.whitened.size),
        degrees=best.degrees,
        chi_square=best.chi_square,
        holdout=_held_out(best, cases),
        deviations={name: _in_errors(by, it.error(-1 if by > 0.0 else 1)) for name, (by, it) in off.items()},
        symmetric={name: _in_errors(by, it.std) for name, (by, it) in off.items()},
        inside={} if hidden else _inside(best, cases),
        lost=int(best.prediction.lost.sum()),
        seconds=round(process_time() - began, 2),
        commit=commit,
    )


def campaign(hidden: tuple[tuple[str, float], ...], seed: int, steps: int) -> Campaign:
    """The whole bench plan with this noise."""
    plan = bench_plan(steps)
    return read_out("coverage", bench_rig(), plan, SENSORS, seed, _truth(hidden, steps), GAUGES)


def exact(hidden: tuple[tuple[str, float], ...], steps: int) -> Campaign:
    """The whole bench plan read without noise, to be judged with that of its sensors."""
    plan = bench_plan(steps)
    return read_out("exact", bench_rig(), plan, SENSORS, None, _truth(hidden, steps), GAUGES)


@cache
def _truth(hidden: tuple[tuple[str, float], ...], steps: int) -> list[Readings]:
    """Readings without noise; the same for all seeds."""
    return true_readings(bench_rig(), bench_plan(steps), dict(hidden), GAUGES)


def _held_out(best: Fit, cases: LoadCases) -> tuple[float, ...]:
    gap = Discrepancy(cases, best.prediction)
    found: list[float] = []
    for number, test in enumerate(cases.campaign.tests):
        rows: NDArray[np.bool_] = cases.test == number
        rms = gap.rms(rows)
        if test.role == "holdout" and rms is not None:
            found.append(rms)
    return tuple(found)


def _in_errors(off: float, error: float) -> float | None:
    return float(off / error) if np.isfinite(error) and error > 0.0 else None


def _inside(best: Fit, cases: LoadCases) -> dict[str, bool]:
    land = profile_likelihood(best, cases)
    return {
        each.name: holds_null(land, k)
        for k, each in enumerate(best.model.free)
        if is_size(each.effect, each.parameter.name)
    }
