"""How much the residuals speak for one function at a site, shared by all tests and all alike parts.

    e = G nu + sum over elements j of S_j f(c_j) + noise,    nu ~ N(0, 1)

with e the whitened residuals of the tests that may be fitted, S_j the whitened influence of element j, c_j its own
coordinate, G a column for each number that was written about the rig (in both hypotheses), and f the curve and sliders
of `pipeline.discover.bases`. The evidence is E = ln p(e | site) - ln p(e | nothing), the greatest over the scales of
the prior; with z the weights in their standard deviations and F = sum of S_j hat(c_j),

    E = b^T (1 + s² M)^-1 b s² / 2 - ln det(1 + s² M) / 2,    M = L^T F^T W² F L,    b = L^T F^T W² e,

W that eliminates G (`pipeline.inference.eliminated`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.bases import Prior, priors
from pipeline.inference.eliminated import Marginal
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.residual import Residual

Array = NDArray[np.float64]
SIZES = np.logspace(-1.0, 5.0, 19)
"""Scales s of f, in those at which it moves the residuals by one sigma in all: a third of a decade each."""


@dataclass(frozen=True, eq=False)
class Columns:
    """A site as columns. values: (N, 30) of curve and sliders, before what was written is eliminated. largest: of the
    coordinates, on which the knots stand."""

    values: Array
    largest: float


@dataclass(frozen=True, eq=False)
class Evidence:
    """Of one site. value: E. prior, size: at which it is greatest. weights: (30,) of curve and sliders there."""

    value: float
    prior: Prior
    size: float
    weights: Array
    site: Columns

    @cached_property
    def explained(self) -> Array:
        """(N,) what the function does to the residuals."""
        return np.asarray(self.site.values @ self.weights)


@dataclass(frozen=True, eq=False)
class Rest:
    """What a model leaves, in which sites are looked for. residuals: (N,), what was written as it was written, unknown
    zeros projected out. rows, tests: (N,) of each. first: (tests + 1,). tolerance: (N, K) of what was written. zeros:
    (N, r) orthonormal basis of what unknown zeros can make. correlated: what takes columns (N, ...) of whitened
    residuals to units of noise that is correlated from row to row, None where it is not."""

    residuals: Array
    rows: np.ndarray
    tests: np.ndarray
    first: np.ndarray
    tolerance: Array
    zeros: Array
    correlated: Callable[[Array], Array] | None = None

    @classmethod
    def of(cls, left: Residual) -> Rest:
        """Of a residual whose tests may all be fitted."""
        rows = left.rows[:, 0]
        return cls(
            left.without_zeros(left.as_written),
            rows,
            left.load_cases.test[rows],
            left.load_cases.first,
            left.without_zeros(left.nominal),
            left.zeros,
        )

    def with_noise(self, correlated: Callable[[Array], Array]) -> Rest:
        """The same in units of noise that is correlated so."""
        zeros = basis(correlated(self.zeros)) if self.zeros.shape[1] else self.zeros
        it = replace(self, zeros=zeros, correlated=correlated)
        return replace(it, residuals=it.seen(self.residuals), tolerance=it.seen(self.tolerance))

    def seen(self, columns: Array) -> Array:
        """Columns (N, ...) of whitened readings, unknown zeros projected out, in units of the noise."""
        own = columns if self.correlated is None else self.correlated(columns)
        return np.asarray(own - self.zeros @ (self.zeros.T @ own))

    @cached_property
    def _marginal(self) -> Marginal:
        return Marginal.of(self.tolerance)

    def product(self, one: Array, other: Array) -> Array:
        """one^T (1 + G G^T)^-1 other of columns (N, ...)."""
        return np.asarray(self.weakened(one).T @ self.weakened(other))

    def weakened(self, columns: Array) -> Array:
        """(1 + G G^T)^(-1/2) times columns (N, ...)."""
        return self._marginal.weakened(columns)

    def evidence(self, site: Columns) -> Evidence:
        """Of a site."""
        gram, pull = self.product(site.values, site.values), self.product(site.values, self.residuals)
        return max((_best(prior, gram, pull, site) for prior in priors()), key=lambda each: each.value)

    def seen_in(self, explained: Array) -> float:
        """In how many tests a change (N,) of the residuals stands: as many equal ones have the same sum of squared
        shares."""
        sums = np.bincount(self.tests, explained**2, minlength=len(self.first) - 1)
        return float(np.sum(sums) ** 2 / max(float(np.sum(sums**2)), 1e-300))

    def parts(self, blocks: int) -> np.ndarray:
        """(N,) number of the part of each residual: its test, or which of so many blocks of its test's history."""
        if blocks == 1:
            return self.tests
        counts = np.diff(self.first)[self.tests]
        step = self.rows - self.first[self.tests]
        return np.asarray(self.tests * blocks + (step * blocks) // np.maximum(counts, 1))

    def gains(self, columns: Array, root: Array, parts: np.ndarray) -> Array:
        """(parts,) chi-square that columns (N, P) gain in each part when they are fitted to the others, and what was
        written with them, beside what was written fitted to the same others alone.

        It is chi-square by the covariance with which the others foresee the part by all columns, for both: readings of
        which they say little by these, as where a part goes further than they do, count for little in either way.
        root: (P, P) of the covariance of their weights. parts: (N,) of `parts`. Source: predictive distribution of a
        linear model, C. M. Bishop, Pattern Recognition and Machine Learning, Springer 2006, eq. 3.58.
        """
        both, own = np.hstack([columns @ root, self.tolerance]), columns.shape[1]
        inner = np.eye(both.shape[1]) + both.T @ both

        def gain(mine: np.ndarray) -> float:
            unlike = np.stack([self._unforeseen(it, mine) for it in (both[:, own:], both)], axis=1)
            pull = both[mine].T @ unlike
            alone, with_them = np.sum(unlike**2, axis=0) - np.sum(pull * np.linalg.solve(inner, pull), axis=0)
            return float(alone - with_them)

        return np.array([gain(parts == part) for part in np.unique(parts)])

    def _unforeseen(self, columns: Array, mine: np.ndarray) -> Array:
        """Of the residuals `mine` (N,), what the others do not foresee by columns of unit variance."""
        there, e = columns[~mine], self.residuals[~mine]
        weights = np.linalg.solve(there.T @ there + np.eye(columns.shape[1]), there.T @ e)
        return np.asarray(self.residuals[mine] - columns[mine] @ weights)


def _best(prior: Prior, gram: Array, pull: Array, site: Columns) -> Evidence:
    """At its best scale."""
    value, weights, size = best_scale(prior.root, gram, pull)
    return Evidence(value, prior, size, weights, site)


def best_scale(root: Array, gram: Array, pull: Array) -> tuple[float, Array, float]:
    """The evidence of columns at its best scale of their prior, the weights there, and the scale.

    root: (P, P) of the covariance of the weights at the scale 1. gram: (P, P) of the columns. pull: (P,) of the
    residuals on them.
    """
    inner = root.T @ gram @ root
    values, vectors = np.linalg.eigh(0.5 * (inner + inner.T))
    values = np.maximum(values, 0.0)
    along = vectors.T @ (root.T @ pull)
    unit = float(np.sqrt(np.sum(values)))
    if not unit > 0.0:
        return 0.0, np.zeros(pull.size), 0.0
    sizes = SIZES / unit
    ratio = sizes[:, None] ** 2 / (1.0 + sizes[:, None] ** 2 * values)
    every = 0.5 * (ratio @ along**2) - 0.5 * np.sum(np.log1p(sizes[:, None] ** 2 * values), axis=1)
    k = int(np.argmax(every))
    return float(every[k]), root @ (vectors @ (ratio[k] * along)), float(sizes[k])
