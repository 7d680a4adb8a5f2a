"""Which numbers of a set the data determine: one that they do not is no part of an explanation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pipeline.diagnose.evidence import PLAUSIBLE
from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import landscape
from pipeline.inference.model import Model
from pipeline.inference.program import Program

RISE = 2.0
"""Chi-square by which a fit may rise where numbers that nothing determines are put at null: beyond, they were."""


def undetermined(found: Fit, whole: Program) -> tuple[str, ...]:
    """Names effect.parameter of the free numbers about which the data say nothing by themselves."""
    land = landscape(found, whole)
    return tuple(
        each.name
        for k, each in enumerate(found.model.free)
        if not np.sqrt(land.ridge(k)[1]) < land.ranges[k].high - land.ranges[k].low
    )


def determined(found: Fit, whole: Program) -> Fit:
    """The fit with numbers that nothing determines put at their null and left there, those that show least first.

    What only combinations determine is told by as many numbers as there are combinations. The same fit where all are
    determined, or where it would leave more.
    """
    here, effects = found, len(found.model.free)
    for _ in range(effects):
        blind = undetermined(here, whole)
        if not blind:
            return here
        free = {each.name: k for k, each in enumerate(here.model.free)}
        sizes = {n: float(np.linalg.norm(here.jacobian[:, free[n]])) * _typical(here, free[n]) for n in blind}
        least = min(blind, key=lambda name: sizes[name])
        model = _nulled(here.model, least)
        here = fit(model, whole, here.prediction, None, PLAUSIBLE)
        if here.chi_square > found.chi_square + RISE:
            return found
    return here


def _typical(found: Fit, k: int) -> float:
    return abs(found.model.free[k].parameter.typical)


def _nulled(model: Model, name: str) -> Model:
    values = model.values
    for k, each in enumerate(model.free):
        if each.name == name:
            values[k] = each.parameter.null
    return replace(model.at(values), fixed=model.fixed | {name})
