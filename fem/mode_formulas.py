"""Buckling modes of a bar by formula: load and shape of each, bending in both planes and torsion.

The shape in bending follows from w'''' + k² w'' = 0 with the same soft ends as the load (`euler`); torsion obeys the
same equation, E I_w θ'''' + (P r₀² - G J) θ'' = 0, with its ends held plane by the rigid faces.
Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961: 2.1 to 2.4 (shapes),
5.3, 5.4 (torsion).
"""

from dataclasses import dataclass
from math import cos, pi, sin, tan

import numpy as np

from fem.axis_shape import AxisShape
from fem.beam import Segment
from fem.euler import Bending, critical_compression, half_waves, torsional_load
from meshes.solid import Floats

COLUMN = {"xy": 0, "xz": 1, "torsion": 2}


@dataclass(frozen=True)
class FormulaMode:
    """A mode by formula: `load` N, `plane` "xy", "xz" or "torsion", its `number` in that plane (from 1), the `supports`
    that it has there, and its number of half `waves`, k L / π."""

    load: float
    plane: str
    number: int
    supports: str
    waves: float
    length: float

    def shape(self, x: Floats) -> AxisShape:
        """The shape at stations (n,) along the bar, in rising order, mm."""
        motion = np.zeros((len(x), 3))
        motion[:, COLUMN[self.plane]] = deflection(self.supports, self.number, self.waves, x / self.length)
        return AxisShape(x, motion)


def bending_modes(bending: Bending, plane: str, supports: str, count: int) -> list[FormulaMode]:
    """The `count` lowest modes in one plane; ValueError for unknown supports."""
    return [
        FormulaMode(
            critical_compression(bending, supports, number),
            plane,
            number,
            supports,
            half_waves(supports, number, bending.softness),
            bending.length,
        )
        for number in range(1, count + 1)
    ]


def torsion_modes(
    body: Segment, length: float, supports: str, polar_radius_squared: float, count: int
) -> list[FormulaMode]:
    """The `count` lowest torsional modes of a doubly symmetric bar of `length` mm with both ends held plane.

    A tip that is "free" may turn about x without a torque, so that θ' is zero at both ends, as w' is of a "guided" bar;
    with other supports the tip does not turn, as that of a "clamped" one. `body` is what twists, between the lugs;
    `polar_radius_squared` in mm².
    """
    alike = "guided" if supports == "free" else "clamped"
    waves = [half_waves(alike, number) for number in range(1, count + 1)]
    loads = [torsional_load(body, wave, polar_radius_squared) for wave in waves]
    return [
        FormulaMode(load, "torsion", number, alike, wave, length)
        for number, (load, wave) in enumerate(zip(loads, waves, strict=True), 1)
    ]


def deflection(supports: str, number: int, waves: float, along: Floats) -> Floats:
    """Deflection (n,) of a mode, of any size, at `along` (n,) from 0 at the base to 1 at the tip.

    With ξ from -1 to 1 and u = kL/2: pinned  sin kx;  free  1 - sin(k(L - x)) / sin kL;  guided, sway  sin uξ;  slope
    symmetric  cos uξ;  clamped, antisymmetric  sin uξ - ξ sin u. Raises ValueError for other supports.
    """
    k, u, xi = pi * waves, pi * waves / 2.0, 2.0 * along - 1.0
    if supports == "pinned":
        return np.sin(k * along)
    if supports == "free":
        return 1.0 - np.cos(k * along) + np.sin(k * along) / tan(k)
    if supports not in ("guided", "clamped"):
        raise ValueError(f"supports are {supports!r}, allowed are free, guided, clamped, pinned")
    if (supports == "guided") == (number % 2 == 1):
        return np.sin(u * xi) + (sin(u) if supports == "guided" else -xi * sin(u))
    return np.cos(u * xi) - cos(u)
