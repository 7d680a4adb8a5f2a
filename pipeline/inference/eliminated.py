"""Nuisance parameters eliminated from residuals, linearly: known numbers with a standard deviation.

Residuals e (N,) in sigmas at nominal values, that fall by G u when the numbers go u standard deviations, leave

    min over u of abs(e - G u)² + abs(u)²  =  e^T (1 + G G^T)^-1 e  =  abs(W e)²,    W = (1 + G G^T)^(-1/2),

at u = (1 + G^T G)^-1 G^T e. W e is again of unit covariance where noise and u are as they are said to be, so that all
that is asked of residuals and of columns beside them may be asked of W e and of W times the columns. With the thin
singular value decomposition G = U D V^T, W = 1 - U (1 - (1 + D²)^(-1/2)) U^T: the symmetric root, which moves
residuals least (A. Kessy, A. Lewin, K. Strimmer, The American Statistician 72 (2018) 309).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Marginal:
    """Of columns G (N, K). left: (N, r), sizes: (r,), right: (r, K) of their decomposition."""

    left: Array
    sizes: Array
    right: Array

    @classmethod
    def of(cls, columns: Array) -> Marginal:
        """Of columns (N, K) of a standard deviation each."""
        return cls(*np.linalg.svd(columns, full_matrices=False))

    def weakened(self, values: Array) -> Array:
        """W times values (N, ...)."""
        shares = 1.0 - 1.0 / np.sqrt(1.0 + self.sizes**2)
        inner = self.left.T @ values
        return np.asarray(values - self.left @ (shares.reshape(-1, *[1] * (values.ndim - 1)) * inner))

    @property
    def pull(self) -> Array:
        """(K, N) by which the estimate follows residuals at nominal values."""
        return np.asarray((self.right.T * (self.sizes / (1.0 + self.sizes**2))) @ self.left.T)

    @property
    def covariance(self) -> Array:
        """(K, K) of the estimate, all else known: 1 / (1 + D²) along what the columns show, 1 along what they do not.

        No difference of ones, which sharp sensors round to less than nothing."""
        rank, size = self.right.shape
        shown = (self.right.T / (1.0 + self.sizes**2)) @ self.right
        if rank == size:
            return np.asarray(shown)
        unseen = np.linalg.svd(self.right, full_matrices=True)[2][rank:]
        return np.asarray(shown + unseen.T @ unseen)
