"""Hexahedra swept along the bar: patches extruded by gmsh's OpenCASCADE kernel and meshed transfinitely."""

from dataclasses import dataclass

import gmsh

from meshes.bar import Bar, Zone
from meshes.resolution import Resolution
from meshes.section import Patch

Curve = int


def build_swept(bar: Bar, resolution: Resolution) -> None:
    """Fill the open gmsh model with the meshed bar and the physical groups body, base, tip and side."""
    solids = [solid for zone in bar.zones() for solid in extrude_zone(zone)]
    if len(solids) > 1:
        gmsh.model.occ.fragment(solids[:1], solids[1:])
    gmsh.model.occ.synchronize()
    divide_curves(bar, resolution)
    for _, surface in gmsh.model.getEntities(2):
        gmsh.model.mesh.setTransfiniteSurface(surface)
        gmsh.model.mesh.setRecombine(2, surface)
    for _, volume in gmsh.model.getEntities(3):
        gmsh.model.mesh.setTransfiniteVolume(volume)
    name_faces(bar.length)
    # Twenty nodes where all edges are straight; a curved wall needs the full 27 to carry rigid motions exactly.
    curved = any(any(p.arcs) for p in bar.section.patches())
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 0 if curved else 1)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)


def extrude_zone(zone: Zone) -> list[tuple[int, int]]:
    """One solid for each patch of the zone, as gmsh (dimension, tag) pairs."""
    solids: list[tuple[int, int]] = []
    for patch in zone.patches:
        surface = add_patch(patch, zone.start)
        made = gmsh.model.occ.extrude([(2, surface)], zone.end - zone.start, 0.0, 0.0)
        solids.extend(entity for entity in made if entity[0] == 3)
    return solids


def add_patch(patch: Patch, x: float) -> int:
    """The patch as a plane surface at `x`; returns its tag."""
    occ = gmsh.model.occ
    points = [occ.addPoint(x, y, z) for y, z in patch.corners]
    centre = occ.addPoint(x, 0.0, 0.0) if any(patch.arcs) else None
    curves = []
    for i, arc in enumerate(patch.arcs):
        start, end = points[i], points[(i + 1) % 4]
        curves.append(occ.addCircleArc(start, centre, end) if arc else occ.addLine(start, end))
    surface = occ.addPlaneSurface([occ.addCurveLoop(curves)])
    if centre is not None:
        occ.remove([(0, centre)])
    return int(surface)


@dataclass(frozen=True)
class CurveEnds:
    """Where a curve starts and ends along the bar, mm, and how long it is."""

    start: float
    end: float
    length: float

    @property
    def runs_along(self) -> bool:
        return abs(self.end - self.start) > 0.5 * self.length


def measure(curve: Curve) -> CurveEnds:
    """Ends and length of a curve of the open gmsh model."""
    _, points = gmsh.model.getAdjacencies(1, curve)
    start, end = (gmsh.model.getValue(0, point, [])[0] for point in points)
    return CurveEnds(start, end, gmsh.model.occ.getMass(1, curve))


def divide_curves(bar: Bar, resolution: Resolution) -> None:
    """Set the number and grading of elements on every curve; opposite edges of a face get the same."""
    ends = {curve: measure(curve) for _, curve in gmsh.model.getEntities(1)}
    leader = opposite_edges(list(ends))
    longest: dict[Curve, float] = {}
    for curve, e in ends.items():
        longest[leader[curve]] = max(longest.get(leader[curve], 0.0), e.length)
    grading = {(z.start, z.end): z.graded_to for z in bar.zones()}
    for curve, e in ends.items():
        count, ratio = resolution.across(longest[leader[curve]]), 1.0
        if e.runs_along:
            low, high = sorted((e.start, e.end))
            graded_to = next(g for (s, t), g in grading.items() if abs(s - low) + abs(t - high) < 1e-6)
            if graded_to is not None:
                # Half the whole bar, so that a longer lug moves the elements but never changes their number.
                count, ratio = resolution.along(bar.length / 2)
                grows = (graded_to == "start") == (e.start < e.end)
                ratio = ratio if grows else 1.0 / ratio
        gmsh.model.mesh.setTransfiniteCurve(curve, count + 1, "Progression", ratio)


def opposite_edges(curves: list[Curve]) -> dict[Curve, Curve]:
    """For every curve the representative of all curves that must carry the same number of elements."""
    parent = {c: c for c in curves}

    def find(c: Curve) -> Curve:
        while parent[c] != c:
            c = parent[c]
        return c

    for surface in gmsh.model.getEntities(2):
        a, b, c, d = (
            abs(tag) for _, tag in gmsh.model.getBoundary([surface], combined=False, oriented=False)
        )
        parent[find(a)] = find(c)
        parent[find(b)] = find(d)
    return {c: find(c) for c in curves}


def name_faces(length: float) -> None:
    """Physical groups: the volumes as "body", the outer surfaces as "base" (x = 0), "tip" (x = length), "side"."""
    volumes = gmsh.model.getEntities(3)
    gmsh.model.addPhysicalGroup(3, [tag for _, tag in volumes], name="body")
    groups: dict[str, list[int]] = {"base": [], "tip": [], "side": []}
    for _, surface in gmsh.model.getBoundary(volumes, combined=True, oriented=False):
        x0, _, _, x1, _, _ = gmsh.model.getBoundingBox(2, surface)
        at_base, at_tip = x1 < 1e-3, x0 > length - 1e-3
        groups["base" if at_base else "tip" if at_tip else "side"].append(surface)
    for name, tags in groups.items():
        gmsh.model.addPhysicalGroup(2, tags, name=name)
