"""Closed form of a bar as a stepped beam, the oracle of the solid model: Timoshenko's 6x6 with restrained warping.

A stepped beam is a row of uniform segments; its compliance at the tip is the sum of theirs.
Sources: S. P. Timoshenko, Strength of Materials, part I, 3rd ed., Van Nostrand 1955 (shear deflection);
V. Z. Vlasov, Thin-walled Elastic Beams, 2nd ed., 1961 (warping).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, sqrt, tanh

import numpy as np

from fem.material import Isotropic
from fem.section_constants import SectionConstants
from meshes.solid import Floats


@dataclass(frozen=True)
class Segment:
    """A uniform stretch: `length` mm; EA, GAy, GAz in N (GA of the shear area); EIy, EIz, GJ in N mm²; EIw in N mm⁴.

    An infinite rigidity stands for a stretch that does not give in that way.
    """

    length: float
    EA: float
    EIy: float
    EIz: float
    GJ: float
    GAy: float = inf
    GAz: float = inf
    EIw: float = 0.0

    @staticmethod
    def of(constants: SectionConstants, material: Isotropic, length: float) -> "Segment":
        """Segment of a section with known constants."""
        c, E, G = constants, material.E, material.shear_modulus
        return Segment(
            length, E * c.area, E * c.Iy, E * c.Iz, G * c.J, G * c.shear_area_y, G * c.shear_area_z, E * c.Iw
        )


def uniform_stiffness(length: float, EA: float, EIy: float, EIz: float, GJ: float) -> Floats:
    """(6, 6) tip stiffness of a slender uniform cantilever along x (Euler-Bernoulli, free warping)."""
    return stepped_stiffness([Segment(length, EA, EIy, EIz, GJ)])


def stepped_stiffness(segments: Sequence[Segment]) -> Floats:
    """(6, 6) tip stiffness of a clamped row of segments along x, base first; N, mm, rad."""
    compliance = np.zeros((6, 6))
    beyond = 0.0
    for segment in reversed(segments):
        lever = np.eye(6)
        # A force at the tip is at this segment's end the same force and the moment of its lever arm.
        lever[4, 2], lever[5, 1] = -beyond, beyond
        compliance += lever.T @ segment_compliance(segment) @ lever
        beyond += segment.length
    return np.asarray(np.linalg.inv(compliance), float)


def segment_compliance(s: Segment) -> Floats:
    """(6, 6) compliance of one segment at its own end."""
    a = s.length
    c = np.zeros((6, 6))
    c[0, 0] = a / s.EA
    c[1, 1] = a**3 / (3 * s.EIz) + a / s.GAy
    c[2, 2] = a**3 / (3 * s.EIy) + a / s.GAz
    c[3, 3] = twist_compliance(s)
    c[4, 4], c[5, 5] = a / s.EIy, a / s.EIz
    c[1, 5] = c[5, 1] = a**2 / (2 * s.EIz)
    c[2, 4] = c[4, 2] = -(a**2) / (2 * s.EIy)
    return c


def twist_compliance(s: Segment) -> float:
    """Twist for a unit torque, rad/(N mm), both ends plane: (L - (2/k) tanh(kL/2)) / GJ, k² = GJ / EIw."""
    if s.EIw == 0.0:
        return s.length / s.GJ
    k = sqrt(s.GJ / s.EIw)
    return (s.length - 2.0 / k * tanh(k * s.length / 2.0)) / s.GJ


def one_end_warping_factor(s: Segment) -> float:
    """Twist compliance with one end free to warp over that with both ends held plane."""
    if s.EIw == 0.0:
        return 1.0
    k = sqrt(s.GJ / s.EIw)
    one = s.length - tanh(k * s.length) / k
    return one / (s.length - 2.0 / k * tanh(k * s.length / 2.0))
