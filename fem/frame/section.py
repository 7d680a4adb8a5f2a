"""The stiffness of a bar: section rigidities between ends that may be rigid, given, or inferred from a 6x6.

Each bending plane of a straight bar is known at rest by three numbers: the amount of its flexibility (rotation under
a unit moment), the centre (where a force does not turn the tip) and the spread (deflection under a unit force
there, without the turn). A uniform stretch of length f with bending stiffness EI and shear stiffness GA has amount
f/EI and spread f³/(12 EI) + f/GA.
"""

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from meshes.solid import Floats

COUPLED = 1e-3
"""Largest entry, over the geometric mean of its diagonal, of a coupling that a straight beam does not have and that is
left out: tetrahedra of parts with two planes of symmetry leave up to 6e-4."""


@dataclass(frozen=True)
class Plane:
    """Bending in one plane: EI N mm², GA N (inf: no shear), and the rigid stretches at base and tip over the length.

    A negative rigid stretch stands for an end softer than the section: flexibility beyond the end of the bar.
    """

    EI: float
    GA: float = inf
    base: float = 0.0
    tip: float = 0.0


@dataclass(frozen=True)
class Section:
    """A bar's rigidities: EA N, GJ N mm², bending `about_y` (plane xz) and `about_z` (plane xy)."""

    EA: float
    GJ: float
    about_y: Plane
    about_z: Plane

    def scaled(self, factor: float) -> "Section":
        """Every rigidity times a factor."""
        return self.scaled_each(factor, factor, factor, factor)

    def scaled_each(self, axial: float, about_y: float, about_z: float, torsion: float) -> "Section":
        """Each rigidity times its own factor, shear with the bending of its plane."""
        y, z = self.about_y, self.about_z
        return Section(
            self.EA * axial,
            self.GJ * torsion,
            Plane(y.EI * about_y, y.GA * about_y, y.base, y.tip),
            Plane(z.EI * about_z, z.GA * about_z, z.base, z.tip),
        )


def uniform(EA: float, EIy: float, EIz: float, GJ: float) -> Section:
    """A slender uniform bar, without shear. Raises ValueError for a rigidity that is not positive."""
    for name, value in {"EA": EA, "EIy": EIy, "EIz": EIz, "GJ": GJ}.items():
        if not value > 0.0:
            raise ValueError(f"{name} is {value:g}, allowed are positive values")
    return Section(EA, GJ, Plane(EIy), Plane(EIz))


def section_of(stiffness: Floats, length: float) -> Section:
    """The section of a bar with this (6, 6) at its tip, base clamped; N, mm, rad. Gives the 6x6 back, but for
    couplings up to `COUPLED`.

    A spread at or above that of a uniform bar of the bar's length is shear, one below it is rigid ends, in each
    plane by itself; the centre places the flexible stretch. Raises ValueError for a 6x6 that is not symmetric
    positive definite, or that couples what a straight beam of doubly symmetric section does not.
    """
    k = np.asarray(stiffness, float)
    if k.shape != (6, 6) or not np.allclose(k, k.T, rtol=1e-6, atol=1e-9 * float(np.abs(k).max())):
        raise ValueError("a bar's stiffness must be a symmetric 6x6")
    root = np.sqrt(np.abs(np.diag(k)))
    allowed = np.eye(6, dtype=bool)
    for i, j in ((1, 5), (2, 4)):
        allowed[i, j] = allowed[j, i] = True
    coupled = np.where(allowed, 0.0, np.abs(k) / np.outer(root, root))
    if float(coupled.max()) > COUPLED:
        row, column = divmod(int(coupled.argmax()), 6)
        raise ValueError(
            f"K{row + 1}{column + 1} of the bar couples by {100.0 * float(coupled.max()):.2g} % of the root of its "
            f"diagonal entries, allowed are {100.0 * COUPLED:g} %: the frame is made of straight beams"
        )
    if float(np.linalg.eigvalsh(k).min()) <= 0.0:
        raise ValueError("a bar's stiffness must be positive definite")
    about_y = _plane(k[2, 2], k[2, 4], k[4, 4], length)
    about_z = _plane(k[1, 1], -k[1, 5], k[5, 5], length)
    return Section(float(k[0, 0]) * length, float(k[3, 3]) * length, about_y, about_z)


def _plane(push: float, mixed: float, turn: float, length: float) -> Plane:
    """One plane from its three entries: force and moment for a unit shift, moment for a unit turn of the tip."""
    from_tip = mixed / push
    amount = 1.0 / (turn - mixed**2 / push)
    spread = 1.0 / push
    flexible = min(length, sqrt(12.0 * spread / amount))
    EI = flexible / amount
    shear = spread - flexible**3 / (12.0 * EI)
    GA = length / shear if shear > 1e-9 * spread else inf
    base, tip = length - from_tip - flexible / 2.0, from_tip - flexible / 2.0
    return Plane(float(EI), float(GA), float(base / length), float(tip / length))
