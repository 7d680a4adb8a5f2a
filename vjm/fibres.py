"""Fibres of a bar's section: where they lie, and how one of them yields.

The section is known by its stiffnesses and its outermost fibres only, so its shape is the simplest that has
them: in each direction a rectangle's even distribution from edge to edge, with a lump at both edges (flanges)
or in the middle (web) such that the mean square distance is EI / EA; the section is the product of both.
A fibre is elastic up to a strain and then hardens linearly and kinematically: J. C. Simo, T. J. R. Hughes,
Computational Inelasticity, Springer 1998, section 1.4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm import checks
from vjm.frames import Array

HARDENING = 0.01
"""Tangent over elastic modulus beyond the yield strain, of the order of structural steel and aluminium."""
_H = HARDENING / (1.0 - HARDENING)

POINTS = 7
"""Fibres in each direction, those of a Gauss-Lobatto rule, which has the outermost ones among them."""


@dataclass(frozen=True)
class Fibres:
    """Outermost fibres at ± y and ± z, mm, and the strain at which a fibre yields.

    ValueError unless all are positive and finite.
    """

    y: float
    z: float
    limit: float

    def __post_init__(self) -> None:
        checks.positive("fibre_y", self.y)
        checks.positive("fibre_z", self.z)
        checks.positive("strain", self.limit)

    def grid(self, radius_y: float, radius_z: float) -> tuple[Array, Array]:
        """(2, 49) places y and z, mm, and (49,) weights of sum one of a section with these radii of gyration, mm.

        radius_y: root mean square of y, sqrt(EI_z / EA). Fibres reach as far as these radii need: a fit may scale the
        stiffnesses of a section beyond what its edges allow.
        """
        (y, in_y), (z, in_z) = row(self.y, radius_y), row(self.z, radius_z)
        places = np.stack(np.broadcast_arrays(y[:, None], z[None, :]))
        return places.reshape(2, -1), np.outer(in_y, in_z).ravel()

    def inside(self, radius_y: float, radius_z: float) -> str:
        """What is wrong with edges inside the radii of gyration, mm, of which there is no section; "" if none is."""
        for name, edge, radius in (("fibre_y", self.y, radius_y), ("fibre_z", self.z, radius_z)):
            if not radius < edge:
                return f"{name} must be more than the radius of gyration {radius:.4g} mm, got {edge:g}"
        return ""

    def plastic(self, strain: Array, before: Array) -> tuple[Array, Array]:
        """Plastic strain of fibres at `strain`, from the one before, and its derivative by the strain.

        The stress over the modulus is strain - plastic; it yields where it is `limit` away from the shift of
        the elastic range, plastic x HARDENING / (1 - HARDENING).
        """
        beyond = strain - before / (1.0 - HARDENING)
        over = beyond - np.clip(beyond, -self.limit, self.limit)
        return before + over / (1.0 + _H), np.where(over == 0.0, 0.0, 1.0 / (1.0 + _H))


def lobatto(points: int) -> tuple[Array, Array]:
    """Places (n,) from -1 to 1 and weights (n,) of sum one of a Gauss-Lobatto rule of n points, which has the ends
    among them."""
    polynomial = np.polynomial.legendre.Legendre.basis(points - 1)
    inner = np.sort(polynomial.deriv().roots().real)
    at = np.concatenate([[-1.0], inner, [1.0]])
    return at, 1.0 / (points * (points - 1) * polynomial(at) ** 2)


def row(edge: float, radius: float) -> tuple[Array, Array]:
    """Places (POINTS,), mm, from -edge to edge, and weights of sum one with the mean square radius²; farther out where
    the edge is not beyond the radius."""
    edge = max(edge, radius)
    at, even = lobatto(POINTS)
    share = 3.0 * (radius / edge) ** 2
    middle = np.eye(POINTS)[POINTS // 2]
    edges = 0.5 * (np.eye(POINTS)[0] + np.eye(POINTS)[-1])
    weights = share * even + (1.0 - share) * middle if share < 1.0 else (1.5 - 0.5 * share) * even
    return edge * at, weights if share < 1.0 else weights + 0.5 * (share - 1.0) * edges
