"""Input checks shared by the mechanisms: one clear sentence when a value makes no sense."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array


def positive(name: str, value: float) -> None:
    """ValueError unless the value is a finite positive number."""
    if not (np.isfinite(value) and value > 0):
        raise ValueError(f"{name} must be positive and finite, got {value}")


def stiffness_matrix(name: str, value: ArrayLike) -> Array:
    """The value as a read-only symmetric positive definite 6x6; ValueError otherwise.

    Tested after scaling to a unit diagonal, so that N/mm and N·mm/rad weigh the same.
    """
    k = np.asarray(value, dtype=float)
    if k.shape != (6, 6):
        raise ValueError(f"{name} must be a 6x6 matrix, got shape {k.shape}")
    return _checked(name, k.tobytes())


@lru_cache(maxsize=4096)
def _checked(name: str, values: bytes) -> Array:
    """The same of a matrix by its values: a mechanism is altered many times, its matrices seldom."""
    k = np.frombuffer(values).reshape(6, 6)
    if not np.all(np.isfinite(k)):
        raise ValueError(f"{name} must have finite entries")
    if np.any(np.diag(k) <= 0):
        raise ValueError(f"{name} must be positive definite, its diagonal is {np.diag(k)}")
    scale = 1.0 / np.sqrt(np.diag(k))
    unit = scale[:, None] * k * scale
    asymmetry = np.max(np.abs(unit - unit.T))
    if asymmetry > 1e-6:
        raise ValueError(f"{name} must be symmetric, scaled entries differ by {asymmetry:.2g}")
    lowest = np.linalg.eigvalsh(0.5 * (unit + unit.T))[0]
    if lowest <= 1e-12:
        raise ValueError(f"{name} must be positive definite, lowest scaled eigenvalue {lowest:.2g}")
    k = 0.5 * (k + k.T)
    k.flags.writeable = False
    return k
