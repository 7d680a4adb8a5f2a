"""Critical loads of the parallelogram in closed form: of the lumped model, and exact for uniform bars.

Loads are Fx on the platform, N, of both bars together; compression negative, tension positive. z is held.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import move_stiffness
from vjm.lumped import STATION
from vjm.mechanisms.parallelogram import Parallelogram


@dataclass(frozen=True)
class InPlane:
    """In-plane critical loads; None where that sign has none."""

    compression: float | None
    tension: float | None


def in_plane_critical(linkage: Parallelogram) -> InPlane:
    """Bars turning between their pins, platform guided (z, rx, ry, rz held): exact for the chain of Eq. 1.

    Let the spring sit at the distance r from the tip hinge, K' = K_b moved there, P the tension of a bar and
    c = L + P / K11 the distance of its pins. Two rigid parts with T(theta1, theta3) R_y(theta5) between them
    close the chord when c² = (L - r + theta1 + r cos theta5)² + (theta3 - r sin theta5)², to second order
    theta1 = P / K11 + r theta5² / 2 - (theta3 - r theta5)² / (2c). In U = K11 theta1² / 2 + (K' part) the
    Hessian over (theta3, theta5) is

        [ K33' - P/c ,  K35' + P r/c             ]
        [  ...       ,  K55' + P r - P r²/c      ]

    and its determinant vanishes. With D = K33 K55 - K35², which the move does not change, the entries K'
    reduce to those of K_b, and with c = L + P/K11 the condition is

        D L + P (r L K33 + D / K11 - K55) - P² r (1 - K33 / K11) = 0.

    r = 0 (tip): P = D L / (K55 - D/K11), tension only; 2 L (K33 - K35²/K55) for rigid axial springs.
    r = L (base), rigid axial: (K33' - P/L) K55' = (K35' + P)².
    r = L/2 (middle): see `middle_hinge_only`.
    The chord keeps the height L sin q, so Fx = 2 P sqrt(1 - (L sin q / c)²).
    """
    k = linkage.bar_stiffness
    length, r = linkage.length, (1.0 - STATION[linkage.spring_at]) * linkage.length
    d = k[2, 2] * k[4, 4] - k[2, 4] ** 2
    coefficients = [d * length, r * length * k[2, 2] + d / k[0, 0] - k[4, 4], -r * (1.0 - k[2, 2] / k[0, 0])]
    tensions = np.polynomial.polynomial.polyroots(np.trim_zeros(coefficients, "b"))
    loads = [_along_x(linkage, float(p)) for p in np.real(tensions)]
    return InPlane(
        compression=max((f for f in loads if f < 0), default=None),
        tension=min((f for f in loads if f > 0), default=None),
    )


def out_of_plane_cantilever(linkage: Parallelogram) -> float | None:
    """Platform y and rz free, q = 0: bars bending sideways from their base hinges; None for the tip.

    A turn theta6 shortens the chord by r theta6² / 2 while theta2 follows free of load, so the remaining
    stiffness K66 - K26²/K22 (unchanged by the move) is lost at P = -(K66 - K26²/K22) / r per bar. A spring at
    the tip has r = 0: sideways the lumped model has no geometric stiffness at all.
    """
    k = linkage.bar_stiffness
    r = (1.0 - STATION[linkage.spring_at]) * linkage.length
    return None if r == 0 else -2.0 * float(k[5, 5] - k[1, 5] ** 2 / k[1, 1]) / r


def middle_hinge_only(bar_stiffness: ArrayLike, length: float) -> float:
    """Springs at the middle with the transverse spring rigid: -8 K55' / L, uniform -8 EI_y / L².

    The two-link column: two rigid halves at the angle theta5 shorten by L theta5²/8. Eq. 1 as written stays
    below it, for its theta3 stands before the turn R_y(theta5), feels the force of the tilted first half and
    gives; with theta3 in the half-turned frame the two-link value would return (to K35'²/K33').
    """
    moved = move_stiffness(bar_stiffness, [-0.5 * length, 0.0, 0.0])
    return -8.0 * float(moved[4, 4]) / length


@dataclass(frozen=True)
class EulerLoads:
    """Exact critical loads at q = 0 of a parallelogram of uniform slender bars, N, compression negative.

    in_plane: between the pins about y. guided: sideways, platform y free, not rotating. clamped: sideways,
    platform held. cantilever: sideways, platform y and rz free.
    """

    in_plane: float
    guided: float
    clamped: float
    cantilever: float


def euler_loads(bending_y: float, bending_z: float, length: float) -> EulerLoads:
    """Two bars, each at Euler's load pi² EI / (effective length)²: L, L, L/2, 2 L in the record's order.

    bending_y, bending_z: EI_y (in plane), EI_z (sideways), N·mm². Without shear, axially rigid.
    S. P. Timoshenko, J. M. Gere, "Theory of Elastic Stability", 2nd ed., McGraw-Hill 1961, chapter 2.
    """
    unit = np.pi**2 / length**2
    return EulerLoads(
        in_plane=-2.0 * unit * bending_y,
        guided=-2.0 * unit * bending_z,
        clamped=-8.0 * unit * bending_z,
        cantilever=-0.5 * unit * bending_z,
    )


def _along_x(linkage: Parallelogram, tension: float) -> float:
    """Fx of both bars when each carries `tension` along the chord between its pins."""
    chord = linkage.length + tension / linkage.bar_stiffness[0, 0]
    return float(2.0 * tension * np.sqrt(1.0 - (linkage.length * np.sin(linkage.q) / chord) ** 2))
