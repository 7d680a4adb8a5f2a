"""A CAD solid that is a prism between its two ends: its section meshed with quadrilaterals, to be swept."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, log2
from typing import Any

import gmsh
import numpy as np

from meshes.brought.drawn import Drawn
from meshes.brought.ends import End, Outside, end_of
from meshes.brought.face_mesh import AROUND, quadrilaterals
from meshes.brought.frame import bar_frame
from meshes.brought.of_gmsh import region_name
from meshes.extrusion import stepped_thickness
from meshes.facets import Plane
from meshes.solid import Ints

# Sine between a side's normal and the plane across the bar.
ALONG = 1e-6
# Of the mesh size: a layer at an end, where the stress varies, and how much thicker the next kind of layer is.
FIRST, LAYERS = 0.5, 2


@dataclass(frozen=True, eq=False)
class Swept:
    """The prism and its ends."""

    drawn: Drawn
    base: End
    tip: End


def swept(solids: Sequence[tuple[int, int]], asked: Mapping[str, Any], size: float) -> Swept | None:
    """Two nested levels of hexahedra, or None where the part is no prism between two plane ends that are one face each.

    The open model's mesh is used up, and the model too where it is a prism. ValueError for ends that are not there.
    """
    if len(solids) != 1 or any("plane" not in asked[which] for which in ("base", "tip")):
        return None
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", AROUND)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.model.mesh.generate(2)
    outside, faces = _surface()
    ends = [end_of(outside, asked[which], which) for which in ("base", "tip")]
    tags = [tag for end in ends if (tag := _face_of(end, faces)) is not None]
    if len(tags) < 2 or tags[0] == tags[1] or not _is_prism(ends, tags):
        return None
    base, tip = (_by_face(end, tag) for end, tag in zip(ends, tags, strict=True))
    frame = bar_frame(base.at, tip.at, (None, None), asked.get("y"))
    region = region_name(solids[0])
    flats = quadrilaterals(tags[0], base.at, frame.turn, size)
    kinds = max(1, ceil(log2(max(frame.length / (2 * LAYERS * FIRST * size), 1.0) + 1.0)))
    thickness = [stepped_thickness(frame.length, [LAYERS * 2**level] * kinds) for level in range(len(flats))]
    return Swept(Drawn(tuple(flats), tuple(thickness), base.at, frame.turn, region), base, tip)


def _by_face(end: End, tag: int) -> End:
    """The end with centroid and area of its CAD face, which its facets come near only."""
    at = np.array(gmsh.model.occ.getCenterOfMass(2, tag))
    return replace(end, at=at, area=float(gmsh.model.occ.getMass(2, tag)))


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
