"""An orthonormal basis of what columns span: what a fit can move, and what is left when that is taken out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.rounding import RANK, TINY

Array = NDArray[np.float64]


def basis(columns: Array) -> Array:
    """(N, r) of the span of columns (N, K), whatever their units; (N, 0) where there are none."""
    if not columns.shape[1]:
        return columns
    sizes = np.maximum(np.linalg.norm(columns, axis=0), TINY)
    left, values, _ = np.linalg.svd(columns / sizes, full_matrices=False)
    return np.asarray(left[:, values > RANK])
