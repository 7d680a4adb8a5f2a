"""A sweep: layers of cells between planes across the bar, each layer one section drawn along x."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise

import numpy as np

from meshes.solid import Floats, Ints, SolidMesh

# Of the bar's length: nodes and planes closer than this are one, thicknesses closer than that are equal.
SAME_PLACE, SAME_THICKNESS = 1e-7, 1e-12


@dataclass(frozen=True, eq=False)
class Layer:
    """One layer of cells, 1 mm thick, and where its nodes are.

    mesh   : the layer alone, from x = 0 to x = 1 mm
    first, last : (f,) and (g,) node of `mesh` at each place of the plane before and behind; -1 for a place that only
             the neighbouring layer has, where two sections meet
    middle : (m,) nodes between the planes
    first_places, middle_places, last_places : (f, 2), (m, 2) and (g, 2) y and z of them, mm
    """

    mesh: SolidMesh
    first: Ints
    middle: Ints
    last: Ints
    first_places: Floats
    middle_places: Floats
    last_places: Floats

    @property
    def even(self) -> bool:
        """Whether the planes before and behind have the same places, all of them the layer's own."""
        whole = np.all(self.first >= 0) and np.all(self.last >= 0)
        return bool(whole) and np.array_equal(self.first_places, self.last_places)


@dataclass(frozen=True)
class Run:
    """`count` layers in a row, the first of them layer number `start`, all of one shape and thickness (mm)."""

    shape: int
    thickness: float
    start: int
    count: int


@dataclass(frozen=True, eq=False)
class Sweep:
    """Layers from the base face to the tip face.

    shapes    : the different layers, each 1 mm thick
    shape_of  : (n,) number of every layer's shape
    thickness : (n,) mm; equal layers have exactly equal ones
    """

    shapes: tuple[Layer, ...]
    shape_of: Ints
    thickness: Floats

    @property
    def length(self) -> float:
        return float(np.sum(self.thickness))

    @property
    def dofs(self) -> int:
        """Displacement unknowns of the whole mesh."""
        layers = [self.shapes[s] for s in self.shape_of]
        return 3 * (len(layers[0].first) + sum(len(x.middle) + len(x.last) for x in layers))

    def runs(self) -> Iterator[Run]:
        """Equal layers in a row, base first."""
        start = 0
        for (shape, thickness), group in groupby(zip(self.shape_of, self.thickness, strict=True)):
            count = len(list(group))
            yield Run(int(shape), float(thickness), start, count)
            start += count


@dataclass(frozen=True, eq=False)
class SweptMesh:
    """A solid mesh that is a sweep.

    planes  : for each of the n + 1 planes, base first, the mesh's nodes in the order of the layers' places
    middles : for each of the n layers, the mesh's nodes between its planes, in the order of the layer's places
    """

    mesh: SolidMesh
    sweep: Sweep
    planes: tuple[Ints, ...]
    middles: tuple[Ints, ...]


def as_sweep(mesh: SolidMesh) -> SweptMesh:
    """The layers of a mesh; ValueError says why it is no sweep along x from the face "base" to the face "tip"."""
    if mesh.kind not in ("hexahedron20", "hexahedron27"):
        raise ValueError(f"the mesh is no sweep: its cells are {mesh.kind}, needed are hexahedra")
    x = mesh.points[:, 0]
    length = float(np.ptp(x))
    near = SAME_PLACE * length
    ends = np.stack((x[mesh.cells].min(axis=1), x[mesh.cells].max(axis=1)), axis=1)
    station, stations = clusters(ends.ravel(), near)
    station = station.reshape(-1, 2)
    layer_of = station[:, 0]
    if np.any(station[:, 1] != layer_of + 1):
        raise ValueError("the mesh is no sweep: a cell reaches over a plane that other cells end at")
    plane = np.clip(np.searchsorted(stations, x - near), 0, len(stations) - 1)
    on_plane = np.abs(stations[plane] - x) <= near
    half_way = 0.5 * (stations[plane - 1] + stations[plane])
    if np.any(np.abs(half_way - x)[~on_plane] > near):
        raise ValueError("the mesh is no sweep: a node stands neither on a plane nor half-way between two")
    # Rows of nodes along the bar, told by y and z alone.
    (across, _), (up, _) = (clusters(mesh.points[:, a], near) for a in (1, 2))
    row = np.unique(np.stack((across, up), axis=1), axis=0, return_inverse=True)[1].ravel()
    order = np.lexsort((row, 2 * plane - ~on_plane))
    where = (2 * plane - ~on_plane)[order]
    bounds = np.searchsorted(where, np.arange(2 * len(stations)))
    slots = tuple(order[a:b] for a, b in pairwise(bounds))
    require_ends(mesh, slots)
    thickness = equal_thickness(np.diff(stations), SAME_THICKNESS * length)
    cells = np.split(mesh.cells[np.argsort(layer_of, kind="stable")], np.cumsum(np.bincount(layer_of))[:-1])
    shapes, shape_of = layer_shapes(mesh, row, slots, cells)
    return SweptMesh(mesh, Sweep(shapes, shape_of, thickness), slots[0::2], slots[1::2])


def require_ends(mesh: SolidMesh, slots: tuple[Ints, ...]) -> None:
    """Raise ValueError unless the faces base and tip are the first and the last plane; slots: nodes (m,) of each
    plane and layer."""
    for name, nodes in (("base", slots[0]), ("tip", slots[-1])):
        if not np.array_equal(mesh.face_nodes(name), np.sort(nodes)):
            raise ValueError(f"the mesh is no sweep: its face {name!r} is not the whole plane at that end")


def layer_shapes(
    mesh: SolidMesh, row: Ints, slots: tuple[Ints, ...], cells: list[Ints]
) -> tuple[tuple[Layer, ...], Ints]:
    """The different layers and the number of each layer's shape; ValueError where a layer is not drawn along x.

    row   : (n,) number of the line along the bar that each node stands on
    slots : nodes (m,) of plane, layer, plane, layer, .. plane, each in the order of `row`
    cells : numbers (c, k) of nodes of each layer
    """
    shapes: list[Layer] = []
    known: dict[bytes, int] = {}
    shape_of = np.empty(len(cells), dtype=np.int64)
    for number, block in enumerate(cells):
        parts = slots[2 * number : 2 * number + 3]
        key = signature(row, parts, block)
        if key not in known:
            known[key] = len(shapes)
            shapes.append(unit_layer(mesh, row, parts, block))
        shape_of[number] = known[key]
    return tuple(shapes), shape_of


def signature(row: Ints, parts: tuple[Ints, ...], cells: Ints) -> bytes:
    """Equal for layers that differ in their place along x, their thickness and their numbering only; row (n,),
    nodes (m,) of each of the parts and cells (c, k) as for `layer_shapes`."""
    level = np.zeros(len(row), dtype=np.int64)
    for number, nodes in enumerate(parts):
        level[nodes] = number
    bodies = np.sort(3 * row[cells] + level[cells], axis=1)
    bodies = bodies[np.lexsort(bodies.T[::-1])]
    head = np.array([len(nodes) for nodes in parts])
    return b"".join(a.tobytes() for a in (head, *(row[nodes] for nodes in parts), bodies))


def unit_layer(mesh: SolidMesh, row: Ints, parts: tuple[Ints, ...], cells: Ints) -> Layer:
    """The layer of these cells (c, k), 1 mm thick; row (n,) and nodes (m,) of each of the parts as for
    `layer_shapes`."""
    used = np.unique(cells)
    number = np.full(len(mesh.points), -1, dtype=np.int64)
    number[used] = np.arange(len(used))
    points = mesh.points[used].copy()
    for level, nodes in zip((0.0, 0.5, 1.0), parts, strict=True):
        points[number[nodes[number[nodes] >= 0]], 0] = level
    levels = np.full(len(mesh.points), 1)
    levels[parts[0]], levels[parts[2]] = 0, 2
    before, behind = (np.sort(np.where(levels[cells] == side, row[cells], -1), axis=1) for side in (0, 2))
    if not np.array_equal(before, behind) or not np.all(np.isin(row[parts[1]], row[parts[0]])):
        raise ValueError("the mesh is no sweep: a layer's two planes are not alike")
    # Exactly drawn along x: the places of the first plane count for all.
    first = {int(r): n for r, n in zip(row[parts[0]], parts[0], strict=True)}
    for nodes in parts[1:]:
        own = nodes[number[nodes] >= 0]
        points[number[own], 1:] = mesh.points[[first[int(r)] for r in row[own]], 1:]
    unit = SolidMesh(points, number[cells], mesh.kind, {})
    places = [mesh.points[nodes, 1:] for nodes in parts]
    if len(parts[0]) == len(parts[2]) and np.array_equal(row[parts[0]], row[parts[2]]):
        places[2] = places[0]
    first_nodes, middle_nodes, last_nodes = (number[nodes] for nodes in parts)
    return Layer(unit, first_nodes, middle_nodes, last_nodes, *places)


def clusters(values: Floats, near: float) -> tuple[Ints, Floats]:
    """Number (n,) of each value's group, in rising order, and the groups' first values; a gap above `near` parts."""
    order = np.argsort(values, kind="stable")
    ordered = values[order]
    new = np.concatenate(([True], np.diff(ordered) > near))
    group = np.empty(len(values), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    return group, ordered[new]


def equal_thickness(thickness: Floats, near: float) -> Floats:
    """Thicknesses (n,) with those of one group made exactly equal, to their mean."""
    group, _ = clusters(thickness, near)
    means = np.bincount(group, thickness) / np.bincount(group)
    return np.asarray(means[group])
