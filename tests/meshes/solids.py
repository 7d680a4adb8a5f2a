"""Solid meshes of a section drawn through layers."""

from __future__ import annotations

from collections.abc import Sequence

from meshes.extrusion import drawn, kind_of, section_mesh, solid
from meshes.layers import Sweep, SweptMesh
from meshes.resolution import Resolution
from meshes.section import Section


def section_solid(section: Section, resolution: Resolution, thickness: Sequence[float]) -> SweptMesh:
    """The section meshed in its plane and drawn through layers of these thicknesses (n,) mm, base first."""
    return solid(section_mesh(section, resolution), kind_of(section), thickness)


def section_sweep(section: Section, resolution: Resolution, thickness: Sequence[float]) -> Sweep:
    """The section meshed in its plane and drawn through layers of these thicknesses (n,) mm, base first."""
    return drawn(section_mesh(section, resolution), kind_of(section), thickness)
