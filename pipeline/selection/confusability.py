"""How alike two effects look: correlation of their signatures, and the size from which they can be told apart.

With rho the correlation of what effect A does with all that effect B can do (the multiple correlation where B has
several numbers), both free of what the fit can move, gamma = 1 / sqrt(1 - rho). The right one is named in 95 % of
cases when A's size mu, in sigmas of all readings together, is 2.33 gamma: the wrong one is as good where
mu² (1 - rho²) is no larger than its own scatter.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.rounding import RANK, ROUNDING, TINY
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.first_order import FirstOrder
from pipeline.selection.fit_cache import FitCache, Names

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Likeness:
    """Two effects in this campaign. size: mu of the first as it was fitted, in sigmas."""

    effect: str
    rival: str
    correlation: float
    size: float

    @property
    def gamma(self) -> float:
        """1 / sqrt(1 - rho)."""
        return float(1.0 / np.sqrt(max(1.0 - self.correlation, ROUNDING)))

    @property
    def needed(self) -> float:
        """Size from which the right one is named in 95 % of cases."""
        return CRITERIA.name_deviations * self.gamma


def likenesses(cache: FitCache, names: Names) -> list[Likeness]:
    """Of every effect of a set with every other candidate, most alike first."""
    out = []
    for name in names:
        start = names - {name}
        if start not in cache.first_orders or name not in cache.first_order(start).signatures:
            continue
        about = cache.first_order(start)
        mine = signature_of(cache, names, name, about)
        size = float(np.linalg.norm(mine))
        if size == 0.0:
            continue
        for other in about.signatures:
            if other not in names:
                rho = multiple_correlation(mine, about.columns(other))
                out.append(Likeness(name, other, rho, size / np.sqrt(about.share)))
    return sorted(out, key=lambda it: -it.correlation)


def signature_of(cache: FitCache, names: Names, name: str, about: FirstOrder) -> Array:
    """(k,) what an effect does at its fitted size, to first order; one with kinks as at its nearest probe."""
    found = cache.fit(names)
    effect = cache.candidates[name]
    values = next(term.values for term in found.model.terms if term.effect.name == name)
    if effect.smooth:
        by_typical = [(values[p.name] - p.null) / p.typical for p in effect.parameters]
        return np.asarray(about.columns(name) @ np.array(by_typical))
    first = effect.parameters[0]
    probes = about.signatures[name].probes
    value = values[first.name]
    nearest = int(np.argmin([abs(np.log(abs((p - first.null) / (value - first.null)))) for p in probes]))
    return np.asarray(
        about.columns(name, nearest)[:, 0] * (value - first.null) / (probes[nearest] - first.null)
    )


def multiple_correlation(signature: Array, columns: Array) -> float:
    """Of a signature (k,) with the best combination of columns (k, p); what is rounding beside others is none."""
    sizes = np.linalg.norm(columns, axis=0)
    seen = sizes > RANK * np.max(sizes, initial=TINY)
    columns = columns[:, seen] / sizes[seen]
    if not columns.size:
        return 0.0
    near = columns @ np.linalg.lstsq(columns, signature, rcond=RANK)[0]
    return float(np.clip(np.linalg.norm(near) / np.linalg.norm(signature), 0.0, 1.0))
