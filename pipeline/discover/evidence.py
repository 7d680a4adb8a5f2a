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
        """(parts,) 2 ln p(part | others, with the columns) - 2 ln p(part | others, without): of each part as the others
        foresee it, with how well they do. In units of chi-square.

        A part is foreseen with the covariance that the others leave the weights: where it goes further than they do, a
        function says little of it, and is not counted as wrong. columns: (N, P). root: (P, P) of the covariance of
        their weights. parts: (N,) of `parts`. Source: predictive densities, A. P. Dawid, J. R. Stat. Soc. A 147 (1984)
        278.
        """
        every = np.column_stack([columns @ root, self.tolerance, self.residuals])
        grams = np.array([every[parts == part].T @ every[parts == part] for part in np.unique(parts)])
        own, whole = columns.shape[1], grams.sum(axis=0)
        others = (np.delete(grams, k, axis=0).sum(axis=0) for k in range(len(grams)))
        return np.array([_gain(whole, own) - _gain(each, own) for each in others])


def _gain(gram: Array, own: int) -> float:
    """2 ln of the ratio of densities with so many columns of their own and with the others alone."""
    return _surprise(gram[own:, own:]) - _surprise(gram)


def _surprise(gram: Array) -> float:
    """-2 ln p of residuals, but for a constant, by columns of unit variance beside noise. gram: (P + 1, P + 1) of the
    columns and, last, the residuals."""
    sizes, along = np.linalg.eigh(np.eye(len(gram) - 1) + gram[:-1, :-1])
    return float(gram[-1, -1] - np.sum((along.T @ gram[:-1, -1]) ** 2 / sizes) + np.sum(np.log(sizes)))


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
