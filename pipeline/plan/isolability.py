"""Smallest sizes that are detected and told apart, and how alike the signatures are.

An effect of size mu sigmas, all readings together and free of what the model can move, is let in with 90 % power where
a non-central chi-square of that size exceeds the threshold of the diagnosis in 9 of 10 cases. Beside a rival of
(multiple) correlation rho it leaves mu sqrt(1 - rho²) unexplained; the rival is excluded in 95 % of cases where that is
1.645 + sqrt(1.645² + A), A the chi-square by which a rival has to be worse. gamma = 1 / sqrt(1 - rho).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.stats import ncx2, norm

from pipeline.plan.seen import Seen
from pipeline.selection.confusability import multiple_correlation
from pipeline.selection.cost import looks, numbers
from pipeline.selection.criteria import CRITERIA
from vjm.effects.base import Effect, Parameter

Array = NDArray[np.float64]
BLIND, FAR = 1e-6, 1e3
"""Sigmas below which nothing shows; and how many times a size that was looked at another may be."""


@dataclass(frozen=True)
class Visible:
    """One number of an effect, in its unit, from null. typical: a usual size.

    detected, apart: smallest sizes that are let in, and told from every rival; None where no size is, or none below
    a thousand typical ones. rival: the hardest; rho: correlation with it.
    """

    effect: str
    parameter: Parameter
    typical: float
    detected: float | None
    apart: float | None
    rival: str
    rho: float

    @property
    def gamma(self) -> float:
        return float(1.0 / np.sqrt(max(1.0 - self.rho, 1e-12)))


@cache
def needed(degrees: int, looks: int) -> float:
    """Sigmas that an effect of so many numbers needs to be let in with the power asked for, of so many looks."""
    limit = CRITERIA.entry(degrees, looks)
    square = brentq(lambda size: ncx2.sf(limit, degrees, size) - CRITERIA.detection_power, 1e-6, 1e4)
    return float(np.sqrt(square))


def apart() -> float:
    """Sigmas that a rival must leave unexplained to be excluded with the power asked for."""
    z = norm.ppf(CRITERIA.rival_power)
    return float(z + np.sqrt(z * z + CRITERIA.exclusion))


def visible(them: Seen, candidates: Mapping[str, Effect]) -> list[Visible]:
    """Of every number of every candidate that is a size; None for what these tests do not show."""
    free = them.free()
    out = []
    for name, effect in candidates.items():
        if name not in free or not effect.parameters:
            continue
        least = needed(numbers(effect), looks(effect, len(candidates)))
        for k, parameter in enumerate(effect.parameters[: 1 if effect.probes else None]):
            shown = _curve(free[name], them.probes.get(name, ()), k, parameter)
            mine = free[name][len(free[name]) // 2][:, min(k, free[name][0].shape[1] - 1)]
            rival, rho = _hardest(name, mine, free)
            left = np.sqrt(max(1.0 - rho * rho, 1e-12))
            out.append(
                Visible(
                    name,
                    parameter,
                    abs(parameter.typical),
                    _size(shown, least),
                    _size(shown, max(least, apart() / left)),
                    rival,
                    rho,
                )
            )
    return out


def matrix(them: Seen) -> tuple[list[str], Array]:
    """Names and (n, n) correlation of each effect's typical size (row) with the best of another (column)."""
    free = them.free()
    names = [name for name, columns in free.items() if any(np.any(c) for c in columns)]
    out = np.eye(len(names))
    for i, one in enumerate(names):
        mine = free[one][len(free[one]) // 2]
        for j, other in enumerate(names):
            if i != j:
                out[i, j] = max(
                    (
                        multiple_correlation(mine[:, k], c)
                        for k in range(mine.shape[1])
                        if np.any(mine[:, k])
                        for c in free[other]
                    ),
                    default=0.0,
                )
    return names, out


def _curve(
    columns: tuple[Array, ...], probes: tuple[float, ...], k: int, parameter: Parameter
) -> list[tuple[float, float]]:
    """Sizes from null and the sigmas that they show by, rising from nothing: typical, or each probe."""
    if not probes:
        return [(0.0, 0.0), (abs(parameter.typical), float(np.linalg.norm(columns[0][:, k])))]
    points = sorted(
        (abs(p - parameter.null), float(np.linalg.norm(c))) for p, c in zip(probes, columns, strict=True)
    )
    return [(0.0, 0.0), *points]


def _size(curve: list[tuple[float, float]], sigmas: float) -> float | None:
    """The least size that shows by so much: along straight lines, the last one going on; None far beyond it."""
    for (low, under), (high, over) in pairwise(curve):
        if over >= sigmas:
            return low + (high - low) * max(sigmas - under, 0.0) / (over - under)
    (last, shown) = curve[-1]
    if shown < BLIND or last * sigmas / shown > FAR * last:
        return None
    return last * sigmas / shown


def _hardest(name: str, mine: Array, free: Mapping[str, tuple[Array, ...]]) -> tuple[str, float]:
    if not np.any(mine):
        return "", 0.0
    rho = {
        other: max(multiple_correlation(mine, c) for c in columns)
        for other, columns in free.items()
        if other != name and any(np.any(c) for c in columns)
    }
    worst = max(rho, key=lambda other: rho[other], default="")
    return worst, rho.get(worst, 0.0)
