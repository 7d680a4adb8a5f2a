"""What axial force does to a bar's 6x6: identified from the solid beside K_b.

Under an axial force P, tension positive, the stiffness of all unknowns is K + P K_g. Condensed to the tip it is
S(P) with S(0) = K_b, and dS/dP at P = 0 is Tᵀ K_g T exactly, T the six unit motions of the tip: what the inner nodes
change is of second order. K_g contains the curvature of the rigid face; the strain of the axial force itself,
P / EA beside 1, is left out, as in linear buckling.
"""

from dataclasses import dataclass
from math import sqrt, tanh

import numpy as np

from fem.beam import Segment, stepped_stiffness
from fem.linear import LinearModel
from fem.prestress import stressed
from meshes.solid import Floats


@dataclass(frozen=True, eq=False)
class AxialStiffness:
    """Stiffness of a bar's tip to first order in its axial force P (N, tension positive): elastic + P geometric.

    Both (6, 6) at the middle of the tip face, bar frame, N, mm, rad; `geometric` per N.
    """

    elastic: Floats
    geometric: Floats

    def at(self, force: float) -> Floats:
        """(6, 6) under an axial force, N."""
        return self.elastic + force * self.geometric


def axial_stiffness(model: LinearModel) -> AxialStiffness:
    """K_b and K_g of a clamped bar (`fem.linkage.single_bar`) from one factorisation; SolveError if it is not held."""
    motions, elastic = model.unit_motions, model.stiffness
    # Pulled by a unit axial force, free to do what it likes otherwise.
    state = stressed(model, motions @ np.linalg.solve(elastic, np.eye(6)[0]))
    geometric = motions.T @ (state.geometric @ motions)
    return AxialStiffness(elastic, 0.5 * (geometric + geometric.T))


def uniform_geometric_stiffness(beam: Segment, polar_radius_squared: float) -> Floats:
    """(6, 6) K_g at the tip of a clamped uniform beam per N of axial tension, both ends plane and held.

    Cubic shapes with shear: 6/(5L), 1/10 and 2L/15 in each plane where GA is infinite; K / EA beside them, the work
    of the axial strain of bending. Torsion: `polar_radius_squared` r₀² = (Iy + Iz) / A, mm², times ∫θ'² dx for the
    twist θ of restrained warping (Wagner's term, r₀²/L where the section warps freely).
    Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis, McGraw-Hill 1968, chapter 15.
    """
    length = beam.length
    k = stepped_stiffness([beam]) / beam.EA
    k[3, 3] = polar_radius_squared * mean_square_twist(beam) / length
    for push, turn, sign, rigidity, shear in (
        (1, 5, -1.0, beam.EIz, beam.GAy),
        (2, 4, 1.0, beam.EIy, beam.GAz),
    ):
        phi = 12.0 * rigidity / (shear * length**2)
        scale = (1.0 + phi) ** 2
        k[push, push] += (6 / 5 + 2 * phi + phi**2) / (length * scale)
        k[push, turn] += sign / (10 * scale)
        k[turn, push] = k[push, turn]
        k[turn, turn] += length * (2 / 15 + phi / 6 + phi**2 / 12) / scale
    return k


def mean_square_twist(beam: Segment) -> float:
    """L ∫θ'² dx / (∫θ' dx)² with θ' = 1 - cosh k(x - L/2) / cosh(kL/2), k² = GJ / EIw; 1 without warping stiffness."""
    if beam.EIw == 0.0:
        return 1.0
    k, length = sqrt(beam.GJ / beam.EIw), beam.length
    end = tanh(k * length / 2.0)
    square = length - 3.0 * end / k + 0.5 * length * (1.0 - end**2)
    return length * square / (length - 2.0 * end / k) ** 2
