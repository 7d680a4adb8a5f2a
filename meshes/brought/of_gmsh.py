"""The mesh of the open gmsh model as plain arrays: cells by kind and region, named sets of facets."""

from collections.abc import Iterator
from typing import Any

import gmsh
import numpy as np

from meshes.brought.raw import Raw
from meshes.solid import Ints

# gmsh's number of each cell and facet, and its nodes in the order of meshio.
HEX20 = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]
KINDS: dict[int, tuple[str, list[int]]] = {
    4: ("tetra", list(range(4))),
    5: ("hexahedron", list(range(8))),
    6: ("wedge", list(range(6))),
    11: ("tetra10", [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
    12: ("hexahedron27", [*HEX20, 22, 23, 21, 24, 20, 25, 26]),
    17: ("hexahedron20", HEX20),
    18: ("wedge15", [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
}
OTHERS = {7: "5-node pyramids", 13: "18-node wedges", 14: "14-node pyramids", 19: "13-node pyramids"}


def raw_of_model(with_faces: bool = False) -> Raw:
    """All solid cells of the open model; ValueError where there are none, or some of a kind that is not taken.

    with_faces : whether its surfaces are faces of a CAD file, to be listed as such
    """
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    if not len(tags):
        raise ValueError("holds no nodes")
    number = np.full(int(tags.max()) + 1, -1, dtype=np.int64)
    number[tags.astype(np.int64)] = np.arange(len(tags))
    found: dict[str, list[tuple[Ints, int]]] = {}
    names: list[str] = []
    region_numbers: dict[str, int] = {}
    for entity in gmsh.model.getEntities(3):
        name = region_name(entity)
        if name not in region_numbers:
            region_numbers[name] = len(names)
            names.append(name)
        for kind, cells in _cells(entity, number):
            found.setdefault(kind, []).append((cells, region_numbers[name]))
    if not found:
        raise ValueError(_no_solids())
    blocks = tuple((kind, np.concatenate([c for c, _ in parts])) for kind, parts in found.items())
    regions = [np.full(len(c), r) for parts in found.values() for c, r in parts]
    points = np.asarray(coordinates, dtype=float).reshape(-1, 3)
    faces = tuple(_faces(number)) if with_faces else ()
    return Raw(points, blocks, np.concatenate(regions), tuple(names), dict(_named(number)), faces=faces)


def _faces(number: Ints) -> Iterator[Ints]:
    """Corners of the triangles of every surface."""
    for entity in gmsh.model.getEntities(2):
        for kind, nodes in zip(*gmsh.model.mesh.getElements(*entity)[::2], strict=True):
            _, _, _, count, _, corners = gmsh.model.mesh.getElementProperties(int(kind))
            if corners == 3:
                yield number[nodes.astype(np.int64)].reshape(-1, count)[:, :3]


def _cells(entity: tuple[int, int], number: Ints) -> Iterator[tuple[str, Ints]]:
    kinds, _, nodes = gmsh.model.mesh.getElements(*entity)
    for kind, own in zip(kinds, nodes, strict=True):
        if kind not in KINDS:
            said = OTHERS.get(int(kind)) or gmsh.model.mesh.getElementProperties(int(kind))[0]
            raise ValueError(
                f"holds {said}, allowed are tetrahedra, hexahedra and wedges, linear or quadratic"
            )
        name, order = KINDS[int(kind)]
        yield name, _places(own, number).reshape(-1, len(order))[:, order]


def _places(nodes: Any, number: Ints) -> Ints:
    """Places of nodes by their tags, -1 for one that is not there."""
    tags = np.asarray(nodes).astype(np.int64)
    return np.where(tags < len(number), number[np.minimum(tags, len(number) - 1)], -1)


def region_name(entity: tuple[int, int]) -> str:
    """Of a solid: that of its physical group, else its own, else its number."""
    for tag in gmsh.model.getPhysicalGroupsForEntity(*entity):
        if name := gmsh.model.getPhysicalName(3, int(tag)).strip():
            return str(name)
        return f"group {tag}"
    name = gmsh.model.getEntityName(*entity).split("/")[-1].strip()
    return name if name and "Open CASCADE" not in name else f"solid {entity[1]}"


def _named(number: Ints) -> Iterator[tuple[str, Ints]]:
    """Nodes of every named surface and group of surfaces."""
    groups: dict[str, list[int]] = {}
    for _, tag in gmsh.model.getPhysicalGroups(2):
        # MED fills its names up with blanks.
        name = gmsh.model.getPhysicalName(2, tag).strip() or f"group {tag}"
        groups.setdefault(name, []).extend(int(e) for e in gmsh.model.getEntitiesForPhysicalGroup(2, tag))
    for _, tag in gmsh.model.getEntities(2):
        if name := gmsh.model.getEntityName(2, tag).split("/")[-1].strip():
            groups.setdefault(name, []).append(tag)
    for name, entities in groups.items():
        parts: list[Any] = [gmsh.model.mesh.getElements(2, e)[2] for e in dict.fromkeys(entities)]
        nodes = [own for lists in parts for own in lists]
        if nodes:
            yield name, np.unique(number[np.concatenate(nodes).astype(np.int64)])


def _no_solids() -> str:
    _, tags, _ = gmsh.model.mesh.getElements(2)
    count = sum(len(t) for t in tags)
    if count:
        return f"holds {count} plane or shell elements and no solid ones, allowed are solids"
    return "holds no solid elements, allowed are tetrahedra, hexahedra and wedges"
