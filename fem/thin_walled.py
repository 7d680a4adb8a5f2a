"""Section constants by hand: the thin-walled formulas of an I-section and those of a rectangle.

A cheap model to start from: area and second moments are exact, J is good to a few per cent, the shear areas and the
warping constant of thick flanges only to a quarter. `section_constants` is exact and takes a finite-element solution.
Source: W. C. Young, R. G. Budynas, Roark's Formulas for Stress and Strain, 7th ed., McGraw-Hill 2002, table 10.1
(torsion) and table 10.2 (warping); shear areas: web, and 5/6 of the flanges.
"""

from fem.section_constants import SectionConstants
from meshes.section import ISection, Rectangle


def i_section_constants(s: ISection) -> SectionConstants:
    """Constants of an I-section made of three thin strips."""
    iy, iz = s.second_moments
    depth = s.height - s.flange_thickness
    j = (2 * s.flange_width * s.flange_thickness**3 + depth * s.web**3) / 3
    shear_y = 2 * 5 / 6 * s.flange_width * s.flange_thickness
    return SectionConstants(s.area, iy, iz, j, iz * depth**2 / 4, shear_y, s.web * depth)


def rectangle_constants(s: Rectangle) -> SectionConstants:
    """Constants of a solid rectangle, without its small warping stiffness."""
    iy, iz = s.second_moments
    long, short = max(s.size), min(s.size)
    slender = short / long
    j = long * short**3 * (1 / 3 - 0.21 * slender * (1 - slender**4 / 12))
    return SectionConstants(s.area, iy, iz, j, 0.0, 5 / 6 * s.area, 5 / 6 * s.area)
