"""Functions of a site's coordinate as columns: a curve of knots, with the spread that it has before any data, and
sliders for what depends on the path.

The curve is f(c) = sum of w_b hat_b(c) on knots that are denser about zero, with the covariance
s² [Matérn-3/2(u, u'; l) + 4 u u'], u = c / c_max (C. E. Rasmussen,
C. K. I. Williams, Gaussian Processes for Machine Learning, 2006, chapter 4).
A slider of reach r follows the coordinate by s_t = clip(s_(t-1) + c_t - c_(t-1), ±r), relaxed where a test starts: the
stop operator (M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, 1996, chapter 2). Sliders over their reach add
up to a free hysteresis, as in Iwan's model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
KNOTS = 25
DENSER = 1.5
"""Power by which knots gather about zero."""
LINEAR = 4.0
"""Variance of the slope beside that of the curve."""
REACHES = (0.002, 0.01, 0.05, 0.2, 0.5)
"""Of sliders, in the largest coordinate."""
LENGTHS = (0.05, 0.3, 1.5)
"""Correlation lengths of the curve, in the largest coordinate."""


def knots(largest: float) -> Array:
    """(25,) of the curve over ± the largest coordinate."""
    s = np.linspace(-1.0, 1.0, KNOTS)
    return largest * np.sign(s) * np.abs(s) ** DENSER


def hats(coordinate: Array, at: Array) -> Array:
    """(R, K) weights of the knots (K,) in the curve at coordinates (R,)."""
    inside = np.clip(coordinate, at[0], at[-1])
    right = np.clip(np.searchsorted(at, inside, side="right"), 1, at.size - 1)
    share = (inside - at[right - 1]) / (at[right] - at[right - 1])
    out, rows = np.zeros((coordinate.size, at.size)), np.arange(coordinate.size)
    out[rows, right - 1], out[rows, right] = 1.0 - share, share
    return out


def sliders(coordinate: Array, first: np.ndarray, largest: float) -> Array:
    """(R, 5) of sliders over their reach along coordinates (R,) of tests that begin at the rows `first` (tests + 1)."""
    reach = largest * np.array(REACHES)
    counts = np.diff(first)
    out = np.zeros((coordinate.size, reach.size))
    held, before = np.zeros((counts.size, reach.size)), np.zeros((counts.size, 1))
    for step in range(int(counts.max(initial=0))):
        going = np.flatnonzero(counts > step)
        rows = first[going] + step
        here = coordinate[rows, None]
        held[going] = np.clip(held[going] + here - before[going], -reach, reach)
        before[going] = here
        out[rows] = held[going]
    return np.asarray(out / reach)


def basis_of(coordinate: Array, first: np.ndarray, largest: float) -> Array:
    """(R, 30) of curve and sliders along coordinates (R,), see `hats` and `sliders`."""
    return np.hstack([hats(coordinate, knots(largest)), sliders(coordinate, first, largest)])


def unloaded() -> Array:
    """(30,) curve and sliders without load, before any history: the same for any largest coordinate."""
    return np.concatenate([hats(np.zeros(1), knots(1.0))[0], np.zeros(len(REACHES))])


def spread(length: float) -> Array:
    """(25, 25) covariance of the curve at its knots, per s², for a correlation length in the largest coordinate."""
    u = knots(1.0)
    apart = np.sqrt(3.0) * np.abs(u[:, None] - u) / length
    return np.asarray((1.0 + apart) * np.exp(-apart) + LINEAR * u[:, None] * u)


@dataclass(frozen=True, eq=False)
class Prior:
    """Covariance root of curve and sliders, per s². root: (30, 30), weights = root z, z of unit covariance.

    length: of the curve. memory: standard deviation of a slider in those of the curve.
    """

    length: float
    memory: float
    root: Array


MEMORIES = (0.0, 0.3, 3.0)


def priors() -> tuple[Prior, ...]:
    """All of them: correlation lengths, without and with memory."""
    out = []
    for length in LENGTHS:
        covariance = spread(length)
        curve = np.linalg.cholesky(covariance + 1e-9 * np.trace(covariance) / KNOTS * np.eye(KNOTS))
        for memory in MEMORIES:
            root = np.zeros((KNOTS + len(REACHES), KNOTS + len(REACHES)))
            root[:KNOTS, :KNOTS] = curve
            root[KNOTS:, KNOTS:] = memory * np.eye(len(REACHES))
            out.append(Prior(length, memory, root))
    return tuple(out)
