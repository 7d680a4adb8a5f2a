"""Critical loads of a bar by formula: Euler's, with shear, soft ends and torsion.

A bar is taken as uniform between two end springs, one at each end face; what these springs and EI are follows
from its 6x6 (`bending_of`). A lug that is softer or stiffer than the section shows up there.
Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961: sections 2.2 to 2.4
(supports), 2.17 (shear, after Engesser), 5.3 and 5.4 (torsion).
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, inf, isfinite, pi, sin

import numpy as np
from scipy.optimize import brentq

from fem.beam import Segment
from meshes.solid import Floats

SUPPORTS = ("free", "guided", "clamped", "pinned")
EDGE = 1e-9


@dataclass(frozen=True)
class Bending:
    """Bending of a symmetric bar in one plane: `EI` in N mm², shear stiffness `GA` in N, and `softness`
    φ = 2 EI f / L with f the flexibility of the spring at each end, rad/(N mm); negative where an end is stiffer."""

    EI: float
    GA: float
    length: float
    softness: float


def bending_of(stiffness: Floats, length: float, plane: str, GA: float = inf) -> Bending:
    """Bending of the bar with this (6, 6) in the plane "xy" or "xz".

    From c = C66 = L/EI + 2f and 1/K22 = L³/(12 EI) + f L²/2 + L/GA (for "xz": C55 and K33).
    """
    turn, push = {"xy": (5, 1), "xz": (4, 2)}[plane]
    c = float(np.linalg.inv(stiffness)[turn, turn])
    shear = length / GA if isfinite(GA) else 0.0
    EI = length**3 / 6.0 / (c * length**2 / 4.0 + shear - 1.0 / float(stiffness[push, push]))
    return Bending(EI, GA, length, EI * c / length - 1.0)


def critical_compression(bending: Bending, supports: str, mode: int) -> float:
    """Compression at which the `mode`-th mode (from 1) appears in this plane, N.

    Supports: base clamped and tip "free", "guided" (slides sideways, does not turn) or "clamped"; "pinned" at both
    ends. Raises ValueError for other supports.
    """
    wave = half_waves(supports, mode, bending.softness)
    slender = pi**2 * bending.EI * wave**2 / bending.length**2
    return slender / (1.0 + slender / bending.GA)


def half_waves(supports: str, mode: int, softness: float = 0.0) -> float:
    """Number of half sine waves k L / π of a mode, with soft ends.

    With u = kL/2 and the softness φ: free  cot 2u = φ u;  guided and clamped, symmetric slope  tan u = -φ u;
    guided, sway  cot u = φ u;  clamped, antisymmetric  u = (1 + φ u²) tan u;  pinned  2u = n π, whatever φ.
    """
    if supports not in SUPPORTS:
        raise ValueError(f"supports are {supports!r}, allowed are {', '.join(SUPPORTS)}")
    if supports == "pinned":
        return float(mode)
    if supports == "free":
        return root(lambda u: cos(2 * u) - softness * u * sin(2 * u), (mode - 1) * pi / 2, mode * pi / 2)
    middle = mode * pi / 2
    if supports == "guided":
        if mode % 2:
            return root(lambda u: cos(u) - softness * u * sin(u), middle - pi / 2, middle + pi / 2)
        return root(lambda u: sin(u) + softness * u * cos(u), middle - pi / 2, middle + pi / 2)
    if mode % 2:
        middle = (mode + 1) * pi / 2
        return root(lambda u: sin(u) + softness * u * cos(u), middle - pi / 2, middle + pi / 2)
    low = mode * pi / 2
    return root(lambda u: (1 + softness * u * u) * sin(u) - u * cos(u), low, low + pi)


def root(condition: Callable[[float], float], low: float, high: float) -> float:
    """2u/π at the zero of a condition on u between two bounds."""
    return 2.0 * float(brentq(condition, low + EDGE, high - EDGE)) / pi


def torsional_load(s: Segment, warping_waves: float, polar_radius_squared: float) -> float:
    """Compression that buckles a doubly symmetric bar in torsion, N: (GJ + (n π / L)² EIw) / r₀².

    `warping_waves` n: 2 where both ends are held plane and from turning, 1 where one end is held plane but may turn,
    1/2 where it is free of both;
    `polar_radius_squared` r₀² = (Iy + Iz) / A, mm².
    """
    return (s.GJ + (warping_waves * pi / s.length) ** 2 * s.EIw) / polar_radius_squared
