"""Closed forms of single cases that tests compare with; those of the validation are in `vjm.closed_forms`."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.mechanisms.parallelogram import Parallelogram


def middle_uniform(bending: float, length: float) -> float:
    """Springs at the middle of uniform bars, EI_y in N·mm², axially rigid: -4 (sqrt 7 - 1) EI_y / L².

    There K33' = 12 EI/L³, K35' = 0, K55' = EI/L, and with p = -P L²/EI the Hessian of `in_plane_critical` in
    `vjm.closed_forms` gives (12 + p)(1 - p/4) = p²/4, that is p² + 4 p - 24 = 0, p = 2 (sqrt 7 - 1) per bar.
    """
    return -4.0 * (np.sqrt(7.0) - 1.0) * bending / length**2


def tip_tension_branch(linkage: Parallelogram, x: ArrayLike) -> Array:
    """Fx (...), N, on the post-critical branch of springs at the tip, q = 0, platform at x (...), mm.

    With k = K33 - K35²/K55 and bars at the angle a: U = K11 (x cos a - L)²/2 + k x² sin² a / 2 per bar;
    dU/da = 0 gives K11 (x cos a - L) = k x cos a, then dU/dx = k x.
    """
    assert linkage.spring_at == "tip" and linkage.q == 0.0
    k = linkage.bar_stiffness
    return np.asarray(2.0 * (k[2, 2] - k[2, 4] ** 2 / k[4, 4]) * np.asarray(x, dtype=float))
