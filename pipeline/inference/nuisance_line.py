"""A fit beside what was written about the rig, which is eliminated along a line.

About the nominal values chi-square is too high by what the line misses: 18 to 38 where the bar is off by 2 %. So the
numbers that were written go where the fit wants them, and the fit goes on from there, until chi-square stays (steps of
Gauss and Newton in these numbers). The line itself may be that of a like model: where these numbers fit best the sum of
squares does not depend on it to first order, and a chord leads there nearly as soon as a tangent; where it does not,
the line is drawn anew. Error bars do depend on it, so that a model of which they are asked has its own line.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import beside, departed, departures, lined, nominals
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.predicted import Prediction
from pipeline.inference.settings import WRITTEN
from pipeline.inference.solvers import ALL, Effort, End, idle

Solve = Callable[[Evaluation], End]


def along_a_line(
    model: Model, cases: LoadCases, begin: Prediction | None, solve: Solve, effort: Effort = ALL
) -> End:
    """The end of a fit with what was written where it fits best, along the line of the prediction where it begins; near
    there where another model leaves far less."""
    model, cases = beside(model, cases, begin)
    first = Objective(model, cases).at(model.bounded, begin, within=np.inf)
    end = solve(first)
    count = first.rounds + end.evaluations
    if cases.by_nominal is None:
        return replace(end, evaluations=count)
    numbers = nominals(cases.campaign)
    for number in range(WRITTEN.rounds):
        there = end.there
        at = np.clip(there.residual.estimate, -WRITTEN.farthest, WRITTEN.farthest)
        moved, near = departed(there.objective.model.at(there.values), numbers, at), there.prediction
        if number > WRITTEN.chords:
            near = lined(moved, cases, near)
            cases, count = replace(cases, by_nominal=near.by_nominal), count + 2
        new = Objective(moved, cases).at(there.values, near)
        count += new.rounds
        if end.ended or _same(there, new) or effort.beats(_total(new), new.residuals.size):
            return replace(end, there=new, evaluations=count)
        end = solve(new)
        count += end.evaluations
    return replace(end, evaluations=count)


def with_line(model: Model, found: Prediction, line: Prediction | None, cases: LoadCases) -> Prediction:
    """A prediction with the line of another one; as it is where that has none."""
    if line is None or not line.nominal.size:
        return found
    nominal = departures(model, nominals(cases.campaign))
    return replace(found, nominal=nominal, by_nominal=line.by_nominal)


def _same(old: Evaluation, new: Evaluation) -> bool:
    before, after = _total(old), _total(new)
    count = new.residuals.size
    return abs(after - before) <= max(WRITTEN.same * max(1.0, after / count), idle(after, count))


def _total(there: Evaluation) -> float:
    return float(there.residuals @ there.residuals)
