"""A section meshed patch by patch and drawn along x as a sweep of hexahedra, without a mesh generator.

Every patch is a grid between its four edges (W. J. Gordon, C. A. Hall, Int. J. Numer. Meth. Engng 7 (1973) 461-477),
its numbers of elements those of `meshes.sweep`.
"""

from collections.abc import Sequence
from math import atan2, hypot, pi

import numpy as np

from meshes.layers import SAME_PLACE, SAME_THICKNESS, Layer, Sweep, SweptMesh, clusters, equal_thickness
from meshes.plane import PlaneMesh
from meshes.resolution import Resolution
from meshes.section import Patch, Point, Section
from meshes.solid import Floats, Ints, SolidMesh

# Local nodes of a nine-node quadrilateral on its three by three grid, (along u, along v).
QUAD9 = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1))
# Of a hexahedron drawn along x, meshio's order: plane (0 before, 1 between, 2 behind) and local node of the section.
BEFORE, BEHIND = [(0, k) for k in range(4)], [(2, k) for k in range(4)]
EDGES = [(0, k) for k in range(4, 8)] + [(2, k) for k in range(4, 8)] + [(1, k) for k in range(4)]
FACES = [(1, 7), (1, 5), (1, 4), (1, 6), (0, 8), (2, 8), (1, 8)]
DRAWN = {"hexahedron20": BEFORE + BEHIND + EDGES, "hexahedron27": BEFORE + BEHIND + EDGES + FACES}


def stepped_thickness(length: float, counts: Sequence[int]) -> Floats:
    """Thicknesses (n,) mm, thin at both ends: `counts[i]` layers at each end are 2^i times as thick as the first one.

    Equal layers in a row cost a chain of slices little more than one.
    """
    half = np.repeat(2.0 ** np.arange(len(counts)), counts)
    half *= length / (2.0 * half.sum())
    return np.concatenate((half, half[::-1]))


def kind_of(section: Section) -> str:
    """Twenty nodes where all edges are straight; a curved wall needs the full 27 to carry rigid motions exactly."""
    return "hexahedron27" if any(any(p.arcs) for p in section.patches()) else "hexahedron20"


def section_mesh(section: Section, resolution: Resolution) -> PlaneMesh:
    """Nine-node quadrilaterals in the section's plane, as many as `meshes.sweep` puts there."""
    patches = section.patches()
    counts = divisions(patches, resolution)
    points, cells, start = [], [], 0
    for patch, (along_u, along_v) in zip(patches, counts, strict=True):
        grid = patch_grid(patch, 2 * along_u + 1, 2 * along_v + 1)
        number = start + np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape[:2])
        corners = number[:-1:2, :-1:2].ravel()
        cells.append(np.stack([corners + i * grid.shape[1] + j for i, j in QUAD9], axis=1))
        points.append(grid.reshape(-1, 2))
        start += number.size
    everything = np.concatenate(points)
    near = SAME_PLACE * max(section.size)
    (across, y), (up, z) = (clusters(everything[:, a], near) for a in (0, 1))
    rows, merged = np.unique(np.stack((across, up), axis=1), axis=0, return_inverse=True)
    places = np.stack((y[rows[:, 0]], z[rows[:, 1]]), axis=1)
    return PlaneMesh(places, merged.ravel()[np.concatenate(cells)])


def divisions(patches: Sequence[Patch], resolution: Resolution) -> list[tuple[int, int]]:
    """Elements along the first and the second edge of every patch; opposite and shared edges have the same."""
    edges = [[edge_key(p, i) for i in range(4)] for p in patches]
    parent = {key: key for keys in edges for key in keys}

    def find(key: frozenset[Point]) -> frozenset[Point]:
        while parent[key] != key:
            key = parent[key]
        return key

    longest: dict[frozenset[Point], float] = {}
    for a, b, c, d in edges:
        parent[find(a)] = find(c)
        parent[find(b)] = find(d)
    for patch, keys in zip(patches, edges, strict=True):
        for i, key in enumerate(keys):
            longest[find(key)] = max(longest.get(find(key), 0.0), edge_length(patch, i))
    return [
        (resolution.across(longest[find(a)]), resolution.across(longest[find(b)])) for a, b, _, _ in edges
    ]


def edge_key(patch: Patch, i: int) -> frozenset[Point]:
    """The two ends of an edge, rounded so that neighbours name it alike."""
    ends = (patch.corners[i], patch.corners[(i + 1) % 4])
    return frozenset((round(y, 9) + 0.0, round(z, 9) + 0.0) for y, z in ends)


def edge_length(patch: Patch, i: int) -> float:
    """Length of an edge, mm."""
    (y0, z0), (y1, z1) = patch.corners[i], patch.corners[(i + 1) % 4]
    if not patch.arcs[i]:
        return hypot(y1 - y0, z1 - z0)
    return abs(turn_between((y0, z0), (y1, z1))) * hypot(y0, z0)


def turn_between(start: Point, end: Point) -> float:
    """Angle from one point to another about the origin, the shorter way, rad."""
    turn = atan2(end[1], end[0]) - atan2(start[1], start[0])
    return (turn + pi) % (2.0 * pi) - pi


def edge_points(patch: Patch, start: int, end: int, arc: bool, count: int) -> Floats:
    """`count` points evenly along an edge from one corner to another, (count, 2)."""
    a, b = patch.corners[start], patch.corners[end]
    t = np.linspace(0.0, 1.0, count)
    if not arc:
        return np.asarray((1.0 - t)[:, None] * a + t[:, None] * b)
    angle, radius = atan2(a[1], a[0]) + t * turn_between(a, b), hypot(*a)
    points = radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    points[0], points[-1] = a, b
    return np.asarray(points)


def patch_grid(patch: Patch, along_u: int, along_v: int) -> Floats:
    """Grid (m, n, 2) between the four edges, mm; u runs along the first edge at m places, v along the second at n."""
    near, far = (
        edge_points(patch, 0, 1, patch.arcs[0], along_u),
        edge_points(patch, 3, 2, patch.arcs[2], along_u),
    )
    left, right = (
        edge_points(patch, 0, 3, patch.arcs[3], along_v),
        edge_points(patch, 1, 2, patch.arcs[1], along_v),
    )
    u = np.linspace(0.0, 1.0, along_u)[:, None, None]
    v = np.linspace(0.0, 1.0, along_v)[None, :, None]
    a, b, c, d = (np.array(corner) for corner in patch.corners)
    bilinear = (1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d
    ruled = (1 - v) * near[:, None] + v * far[:, None] + (1 - u) * left[None] + u * right[None]
    return np.asarray(ruled - bilinear)


def drawn(plane: PlaneMesh, kind: str, thickness: Sequence[float]) -> Sweep:
    """The sweep of a plane mesh through layers of these thicknesses, mm."""
    steps = np.asarray(thickness, dtype=float)
    if not len(steps) or not np.all(steps > 0.0):
        raise ValueError("a layer's thickness is not above 0 mm, needed is one for each layer of the sweep")
    same = equal_thickness(steps, SAME_THICKNESS * float(np.sum(steps)))
    return Sweep((unit_extrusion(plane, kind),), np.zeros(len(steps), dtype=np.int64), same)


def unit_extrusion(plane: PlaneMesh, kind: str) -> Layer:
    """One layer, 1 mm thick: nodes of the plane before, those between, those behind."""
    faces, between, places, columns = face_numbers(plane, kind)
    first, middle = np.arange(len(faces)), len(faces) + np.arange(len(between))
    last = middle[-1] + 1 + first
    points = np.concatenate(
        [np.insert(places[rows], 0, x, axis=1) for x, rows in ((0.0, faces), (0.5, between), (1.0, faces))]
    )
    number = {0: np.searchsorted(faces, columns), 2: last[0] + np.searchsorted(faces, columns)}
    number[1] = middle[0] + np.searchsorted(between, columns)
    cells = np.stack([number[level][:, k] for level, k in DRAWN[kind]], axis=1)
    mesh = SolidMesh(points, cells, kind, {})
    return Layer(mesh, first, middle, last, places[faces], places[between], places[faces])


def face_numbers(plane: PlaneMesh, kind: str) -> tuple[Ints, Ints, Floats, Ints]:
    """Nodes on a plane, nodes between planes, places (n, 2) by y, then z, and the cells (m, 9) in that order."""
    order = np.lexsort((plane.points[:, 1], plane.points[:, 0]))
    rank = np.empty(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    cells = rank[plane.cells]
    full = kind == "hexahedron27"
    faces = np.unique(cells if full else cells[:, :8])
    between = np.unique(cells if full else cells[:, :4])
    return faces, between, plane.points[order], cells


def solid(plane: PlaneMesh, kind: str, thickness: Sequence[float]) -> SweptMesh:
    """The sweep with its solid mesh; the mesh has the faces base and tip."""
    sweep = drawn(plane, kind, thickness)
    layer, count = sweep.shapes[0], len(sweep.thickness)
    f, step = len(layer.first), len(layer.first) + len(layer.middle)
    stations = np.concatenate(([0.0], np.cumsum(sweep.thickness)))
    blocks = []
    for i in range(count):
        block = layer.mesh.points[:step].copy()
        block[:, 0] = stations[i] + block[:, 0] * sweep.thickness[i]
        blocks.append(block)
    blocks.append(np.insert(layer.first_places, 0, stations[-1], axis=1))
    cells = np.concatenate([layer.mesh.cells + i * step for i in range(count)])
    facets = face_facets(layer.mesh)
    faces = {"base": facets, "tip": facets + count * step}
    mesh = SolidMesh(np.concatenate(blocks), cells, kind, faces)
    planes = tuple(i * step + np.arange(f) for i in range(count + 1))
    middles = tuple(i * step + layer.middle for i in range(count))
    return SweptMesh(mesh, sweep, planes, middles)


def face_facets(mesh: SolidMesh) -> Ints:
    """Facets of a layer's first plane, (m, 8) or (m, 9)."""
    local = [0, 1, 2, 3, 8, 9, 10, 11] + ([24] if mesh.kind == "hexahedron27" else [])
    return np.asarray(mesh.cells[:, local])
