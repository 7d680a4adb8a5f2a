"""A CAD solid that is a prism between its two ends: its section meshed with quadrilaterals and swept to hexahedra."""

from collections.abc import Mapping, Sequence
from math import ceil, log2
from typing import Any

import gmsh
import numpy as np

from meshes.brought.ends import End, Outside, end_of
from meshes.brought.of_gmsh import region_name
from meshes.brought.raw import Raw
from meshes.extrusion import solid, stepped_thickness
from meshes.facets import Plane
from meshes.plane import PlaneMesh
from meshes.solid import Floats, Ints

# Sine between a side's normal and the plane across the bar.
ALONG = 1e-6
# Of the mesh size: a layer at an end, where the stress varies, and how much thicker the next kind of layer is.
FIRST, LAYERS = 0.5, 2


def swept(solids: Sequence[tuple[int, int]], asked: Mapping[str, Any], size: float) -> list[Raw] | None:
    """Two nested meshes of hexahedra, or None where the part is no prism between two plane ends that are one face each.

    The open model's mesh is used up. ValueError for ends that are not there.
    """
    if len(solids) != 1 or any("plane" not in asked[which] for which in ("base", "tip")):
        return None
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.model.mesh.generate(2)
    outside, faces = _surface()
    ends = [end_of(outside, asked[which], which) for which in ("base", "tip")]
    tags = [_face_of(end, faces) for end in ends]
    if None in tags or tags[0] == tags[1] or not _is_prism(ends, [t for t in tags if t is not None]):
        return None
    along = ends[1].at - ends[0].at
    length = float(np.linalg.norm(along))
    if not length > 0.0:
        return None
    turn = _across(along / length)
    flats = _quadrilaterals(int(tags[0] or 0), ends[0].at, turn, size)
    kinds = max(1, ceil(log2(max(length / (2 * LAYERS * FIRST * size), 1.0) + 1.0)))
    raws = []
    for level, flat in enumerate(flats):
        thickness = stepped_thickness(length, [LAYERS * 2**level] * kinds)
        mesh = solid(flat, "hexahedron27", thickness.tolist()).mesh
        points = ends[0].at + mesh.points @ turn
        name = region_name(solids[0])
        region = np.zeros(len(mesh.cells), dtype=np.int64)
        raws.append(Raw(points, (("hexahedron27", mesh.cells),), region, (name,), {}))
    return raws


def _surface() -> tuple[Outside, dict[int, Ints]]:
    """The boundary by the triangles of its mesh, and the triangles of each face."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    number = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    number[tags.astype(np.int64)] = np.arange(len(tags))
    faces = {}
    for _, tag in gmsh.model.getEntities(2):
        _, _, nodes = gmsh.model.mesh.getElements(2, tag)
        if len(nodes) == 1:
            faces[int(tag)] = number[nodes[0].astype(np.int64)].reshape(-1, 6)
    points = np.asarray(coordinates, dtype=float).reshape(-1, 3)
    return Outside(points, {"triangle6": np.concatenate([*faces.values()])}, {}), faces


def _face_of(end: End, faces: Mapping[int, Ints]) -> int | None:
    """The one face that is the end; None where there are several or parts of one."""
    if not isinstance(end.surface, Plane):
        return None
    own = {tuple(row) for row in end.facets["triangle6"].tolist()}
    found = [tag for tag, rows in faces.items() if own & {tuple(row) for row in rows.tolist()}]
    return found[0] if len(found) == 1 and len(faces[found[0]]) == len(own) else None


def _is_prism(ends: Sequence[End], tags: Sequence[int]) -> bool:
    """Whether all other faces run along the line between the ends, which stands upright on both."""
    along = ends[1].at - ends[0].at
    x = along / np.linalg.norm(along)
    for end in ends:
        if not isinstance(end.surface, Plane) or abs(float(np.dot(end.surface.normal, x))) < 1.0 - 1e-9:
            return False
    for _, tag in gmsh.model.getEntities(2):
        if tag not in tags:
            _, _, places = gmsh.model.mesh.getNodes(2, tag, includeBoundary=True, returnParametricCoord=True)
            normals = np.asarray(gmsh.model.getNormal(tag, places)).reshape(-1, 3)
            if np.abs(normals @ x).max() > ALONG:
                return False
    return True


def _across(x: Floats) -> Floats:
    """(3, 3) rows x, y, z of a frame along x."""
    y = np.cross(np.eye(3)[int(np.argmin(np.abs(x)))], x)
    y /= np.linalg.norm(y)
    return np.stack((x, y, np.cross(x, y)))


def _quadrilaterals(tag: int, origin: Floats, turn: Floats, size: float) -> list[PlaneMesh]:
    """Two nested meshes of the face, y and z of the frame: each triangle of a coarser one is three quadrilaterals."""
    option = gmsh.option.setNumber
    gmsh.model.mesh.clear()
    for entity in gmsh.model.getEntities(2):
        gmsh.model.setVisibility([entity], int(entity[1] == tag))
    option("Mesh.MeshOnlyVisible", 1)
    option("Mesh.RecombineAll", 1)
    option("Mesh.SubdivisionAlgorithm", 1)
    option("Mesh.SecondOrderIncomplete", 0)
    option("Mesh.ElementOrder", 1)
    # Halved by the subdivision; the first mesh is as coarse as the section allows, the second counts.
    option("Mesh.MeshSizeMax", 2.0 * size)
    gmsh.model.mesh.generate(2)
    flats = []
    for level in range(2):
        if level:
            gmsh.model.mesh.refine()
        gmsh.model.mesh.setOrder(2)
        flats.append(_plane_mesh(tag, origin, turn))
        gmsh.model.mesh.setOrder(1)
    return flats


def _plane_mesh(tag: int, origin: Floats, turn: Floats) -> PlaneMesh:
    tags, coordinates, _ = gmsh.model.mesh.getNodes(2, tag, includeBoundary=True)
    kinds, _, nodes = gmsh.model.mesh.getElements(2, tag)
    if list(kinds) != [10]:
        raise ValueError("the section of this prism could not be meshed with quadrilaterals alone")
    unique, first = np.unique(tags.astype(np.int64), return_index=True)
    cells = np.searchsorted(unique, nodes[0].astype(np.int64)).reshape(-1, 9)
    places = (np.asarray(coordinates, dtype=float).reshape(-1, 3)[first] - origin) @ turn[1:].T
    corners = places[cells[:, :3]]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # Drawn along x the first plane has to look back, so that the cells are right side out.
    other = [0, 3, 2, 1, 7, 6, 5, 4, 8]
    return PlaneMesh(places, np.where((twice > 0.0)[:, None], cells, cells[:, other]))
