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


# Local nodes of a nine-node quadrilateral row by row, along u, then v.
GRID = [0, 7, 3, 4, 8, 6, 1, 5, 2]
# Of a mesh's size: nodes closer than that are one.
SAME_PLACE = 1e-9


def halved(flat: PlaneMesh) -> PlaneMesh:
    """The mesh with each cell parted in four, on the curves that its cells have."""
    line = np.linspace(-1.0, 1.0, 5)
    one = np.stack((0.5 * line * (line - 1.0), 1.0 - line**2, 0.5 * line * (line + 1.0)))
    nodes = flat.points[flat.cells[:, GRID]].reshape(-1, 3, 3, 2)
    places = np.einsum("mabx,ac,bd->mcdx", nodes, one, one).reshape(-1, 2)
    near = SAME_PLACE * float(np.ptp(flat.points, axis=0).max())
    _, first, number = np.unique(np.round(places / near), axis=0, return_index=True, return_inverse=True)
    number = number.reshape(-1, 5, 5)
    parts = [number[:, i : i + 3, j : j + 3].reshape(-1, 9) for i in (0, 2) for j in (0, 2)]
    cells = np.empty((4 * len(flat.cells), 9), dtype=np.int64)
    cells[:, GRID] = np.stack(parts, axis=1).reshape(-1, 9)
    return PlaneMesh(places[first], cells)


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
