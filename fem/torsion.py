"""Torsion constant of a section, in closed form where there is one; else from Saint-Venant's problem on a mesh."""

from __future__ import annotations

from math import pi, tanh

from meshes.section import Rectangle, Round, Section, Tube

TERMS = 12
"""Of the series of a rectangle, each a fifth power smaller: more change nothing at double precision."""


def torsion_constant(section: Section) -> float:
    """J, mm⁴.

    A round and a tube have their polar moment, a rectangle a series (S. P. Timoshenko, J. N. Goodier, Theory of
    Elasticity, 3rd edition 1970, section 109). Other sections are meshed, which needs gmsh.
    """
    if isinstance(section, Round):
        return pi * section.diameter**4 / 32.0
    if isinstance(section, Tube):
        inner = section.outer_diameter - 2.0 * section.wall
        return pi * (section.outer_diameter**4 - inner**4) / 32.0
    if isinstance(section, Rectangle):
        long, short = max(section.size), min(section.size)
        odd = range(1, 2 * TERMS, 2)
        series = sum(tanh(0.5 * n * pi * long / short) / n**5 for n in odd)
        return long * short**3 / 3.0 * (1.0 - 192.0 / pi**5 * short / long * series)
    from fem.section_constants import section_constants

    return section_constants(section, 0.3).J
