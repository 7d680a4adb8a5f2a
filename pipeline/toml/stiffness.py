"""A 6x6 stiffness as it is written in a file: whether it is one, and the matrix it is."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SYMMETRY = 1e-6
"""Allowed asymmetry of a 6x6 scaled to a unit diagonal: that of `vjm.checks`."""


def symmetric(rows: list[list[float]]) -> Array:
    """Read-only matrix (n, n), exactly symmetric."""
    k = np.array(rows, dtype=float)
    k = 0.5 * (k + k.T)
    k.flags.writeable = False
    return k


def not_a_stiffness(rows: list[list[float]]) -> str:
    """Why this is no symmetric positive definite 6x6, with the worst entry; empty if it is one."""
    if len(rows) != 6 or any(len(row) != 6 for row in rows):
        return f"has {len(rows)} rows of {sorted({len(r) for r in rows})} numbers, allowed are 6 rows of 6"
    k = np.array(rows)
    diagonal = np.diag(k)
    i = int(np.argmin(diagonal))
    if diagonal[i] < 1e-9:
        return f"K{i + 1}{i + 1} is {diagonal[i]:g}, allowed on the diagonal is 1e-9 or more"
    unit = k / np.sqrt(np.outer(diagonal, diagonal))
    gap = np.abs(unit - unit.T)
    i, j = (int(n) for n in np.unravel_index(np.argmax(gap), gap.shape))
    if gap[i, j] > SYMMETRY:
        return (
            f"K{i + 1}{j + 1} is {k[i, j]:g} but K{j + 1}{i + 1} is {k[j, i]:g}, "
            f"a difference of {gap[i, j]:.2g} of the root of K{i + 1}{i + 1} K{j + 1}{j + 1}; "
            "allowed is a symmetric matrix"
        )
    lowest, vectors = np.linalg.eigh(0.5 * (unit + unit.T))
    if lowest[0] <= 1e-12:
        worst = np.argsort(-np.abs(vectors[:, 0]))[:2] + 1
        return (
            f"scaled to a unit diagonal its lowest eigenvalue is {lowest[0]:.3g}, mostly in coordinates "
            f"{worst[0]} and {worst[1]}; allowed is a positive definite matrix"
        )
    return ""
