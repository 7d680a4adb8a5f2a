"""Surfaces of a brought part as planes and cylinders, and the facets that lie on them."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from meshes.part import CORNERS
from meshes.solid import Floats, Ints

# Of the part's size: how near a node is to a surface that it lies on.
ON = 3e-5
# Cosine between the normal of a facet and that of the surface that it is part of: a facet of a face beside it whose
# corners all stand on the common edge is none.
ALONG = 0.7
# Normals of a plane differ by rounding. A cylinder has five numbers, and fits a few points whatever they are.
FLAT, FEWEST = 1e-4, 8


@dataclass(frozen=True)
class Plane:
    """All of the part's surface in one plane: a point `at` (3,) mm, unit `normal` outward."""

    at: tuple[float, float, float]
    normal: tuple[float, float, float]

    @property
    def line(self) -> str:
        """As a case writes it."""
        return f"{{ plane = {written(self.at)}, normal = {written(self.normal)} }}"

    @property
    def said(self) -> str:
        return f"plane through {written(self.at)}, normal {written(self.normal)}"

    def distance(self, points: Floats) -> Floats:
        """(n,) mm from the surface."""
        return np.asarray(np.abs((points - np.array(self.at)) @ np.array(self.normal)))

    def normals(self, points: Floats) -> Floats:
        """(n, 3) unit normals at points, of either sign."""
        return np.broadcast_to(np.array(self.normal), points.shape)


@dataclass(frozen=True)
class Cylinder:
    """All of the part's surface on one cylinder: a point `at` (3,) mm of its axis, unit `axis`, `radius` mm."""

    at: tuple[float, float, float]
    axis: tuple[float, float, float]
    radius: float

    @property
    def line(self) -> str:
        """As a case writes it."""
        return f"{{ cylinder = {written(self.at)}, axis = {written(self.axis)}, radius = {self.radius:.6g} }}"

    @property
    def said(self) -> str:
        return f"cylinder about {written(self.at)} along {written(self.axis)}, radius {self.radius:.6g} mm"

    def distance(self, points: Floats) -> Floats:
        """(n,) mm from the surface."""
        arm = points - np.array(self.at)
        axis = np.array(self.axis)
        across = arm - (arm @ axis)[:, None] * axis
        return np.asarray(np.abs(np.linalg.norm(across, axis=1) - self.radius))

    def normals(self, points: Floats) -> Floats:
        """(n, 3) unit normals at points, of either sign."""
        arm = points - np.array(self.at)
        axis = np.array(self.axis)
        across = arm - (arm @ axis)[:, None] * axis
        return np.asarray(across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None])


Surface = Plane | Cylinder


def written(values: tuple[float, ...]) -> str:
    """Numbers as a list, without digits that rounding made."""
    return "[" + ", ".join(f"{round(v, 6) + 0.0:.8g}" for v in values) + "]"


def triple(values: Floats) -> tuple[float, float, float]:
    """Three plain numbers of an array (3,)."""
    x, y, z = (float(v) for v in values)
    return x, y, z


def fitted(points: Floats, normals: Floats, size: float) -> Surface | None:
    """The plane or cylinder of points (n, 3) mm, corners of facets with normals (f, 3); None for another surface.

    size : of the part, mm
    """
    mean = normals.mean(axis=0)
    if np.linalg.norm(mean) > 0.5 and np.abs(normals - mean / np.linalg.norm(mean)).max() < FLAT:
        return Plane(triple(points.mean(axis=0)), triple(mean / np.linalg.norm(mean)))
    if len(points) < FEWEST or (found := _cylinder(points, normals)) is None:
        return None
    at, axis, radius = found
    arm = points - at
    along = arm @ axis
    off = np.abs(np.linalg.norm(arm - along[:, None] * axis, axis=1) - radius)
    if not 0.0 < radius < size or off.max() > ON * size:
        return None
    axis = axis if axis[np.argmax(np.abs(axis))] > 0 else -axis
    along = arm @ axis
    return Cylinder(triple(at + 0.5 * (along.min() + along.max()) * axis), triple(axis), radius)


def _cylinder(points: Floats, normals: Floats) -> tuple[Floats, Floats, float] | None:
    """Point of the axis, its direction and the radius, least squares of the distances; None where that fails."""
    from scipy.optimize import least_squares

    _, _, rows = np.linalg.svd(normals, full_matrices=False)
    across, middle = rows[:2], points.mean(axis=0)
    flat = (points - middle) @ across.T
    # |p|² = 2 p·c + (r² - |c|²)
    system = np.column_stack((2.0 * flat, np.ones(len(flat))))
    start = np.linalg.lstsq(system, np.sum(flat**2, axis=1), rcond=None)[0]
    radius = float(np.sqrt(max(start[2] + start[:2] @ start[:2], 0.0)))
    if not np.isfinite(radius) or radius <= 0.0:
        return None

    def placed(x: Floats) -> tuple[Floats, Floats]:
        axis = rows[2] + x[:2] @ across
        return middle + radius * (x[2:4] @ across), axis / np.linalg.norm(axis)

    def off(x: Floats) -> Floats:
        at, axis = placed(x)
        arm = points - at
        return np.asarray(np.linalg.norm(arm - (arm @ axis)[:, None] * axis, axis=1) / radius - x[4])

    first = np.concatenate(([0.0, 0.0], start[:2] / radius, [1.0]))
    found = least_squares(off, first, method="lm", xtol=1e-14, ftol=1e-14, gtol=1e-14)
    at, axis = placed(found.x)
    return at, axis, float(found.x[4] * radius)


def on_surface(
    points: Floats, facets: Mapping[str, Ints], surface: Surface, size: float, near: float = ON
) -> dict[str, Ints]:
    """The facets of the boundary all of whose corners lie on a surface, and that stand along it.

    points: (n, 3) mm. facets: numbers (m, k) of nodes by their kind. size: mm, of the part.
    """
    close = surface.distance(points) < near * size
    found = {}
    for kind, own in facets.items():
        corners = own[:, : CORNERS[kind]]
        there = np.flatnonzero(close[corners].all(axis=1))
        centres, normals, _ = facet_normals(points, corners[there])
        along = np.abs(np.einsum("ij,ij->i", normals, surface.normals(centres)))
        if (kept := there[along > ALONG]).size:
            found[kind] = own[kept]
    return found


def facet_normals(points: Floats, facets: Ints) -> tuple[Floats, Floats, Floats]:
    """Centres (f, 3), unit normals outward (f, 3) and areas (f,) of facets by their corners, three or four of them."""
    corners = points[facets]
    if facets.shape[1] == 3:
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    else:
        cross = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    twice = np.linalg.norm(cross, axis=1)
    safe = np.where(twice > 0.0, twice, 1.0)
    return corners.mean(axis=1), cross / safe[:, None], 0.5 * twice


def area_and_centre(points: Floats, facets: Mapping[str, Ints]) -> tuple[float, Floats, Floats]:
    """Area in mm², centroid (3,) mm and area-weighted mean of the unit normals (3,), by corners."""
    area, centre, normal = 0.0, np.zeros(3), np.zeros(3)
    for kind, own in facets.items():
        centres, normals, areas = facet_normals(points, own[:, : CORNERS[kind]])
        area += float(areas.sum())
        centre = centre + areas @ centres
        normal = normal + areas @ normals
    return area, centre / area, normal / area


def patches(points: Floats, facets: Mapping[str, Ints], angle: float = 0.6) -> list[dict[str, Ints]]:
    """The boundary parted along its edges: facets whose normals differ by less than `angle`, rad, hang together.

    points: (n, 3). facets: numbers (m, k) of nodes by their kind.
    """
    import scipy.sparse as sp
    from scipy.sparse.csgraph import connected_components

    kinds = list(facets)
    normals = np.concatenate([facet_normals(points, facets[k][:, : CORNERS[k]])[1] for k in kinds])
    edges, owner, start = [], [], 0
    for kind in kinds:
        own, n = facets[kind], CORNERS[kind]
        for i in range(n):
            edges.append(np.sort(own[:, [i, (i + 1) % n]], axis=1))
            owner.append(start + np.arange(len(own)))
        start += len(own)
    edge, facet = np.concatenate(edges), np.concatenate(owner)
    order = np.lexsort(edge.T)
    same = np.all(edge[order][1:] == edge[order][:-1], axis=1)
    a, b = facet[order][:-1][same], facet[order][1:][same]
    smooth = np.einsum("ij,ij->i", normals[a], normals[b]) > np.cos(angle)
    graph = sp.coo_matrix((np.ones(int(smooth.sum())), (a[smooth], b[smooth])), shape=(start, start))
    count, label = connected_components(graph, directed=False)
    bounds = np.cumsum([0, *(len(facets[k]) for k in kinds)])
    spans = list(zip(kinds, bounds[:-1], bounds[1:], strict=True))
    parts = [{k: facets[k][label[s:e] == n] for k, s, e in spans} for n in range(count)]
    return [{k: v for k, v in part.items() if len(v)} for part in parts]
