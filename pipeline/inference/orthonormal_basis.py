"""An orthonormal basis of what columns span: what a fit can move, and what is left when that is taken out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RANK = 1e-8
"""Singular value, of the columns at size 1, below which a direction is rounding."""


def basis(columns: Array) -> Array:
    """(N, r) of the span of columns (N, K), whatever their units; (N, 0) where there are none."""
    if not columns.shape[1]:
        return columns
    sizes = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    left, values, _ = np.linalg.svd(columns / sizes, full_matrices=False)
    return np.asarray(left[:, values > RANK])
