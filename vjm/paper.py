"""Numbers printed in the paper, as printed, and the two dimensions of its example.

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science (EUCOMES 2010), Springer.
"""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

LENGTH = 310.0
"""Bar length, mm (section 5)."""

WIDTH = 80.0
"""Parallelogram width, mm. Never stated; the only value that turns Eq. 11 into the printed Eq. 13."""


def _symmetric(entries: dict[tuple[int, int], float]) -> np.ndarray:
    matrix = np.zeros((6, 6))
    for (i, j), value in entries.items():
        matrix[i - 1, j - 1] = matrix[j - 1, i - 1] = value
    matrix.flags.writeable = False
    return matrix


BAR_STIFFNESS = _symmetric(
    {
        (1, 1): 2.20e4,
        (2, 2): 1.81e1,
        (2, 6): -2.84e3,
        (3, 3): 7.86e1,
        (3, 5): 1.25e4,
        (4, 4): 3.48e4,
        (5, 5): 2.66e6,
        (6, 6): 5.85e5,
    }
)
"""K_b of Eq. 12 (6, 6), N, mm, rad, bar frame, at the tip."""

HALF_PARALLELOGRAM_STIFFNESS = _symmetric(
    {
        (1, 1): 2.20e4,
        (2, 2): 1.81e1,
        (2, 6): -2.84e3,
        (4, 4): 5.64e4,
        (4, 6): 1.25e4,
        (5, 5): 2.64e7,
        (6, 6): 5.92e5,
    }
)
"""K_p / 2 of Eq. 13 (6, 6), N, mm, rad; the factor 2 stands before the printed matrix."""

TABLE_1 = MappingProxyType(
    {
        ("2x-bar", "vjm"): (3.35e3, 0.13e6),
        ("solid axis", "vjm"): (3.23e3, 4.33e6),
        ("solid axis", "fea"): (3.33e3, 4.10e6),
        ("flexible axis", "vjm"): (3.08e3, 4.06e6),
        ("flexible axis", "fea"): (3.31e3, 4.07e6),
    }
)
"""Table 1: (K_tran, K_rot) by linkage model and method, magnitudes N/mm and N·mm/rad."""
