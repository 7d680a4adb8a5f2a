"""Nested quadrilaterals on a plane face of the open CAD model, mirror images of themselves where the face is one.

A chain of slices solves a section with two mirrors in four parts of a quarter of the unknowns: an eighth to a
sixteenth of the work. So a quarter (or a half) of the face is cut out, meshed and mirrored.
"""

from collections.abc import Sequence
from itertools import product
from math import ceil, pi

import gmsh
import numpy as np

from meshes.plane import GRID, PlaneMesh
from meshes.solid import Floats, Ints

# Of the face's area: what may stick out of its mirror image.
SAME_AREA = 1e-7
# Of the size of the face: a node nearer to a mirror stands on it.
ON_MIRROR = 1e-7
# Cells a turn of a curved wall.
AROUND = 12
# Of a piece of a curve: rounding, which makes no piece more.
EVEN = 1e-6
# Places on a curve at which its curvature is asked.
SAMPLES = 12
# Smallest over largest Jacobian of a cell that has a corner of nearly 180 degrees.
FLAT = 0.05
# gmsh's number of it, with four nodes.
QUADRILATERAL = 3
# Nodes of a nine-node quadrilateral seen from behind.
TURNED = [0, 3, 2, 1, 7, 6, 5, 4, 8]


def quadrilaterals(tag: int, origin: Floats, turn: Floats, size: float, levels: int = 2) -> list[PlaneMesh]:
    """Nested meshes of face `tag`, y and z about `origin` (3,) by the frame `turn` (3, 3), quads of about `size` mm.

    All else of the open model is used up. ValueError where the face cannot be meshed with quadrilaterals alone.
    """
    mirrors = [axis for axis in (1, 2) if _is_mirrored(tag, origin, turn[axis])]
    _leave_only(_part(tag, origin, turn, mirrors))
    option = gmsh.option.setNumber
    option("Mesh.RecombineAll", 1)
    option("Mesh.SecondOrderIncomplete", 0)
    option("Mesh.ElementOrder", 1)
    # As coarse as the section allows. Where triangles are left over each cell is parted into quadrilaterals; where a
    # curved wall folds cells over, more of them follow it.
    for finer, parted in product((1.0, 0.8, 0.65, 0.5, 0.25), (0, 1)):
        _divide(size * finer, AROUND / finer)
        option("Mesh.SubdivisionAlgorithm", parted)
        flats = _nested(origin, turn, mirrors, levels)
        if flats and min(worst_corner(flat) for flat in flats) > FLAT:
            return flats
    raise ValueError("the section of this prism could not be meshed with quadrilaterals alone")


def _nested(origin: Floats, turn: Floats, mirrors: Sequence[int], levels: int) -> list[PlaneMesh]:
    """Mesh after mesh, each cell parted in four; empty where the first has other cells than quadrilaterals."""
    gmsh.model.mesh.clear()
    gmsh.model.mesh.generate(2)
    if list(gmsh.model.mesh.getElements(2)[0]) != [QUADRILATERAL]:
        return []
    flats = []
    for level in range(levels):
        if level:
            gmsh.model.mesh.refine()
        gmsh.model.mesh.setOrder(2)
        flats.append(_plane_mesh(origin, turn, mirrors))
        gmsh.model.mesh.setOrder(1)
    return flats


def worst_corner(flat: PlaneMesh) -> float:
    """Smallest over largest Jacobian at the nodes of the worst cell: 1 undistorted, 0 or less folded over."""
    line = np.array([-1.0, 0.0, 1.0])
    one = np.stack((0.5 * line * (line - 1.0), 1.0 - line**2, 0.5 * line * (line + 1.0)))
    slope = np.stack((line - 0.5, -2.0 * line, line + 0.5))
    # Of node (a, b) of the grid at the place (c, d) of the grid: along u and along v.
    along = (np.einsum("ac,bd->abcd", slope, one), np.einsum("ac,bd->abcd", one, slope))
    grid = flat.points[flat.cells[:, GRID]].reshape(-1, 3, 3, 2)
    u, v = (np.einsum("mabx,abcd->mcdx", grid, each).reshape(-1, 9, 2) for each in along)
    jacobian = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return float((jacobian.min(axis=1) / np.abs(jacobian).max(axis=1)).min())


def _divide(size: float, around: float) -> None:
    """Every curve of the model into pieces of at most `size` mm, and of a curved one at most `around` a turn."""
    for _, curve in gmsh.model.getEntities(1):
        length = gmsh.model.occ.getMass(1, curve)
        (start,), (end,) = gmsh.model.getParametrizationBounds(1, curve)
        at = np.linspace(start, end, SAMPLES)
        turned = length * float(np.mean(gmsh.model.getCurvature(1, curve, at.tolist())))
        # Of a whole turn there is a part over, by rounding.
        pieces = max(ceil(length / size - EVEN), ceil(around * turned / (2.0 * pi) - EVEN), 1)
        gmsh.model.mesh.setTransfiniteCurve(curve, pieces + 1)


def _is_mirrored(tag: int, origin: Floats, normal: Floats) -> bool:
    """Whether the face is its own mirror image in the plane through `origin`."""
    occ = gmsh.model.occ
    image = occ.copy([(2, tag)])
    occ.mirror(image, *(float(v) for v in normal), float(-normal @ origin))
    beyond, _ = occ.cut(image, [(2, tag)], removeTool=False)
    left = sum(occ.getMass(*piece) for piece in beyond if piece[0] == 2)
    occ.remove(beyond, recursive=True)
    return bool(left < SAME_AREA * occ.getMass(2, tag))


def _part(tag: int, origin: Floats, turn: Floats, mirrors: Sequence[int]) -> list[tuple[int, int]]:
    """A copy of the face, or of the part of it that stands on the positive side of its mirrors."""
    occ = gmsh.model.occ
    whole: list[tuple[int, int]] = occ.copy([(2, tag)])
    if not mirrors:
        return whole
    low, high = np.array(occ.getBoundingBox(2, tag)).reshape(2, 3)
    far = 2.0 * float(np.linalg.norm(high - low))
    y, z = (0.0 if axis in mirrors else -far for axis in (1, 2))
    window = [(2, occ.addRectangle(y, z, 0.0, far - y, far - z))]
    # Its x and y become y and z of the bar, its normal x.
    columns = np.column_stack((turn[1], turn[2], turn[0], origin))
    occ.affineTransform(window, np.vstack((columns, [0.0, 0.0, 0.0, 1.0])).ravel().tolist())
    part, _ = occ.intersect(whole, window)
    return [piece for piece in part if piece[0] == 2]


def _leave_only(faces: Sequence[tuple[int, int]]) -> None:
    occ = gmsh.model.occ
    for dimension in (3, 2):
        occ.remove([e for e in occ.getEntities(dimension) if e not in faces], recursive=True)
    occ.synchronize()


def _plane_mesh(origin: Floats, turn: Floats, mirrors: Sequence[int]) -> PlaneMesh:
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, _, nodes = gmsh.model.mesh.getElements(2)
    used, cells = np.unique(nodes[0].astype(np.int64), return_inverse=True)
    order = np.argsort(tags.astype(np.int64))
    rows = order[np.searchsorted(tags[order].astype(np.int64), used)]
    places = (np.asarray(coordinates, dtype=float).reshape(-1, 3)[rows] - origin) @ turn[1:].T
    cells = cells.reshape(-1, 9)
    corners = places[cells[:, :3]]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    # Drawn along x the first plane has to look back, so that the cells are right side out.
    right = one[:, 0] * two[:, 1] > one[:, 1] * two[:, 0]
    return mirrored(PlaneMesh(places, np.where(right[:, None], cells, cells[:, TURNED])), mirrors)


def mirrored(part: PlaneMesh, mirrors: Sequence[int]) -> PlaneMesh:
    """The mesh of a part beside its mirror images; mirrors: 1 that at y = 0, 2 that at z = 0, or both.

    Nodes on a mirror are one with their image.
    """
    if not mirrors:
        return part
    places = part.points.copy()
    places[np.abs(places) < ON_MIRROR * np.abs(places).max()] = 0.0
    points: list[Floats] = []
    cells: list[Ints] = []
    for signs in product(*((1.0, -1.0) if axis in mirrors else (1.0,) for axis in (1, 2))):
        points.append(places * signs)
        own = part.cells if np.prod(signs) > 0.0 else part.cells[:, TURNED]
        cells.append(own + len(places) * len(cells))
    # Adding zero makes one of the two zeros there are.
    unique, number = np.unique(np.concatenate(points) + 0.0, axis=0, return_inverse=True)
    return PlaneMesh(unique, number.ravel()[np.concatenate(cells)].astype(np.int64))
