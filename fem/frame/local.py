"""Elastic energy of a beam element in its mean frame: shallow-arch membrane strain, bending with shear, torsion.

Strains: l = |d|; chord slopes β_y = -d_z/l, β_z = d_y/l against the mean frame; φ. Membrane strain
    ε = (l - l0)/h + ½ Σ ([φ, hβ] m [φ, hβ]ᵀ - unloaded),
the mean of v'²/2 of the exact bending line between the ends: φ²/24 + β²/10 / (1 + Φ)² for a uniform element, Φ its
shear parameter. U = ½ EA h ε² + ½ Σ [φ, hβ] k [φ, hβ]ᵀ + ½ GJ φ_x²/h, β and φ from their unloaded values.
Shear enters the membrane strain as in Engesser's column.
Sources: M. A. Crisfield, Non-linear Finite Element Analysis of Solids and Structures 2, Wiley 1997, ch. 17;
J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6 (shear) and 15.3 (string stiffness).
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.so3 import IDENTITY, dot, outer, transpose
from meshes.solid import Floats

_EY, _EZ = IDENTITY[2] * -1.0, IDENTITY[1]
"""Directions whose components over l are the chord slopes β_y and β_z."""


@dataclass(frozen=True, eq=False)
class Reference:
    """Unloaded elements, arrays (..., ) over tests, bars, elements; planes last: about y, about z.

    h: length mm. EA N. GJ N mm². bend (..., 2 planes, 2, 2): stiffness for (φ, hβ). string (..., 2, 2, 2): m.
    length l0 mm, slope β0 (..., 2), turn φ0 (..., 3): unloaded values of the strains.
    centre (..., 2) mm and extent (..., 2) mm: where the flexible stretch lies about the element's middle.
    """

    h: Floats
    EA: Floats
    GJ: Floats
    bend: Floats
    string: Floats
    length: Floats
    slope: Floats
    turn: Floats
    centre: Floats
    extent: Floats


def strains(d: Floats, phi: Floats) -> tuple[Floats, Floats, Floats]:
    """(..., 6) strains (l, β_y, β_z, φ), their (..., 3, 3) rates for d, and l (..., 1)."""
    length = np.sqrt(dot(d, d))[..., None]
    unit = d / length
    slope = np.stack((-unit[..., 2], unit[..., 1]), axis=-1)
    rate = np.empty((*d.shape, 3))
    rate[..., 0, :] = unit
    rate[..., 1, :] = (_EY - slope[..., :1] * unit) / length
    rate[..., 2, :] = (_EZ - slope[..., 1:] * unit) / length
    return np.concatenate((length, slope, phi), axis=-1), rate, length


def curvature_of_strains(d: Floats, length: Floats, strain: Floats, gradient: Floats) -> Floats:
    """(..., 3, 3) second derivative of g·(l, β_y, β_z) for d, with g the first three of `gradient` held."""
    unit = d / length
    across = gradient[..., 1:2] * _EY + gradient[..., 2:3] * _EZ
    held = dot(gradient[..., 1:3], strain[..., 1:3])[..., None, None]
    mixed = outer(across, unit)
    uu = outer(unit, unit)
    l1 = length[..., None]
    second = -(mixed + transpose(mixed)) - held * IDENTITY + 3.0 * held * uu
    return gradient[..., :1, None] * (IDENTITY - uu) / l1 + second / l1**2


def planes(slope: Floats, turn: Floats, h: Floats) -> Floats:
    """(..., 2 planes, 2) the pairs (φ, hβ) of the two bending planes."""
    return np.stack((turn[..., 1:], h[..., None] * slope), axis=-1)


def membrane(strain: Floats, ref: Reference) -> tuple[Floats, Floats]:
    """Membrane strain (...,) and its (..., 6) rate for (l, β, φ)."""
    now, then = planes(strain[..., 1:3], strain[..., 3:], ref.h), planes(ref.slope, ref.turn, ref.h)
    pull = (ref.string @ now[..., None])[..., 0]
    before = (ref.string @ then[..., None])[..., 0]
    bow = 0.5 * (pull * now - before * then).sum((-1, -2))
    rate = np.empty_like(strain)
    rate[..., 0] = 1.0 / ref.h
    rate[..., 1:3] = ref.h[..., None] * pull[..., 1]
    rate[..., 3] = 0.0
    rate[..., 4:] = pull[..., 0]
    return (strain[..., 0] - ref.length) / ref.h + bow, rate


def elastic(strain: Floats, ref: Reference, eps: Floats, rate: Floats) -> tuple[Floats, Floats]:
    """Gradient (..., 6) and Hessian (..., 6, 6) of the energy for (l, β, φ)."""
    h = ref.h
    force = ref.EA * h * eps
    bent = planes(strain[..., 1:3] - ref.slope, strain[..., 3:] - ref.turn, h)
    moment = (ref.bend @ bent[..., None])[..., 0]
    g = force[..., None] * rate
    g[..., 1:3] += h[..., None] * moment[..., 1]
    g[..., 3] += ref.GJ / h * (strain[..., 3] - ref.turn[..., 0])
    g[..., 4:] += moment[..., 0]
    k = (ref.EA * h)[..., None, None] * outer(rate, rate)
    k[..., 3, 3] += ref.GJ / h
    add_planes(k, ref.bend + force[..., None, None, None] * ref.string, h)
    return g, k


def add_planes(k: Floats, pairs: Floats, h: Floats) -> None:
    """Add second derivatives (..., 2 planes, 2, 2) for (φ, hβ) to those (..., 6, 6) for (l, β, φ), in place."""
    for plane in (0, 1):
        i, j = 1 + plane, 4 + plane
        k[..., i, i] += h * h * pairs[..., plane, 1, 1]
        k[..., j, j] += pairs[..., plane, 0, 0]
        k[..., i, j] += h * pairs[..., plane, 0, 1]
        k[..., j, i] += h * pairs[..., plane, 0, 1]
