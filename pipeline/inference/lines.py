"""A fit whose line, along which what was written about the rig is eliminated, is its own.

About the nominal values chi-square is too high by what the line misses: 18 to 38 where the bar is off by 2 %. So the
numbers that were written go where the fit wants them, the line is drawn anew there, and the fit goes on, until
chi-square stays (Gauss and Newton's steps of these numbers).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pipeline.inference.model import Model
from pipeline.inference.nominals import FARTHEST, departed, departures, linearised, nominals
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.predicted import Prediction
from pipeline.inference.program import Program
from pipeline.inference.solvers import End

Solve = Callable[[Objective, Prediction | None], End]
SAME = 0.1
"""Of chi-square, or of its mean square where that is more: a line that changes it by no more is the fit's own."""
ROUNDS = 4
"""Lines of a fit, at most: far above noise they need not settle."""


def along_its_own_line(model: Model, cases: Program, begin: Prediction | None, solve: Solve) -> End:
    """The end of a fit, with what was written where it fits best and the line there."""
    numbers = nominals(cases.campaign)
    if not numbers:
        return solve(Objective(model, cases), begin)
    if cases.by_nominal is None:
        cases = replace(cases, by_nominal=linearised(model, cases, begin, numbers))
    end = solve(Objective(model, cases), begin)
    count = end.evaluations
    for _ in range(ROUNDS):
        there = end.there
        at = np.clip(there.residual.estimate, -FARTHEST, FARTHEST)
        moved = departed(there.objective.model.at(there.values), numbers, at)
        # Two solutions: the line, and chi-square along it.
        line = linearised(moved, cases, there.prediction, numbers)
        aim = Objective(moved, replace(cases, by_nominal=line))
        new = aim.at(there.values, there.prediction)
        count += 1 + new.rounds
        if end.ended or _same(there, new):
            return replace(end, there=new, evaluations=count)
        end = solve(aim, new.prediction)
        count += end.evaluations
    return replace(end, evaluations=count)


def with_line(model: Model, cases: Program, found: Prediction) -> Prediction:
    """A prediction with its derivative by what was written; as it is where all is exact."""
    numbers = nominals(cases.campaign)
    if not numbers:
        return found
    return replace(
        found,
        nominal=departures(model, numbers),
        by_nominal=linearised(model, cases, found, numbers),
    )


def _same(old: Evaluation, new: Evaluation) -> bool:
    before, after = (float(each.residuals @ each.residuals) for each in (old, new))
    return abs(after - before) <= SAME * max(1.0, after / new.residuals.size)
