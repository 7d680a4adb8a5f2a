"""Which facets are the ends of a part: by name, plane or cylinder; and the list to choose from where nobody said it."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from meshes.facets import Cylinder, Plane, Surface, area_and_centre, fitted, on_surface, written
from meshes.facets import facet_normals as normals_of
from meshes.part import CORNERS
from meshes.solid import Floats, Ints

Facets = Mapping[str, Ints]
MOST_LISTED = 40
# A bore that goes less than this far round is half of one.
WHOLE_TURN = 1.5 * pi


@dataclass(frozen=True, eq=False)
class End:
    """One end. surface: None for a named set on no single plane or cylinder. at: (3,) mm, the point that it moves with.

    axis: (3,) unit, of its hinge; None where it is no cylinder. facets: by kind.
    """

    surface: Surface | None
    at: Floats
    axis: Floats | None
    area: float
    facets: Facets

    @property
    def said(self) -> str:
        """In words."""
        what = "a named set" if self.surface is None else self.surface.said
        return f"{what}, area {self.area:.6g} mm²"


@dataclass(frozen=True, eq=False)
class Outside:
    """The boundary of a part: points (n, 3) mm, all facets, those of named sets, and of each face of a CAD file."""

    points: Floats
    facets: Facets
    named: Mapping[str, Facets]
    faces: tuple[Facets, ...] = ()

    @property
    def size(self) -> float:
        """Diagonal of its box, mm."""
        nodes = np.unique(np.concatenate([f.ravel() for f in self.facets.values()]))
        return float(np.linalg.norm(np.ptp(self.points[nodes], axis=0)))


def end_of(outside: Outside, spec: Mapping[str, Any], which: str) -> End:
    """The end that a table names; ValueError says what is wrong, with the faces there are."""
    if "name" in spec:
        name = spec["name"]
        if name not in outside.named:
            known = ", ".join(outside.named) or "none"
            raise ValueError(f"{which}: no face or set is named {name!r}, named are: {known}")
        facets = outside.named[name]
        surface = surface_of(outside, facets)
    elif "plane" in spec:
        surface = _plane(spec, which)
        facets = on_surface(outside.points, outside.facets, surface, outside.size)
    else:
        surface = _cylinder(spec, which)
        facets = on_surface(outside.points, outside.facets, surface, outside.size)
    if not facets:
        raise ValueError(
            f"{which}: no face lies on the {surface.said if surface else 'set'}; {listing(outside)}"
        )
    return _end(outside, surface, facets, which)


def _plane(spec: Mapping[str, Any], which: str) -> Plane:
    normal = np.array(spec["normal"], dtype=float)
    if not np.linalg.norm(normal) > 0.0:
        raise ValueError(
            f"{which}: normal is {written(tuple(normal))}, allowed is a direction other than zero"
        )
    normal = normal / np.linalg.norm(normal)
    x, y, z = (float(v) for v in spec["plane"])
    return Plane((x, y, z), (float(normal[0]), float(normal[1]), float(normal[2])))


def _cylinder(spec: Mapping[str, Any], which: str) -> Cylinder:
    axis = np.array(spec["axis"], dtype=float)
    if not np.linalg.norm(axis) > 0.0:
        raise ValueError(f"{which}: axis is {written(tuple(axis))}, allowed is a direction other than zero")
    axis = axis / np.linalg.norm(axis)
    x, y, z = (float(v) for v in spec["cylinder"])
    return Cylinder((x, y, z), (float(axis[0]), float(axis[1]), float(axis[2])), float(spec["radius"]))


def surface_of(outside: Outside, facets: Facets) -> Surface | None:
    """The plane or cylinder that facets lie on."""
    nodes = np.unique(np.concatenate([f[:, : CORNERS[k]].ravel() for k, f in facets.items()]))
    normals = np.concatenate([normals_of(outside.points, f[:, : CORNERS[k]])[1] for k, f in facets.items()])
    return fitted(outside.points[nodes], normals, outside.size)


def _end(outside: Outside, surface: Surface | None, facets: Facets, which: str) -> End:
    area, centre, _ = area_and_centre(outside.points, facets)
    if not isinstance(surface, Cylinder):
        return End(surface, centre, None, area, facets)
    axis, at = np.array(surface.axis), np.array(surface.at)
    nodes = np.unique(np.concatenate([f.ravel() for f in facets.values()]))
    arm = outside.points[nodes] - at
    if (turn := turned_through(arm, axis)) < WHOLE_TURN:
        raise ValueError(
            f"{which}: the {surface.said} goes {np.degrees(turn):.0f} degrees round, allowed is a whole bore: this is "
            "a half model or an open bearing; mirror it, or name plane faces"
        )
    along = arm @ axis
    return End(surface, at + 0.5 * (along.min() + along.max()) * axis, axis, area, facets)


def turned_through(arm: Floats, axis: Floats) -> float:
    """Angle that points (n, 3) about an axis cover, rad: a full turn less the largest gap."""
    other = np.eye(3)[np.argmin(np.abs(axis))]
    first = np.cross(axis, other)
    first /= np.linalg.norm(first)
    angle = np.sort(np.arctan2(arm @ np.cross(axis, first), arm @ first))
    gaps = np.diff(np.concatenate((angle, [angle[0] + 2.0 * pi])))
    # Between two nodes of a whole turn there is a gap as well; twelve and more stand on one.
    largest = float(gaps.max())
    return 2.0 * pi if largest < 0.7 else 2.0 * pi - largest


def surfaces(outside: Outside) -> list[tuple[Surface | None, float, Floats]]:
    """Every plane and cylinder with its area in mm² and its centroid (3,) mm, largest first; other surfaces as None."""
    from meshes.facets import patches

    found: list[tuple[Surface | None, float, Floats]] = []
    seen: list[Surface] = []
    for patch in outside.faces or patches(outside.points, outside.facets):
        surface = surface_of(outside, patch)
        if surface is None:
            area, centre, _ = area_and_centre(outside.points, patch)
        elif any(_same(surface, other, outside.size) for other in seen):
            continue
        else:
            seen.append(surface)
            every = on_surface(outside.points, outside.facets, surface, outside.size)
            area, centre, _ = area_and_centre(outside.points, every or patch)
            if isinstance(surface, Plane):
                surface = Plane((float(centre[0]), float(centre[1]), float(centre[2])), surface.normal)
        found.append((surface, area, centre))
    return sorted(found, key=lambda each: -each[1])


def _same(a: Surface, b: Surface, size: float) -> bool:
    if isinstance(a, Plane) and isinstance(b, Plane):
        along = float(np.dot(a.normal, b.normal))
        return along > 1.0 - 1e-6 and float(b.distance(np.array([a.at]))[0]) < 1e-4 * size
    if isinstance(a, Cylinder) and isinstance(b, Cylinder):
        parallel = abs(float(np.dot(a.axis, b.axis))) > 1.0 - 1e-6
        arm = np.cross(np.subtract(a.at, b.at), b.axis)
        return (
            parallel and float(np.linalg.norm(arm)) < 1e-4 * size and abs(a.radius - b.radius) < 1e-4 * size
        )
    return False


def listing(outside: Outside) -> str:
    """The faces to choose from, one a line, each with the text that names it."""
    every = surfaces(outside)
    known = [it for it in every if it[0] is not None]
    lines = [
        f"  {surface.line}   # area {area:.5g} mm², centre {written((float(c[0]), float(c[1]), float(c[2])))}"
        for surface, area, c in known[:MOST_LISTED]
        if surface is not None
    ]
    lines += [f'  {{ name = "{name}" }}' for name in outside.named]
    if len(known) > MOST_LISTED:
        lines.append(f"  and {len(known) - MOST_LISTED} smaller ones")
    if len(known) < len(every):
        lines.append(f"  beside these {len(every) - len(known)} faces that are neither plane nor cylinder")
    return "\n".join(["write base = and tip = with one of:", *lines])
