"""What a fit leaves open: parameters and what was written about the rig together, as a normal law about the fit.

With whitened slopes S (N, P) by the parameters and G (N, K) by the numbers that were written, in their standard
deviations u ~ N(0, 1), unknown zeros projected out of both, the precision of (theta, u) is

    H = [S G]^T [S G] + diag(1 / (t plausible)², 1),

t the typical size of a parameter: a weak prior, which leaves a direction that the readings do not see as wide as what
may be. Predictions f with slopes J = [J_theta J_u] then have the covariance J H^-1 J^T, which parts without a rest into
what would remain if all that was written were exact, and what that leaves open (the law of total variance):

    J_theta H_theta^-1 J_theta^T   and   J H^-1 J^T - J_theta H_theta^-1 J_theta^T.

A. Gelman et al., Bayesian Data Analysis, 3rd ed., CRC Press 2014, sections 1.8 and 4.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.inference.nuisances import Nominal, departed, nominals
from pipeline.inference.prior import away, slope
from pipeline.inference.settings import WRITTEN
from pipeline.selection.criteria import CRITERIA

Array = NDArray[np.float64]
PART = 0.1
"""Component of a direction of length 1, from which its parameter is named."""
TRIES = 50
"""Draws of a sample, at most, until its parameters lie within their bounds; then they are brought there."""


@dataclass(frozen=True, eq=False)
class Posterior:
    """Normal law of P parameters, in their typical sizes, and K numbers that were written, in their standard
    deviations. model: at the best fit of both. slopes: (N, P + K) of the whitened readings, without priors. factor: by
    which standard errors of parameters are widened, where more is left than noise."""

    model: Model
    numbers: tuple[Nominal, ...]
    departure: Array
    slopes: Array
    factor: float = 1.0

    @classmethod
    def of(cls, found: Fit, factor: float = 1.0) -> Posterior:
        """About a best fit."""
        it = found.residual
        numbers = nominals(it.load_cases.campaign) if it.departure.size else ()
        at = it.estimate if numbers else np.zeros(0)
        model = departed(found.model, numbers, at) if numbers else found.model
        columns = [it.without_zeros(it.slopes) * _sizes(found.model)]
        if numbers:
            columns.append(it.without_zeros(it.nominal))
        whole = np.concatenate(columns, axis=1)
        return cls(model, numbers, np.clip(at, -WRITTEN.farthest, WRITTEN.farthest), whole, factor)

    @property
    def count(self) -> int:
        """P"""
        return len(self.model.free)

    @cached_property
    def sizes(self) -> Array:
        """(P,) typical sizes, the unit in which parameters are counted."""
        return _sizes(self.model)

    @cached_property
    def _weighed(self) -> Array:
        """(N + P + K, P + K) slopes of the readings and of the priors: H is their product with themselves. Squares of
        what the readings hardly show are lost beside the others, so H is never solved with."""
        far = away(self.model.free, self.model.values, CRITERIA.plausible)
        weak = slope(far) / CRITERIA.plausible
        prior = np.diag(np.concatenate([weak, np.ones(len(self.numbers))]))
        return np.vstack([self.slopes / self.factor, prior])

    @cached_property
    def root(self) -> Array:
        """L (P + K, P + K), lower triangular, of H^-1 = L L^T."""
        return _root(self._weighed)

    @cached_property
    def covariance(self) -> Array:
        """H^-1 (P + K, P + K)"""
        return np.asarray(self.root @ self.root.T)

    @cached_property
    def std(self) -> Array:
        """(P,) standard errors of the parameters, in their units."""
        return np.asarray(np.sqrt(np.diag(self.covariance)[: self.count]) * self.sizes)

    def variances(self, by_free: Array, by_nominal: Array) -> tuple[Array, Array]:
        """(...,) of predictions with slopes (..., P) by the parameters in their units and (..., K) by what was written:
        with that exact, and what it adds."""
        own = by_free * self.sizes
        given = np.sum((own @ _root(self._weighed[:, : self.count])) ** 2, axis=-1)
        whole = np.sum((np.concatenate([own, by_nominal], axis=-1) @ self.root) ** 2, axis=-1)
        return given, np.maximum(whole - given, 0.0)

    @cached_property
    def loose(self) -> tuple[tuple[str, ...], ...]:
        """Sets of parameters of which the readings see only combinations, and parameters that they do not see: the
        directions in which the law is hardly narrower than the weak prior."""
        values, ways = np.linalg.eigh(self.covariance[: self.count, : self.count])
        names = [each.name for each in self.model.free]
        found: list[set[str]] = []
        for value, way in zip(values, ways.T, strict=True):
            if value < (0.5 * CRITERIA.plausible) ** 2:
                continue
            own = {names[k] for k in np.flatnonzero(np.abs(way) > PART)}
            for group in [g for g in found if g & own]:
                found.remove(group)
                own |= group
            found.append(own)
        return tuple(tuple(name for name in names if name in group) for group in found)

    def draws(self, count: int, generator: np.random.Generator) -> tuple[Array, Array]:
        """(S, P) parameters in their units and (S, K) departures of what was written; parameters within bounds."""
        root = self.root
        low, high = np.array([each.bounds for each in self.model.free]).reshape(-1, 2).T
        centre = self.model.values
        off = generator.standard_normal((count, len(root))) @ root.T
        for _ in range(TRIES):
            values = centre + off[:, : self.count] * self.sizes
            out = np.any((values < low) | (values > high), axis=1)
            if not out.any():
                break
            off[out] = generator.standard_normal((int(out.sum()), len(root))) @ root.T
        departure = np.clip(self.departure + off[:, self.count :], -WRITTEN.farthest, WRITTEN.farthest)
        return np.clip(values, low, high), departure

    def model_at(self, values: Array, departure: Array) -> Model:
        """The model at parameters (P,) and departures (K,) of what was written."""
        model = self.model.at(values)
        return departed(model, self.numbers, departure) if self.numbers else model


def _sizes(model: Model) -> Array:
    return np.array([abs(each.parameter.typical) for each in model.free])


def _root(slopes: Array) -> Array:
    """L (P, P), lower triangular with a positive diagonal, of (S^T S)^-1 = L L^T with slopes S (N, P)."""
    _, sizes, axes = np.linalg.svd(slopes, full_matrices=False)
    upper = np.asarray(np.linalg.qr(axes / sizes[:, None], mode="r"))
    return np.asarray((upper * np.where(np.diag(upper) < 0.0, -1.0, 1.0)[:, None]).T)
