"""A section meshed in its own plane with quadratic quadrilaterals."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshes.section import Section
from meshes.solid import Floats, Ints


@dataclass(frozen=True)
class PlaneMesh:
    """`points` (n, 2) of y and z in mm; `cells` (m, 9) node numbers in the order of meshio's quad9."""

    points: Floats
    cells: Ints


def mesh_section(section: Section, size: float) -> PlaneMesh:
    """Mesh a section with elements of about `size` mm, at least four across the shortest edge of a patch."""
    # Late: gmsh needs libraries of the system that most commands do without.
    import gmsh
    import meshio

    from meshes.gmsh_session import session
    from meshes.sweep import add_patch, opposite_edges

    with session("section"), tempfile.TemporaryDirectory() as folder:
        patches = [(2, add_patch(patch, 0.0)) for patch in section.patches()]
        if len(patches) > 1:
            gmsh.model.occ.fragment(patches[:1], patches[1:])
        gmsh.model.occ.synchronize()
        curves = [tag for _, tag in gmsh.model.getEntities(1)]
        leader = opposite_edges(curves)
        lengths: dict[int, float] = {}
        for curve in curves:
            lengths[leader[curve]] = max(lengths.get(leader[curve], 0.0), gmsh.model.occ.getMass(1, curve))
        for curve in curves:
            gmsh.model.mesh.setTransfiniteCurve(curve, max(4, round(lengths[leader[curve]] / size)) + 1)
        for _, surface in gmsh.model.getEntities(2):
            gmsh.model.mesh.setTransfiniteSurface(surface)
            gmsh.model.mesh.setRecombine(2, surface)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)
        path = Path(folder) / "section.msh"
        gmsh.write(str(path))
        raw = meshio.gmsh.read(path)
    return PlaneMesh(np.asarray(raw.points[:, 1:], float), raw.cells_dict["quad9"].astype(np.int64))
