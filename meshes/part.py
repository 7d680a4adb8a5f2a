"""A part as it was brought: quadratic cells of several kinds, regions, and named sets of its boundary's facets."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from meshes.solid import Floats, Ints, SolidMesh

# Local nodes of the facets of each kind of cell, meshio's order, outward; by the kind of facet.
FACETS: dict[str, dict[str, tuple[tuple[int, ...], ...]]] = {
    "tetra10": {
        "triangle6": ((0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 3, 2, 7, 9, 6))
    },
    "wedge15": {
        "triangle6": ((0, 2, 1, 8, 7, 6), (3, 4, 5, 9, 10, 11)),
        "quad8": ((0, 1, 4, 3, 6, 13, 9, 12), (1, 2, 5, 4, 7, 14, 10, 13), (2, 0, 3, 5, 8, 12, 11, 14)),
    },
    "hexahedron20": {
        "quad8": (
            (0, 3, 2, 1, 11, 10, 9, 8),
            (4, 5, 6, 7, 12, 13, 14, 15),
            (0, 1, 5, 4, 8, 17, 12, 16),
            (1, 2, 6, 5, 9, 18, 13, 17),
            (2, 3, 7, 6, 10, 19, 14, 18),
            (3, 0, 4, 7, 11, 16, 15, 19),
        )
    },
}
FACETS["hexahedron27"] = {
    "quad9": tuple(
        (*facet, middle)
        for facet, middle in zip(FACETS["hexahedron20"]["quad8"], (24, 25, 22, 21, 23, 20), strict=True)
    )
}
CORNERS = {"triangle6": 3, "quad8": 4, "quad9": 4}


@dataclass(frozen=True)
class PartMesh(SolidMesh):
    """A solid mesh of cells of one or several kinds.

    blocks  : cells (m, k) of each kind, meshio's names and orders
    region_of : (total cells,) number of each cell's region, in the order of the blocks
    regions : names of the regions
    facets  : named sets of boundary facets, (f, k) node numbers by their kind; `faces` has their nodes alone
    `cells` are those of a part of one kind, and none where there are several.
    """

    blocks: tuple[tuple[str, Ints], ...] = ()
    region_of: Ints = None  # type: ignore[assignment]
    regions: tuple[str, ...] = ()
    facets: Mapping[str, Mapping[str, Ints]] = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for array in (self.points, self.cells, self.region_of, *self.faces.values()):
            array.setflags(write=False)

    @staticmethod
    def of(
        points: Floats,
        blocks: tuple[tuple[str, Ints], ...],
        region_of: Ints,
        regions: tuple[str, ...],
        facets: Mapping[str, Mapping[str, Ints]],
    ) -> "PartMesh":
        """The mesh of these cells; nodes of no cell are dropped, all numbers follow."""
        used = np.unique(np.concatenate([cells.ravel() for _, cells in blocks]))
        number = np.full(len(points), -1, dtype=np.int64)
        number[used] = np.arange(len(used))
        own = tuple((kind, number[cells]) for kind, cells in blocks)
        named = {name: {kind: number[each] for kind, each in sets.items()} for name, sets in facets.items()}
        faces = {
            name: np.unique(np.concatenate([each.ravel() for each in sets.values()]))[:, None]
            for name, sets in named.items()
        }
        single = own[0][1] if len(own) == 1 else np.zeros((0, 1), dtype=np.int64)
        kind = "+".join(kind for kind, _ in own)
        return PartMesh(points[used], single, kind, faces, own, region_of, regions, named)

    @property
    def count(self) -> int:
        """Number of cells."""
        return sum(len(cells) for _, cells in self.blocks)

    def moved(self, displacement: Floats) -> SolidMesh:
        """The same mesh with its nodes moved by `displacement`, (n, 3) mm."""
        return self.placed(self.points + displacement)

    def placed(self, points: Floats) -> "PartMesh":
        """The same cells on other points (n, 3), mm."""
        return PartMesh(
            points, self.cells, self.kind, self.faces, self.blocks, self.region_of, self.regions, self.facets
        )

    def named(self, facets: Mapping[str, Mapping[str, Ints]]) -> "PartMesh":
        """The same cells with other named sets of facets."""
        return PartMesh.of(self.points, self.blocks, self.region_of, self.regions, facets)


def boundary(blocks: tuple[tuple[str, Ints], ...]) -> dict[str, Ints]:
    """Facets (f, k) of the outside by kind: those that one cell alone has.

    ValueError where more than two cells have one facet.
    """
    found: dict[str, list[Ints]] = {}
    for kind, cells in blocks:
        for facet_kind, local in FACETS[kind].items():
            found.setdefault(facet_kind, []).append(cells[:, np.array(local)].reshape(-1, len(local[0])))
    outside = {}
    for kind, parts in found.items():
        facets = np.concatenate(parts)
        _, first, counts = np.unique(
            np.sort(facets[:, : CORNERS[kind]], axis=1), axis=0, return_index=True, return_counts=True
        )
        if counts.max() > 2:
            raise ValueError("more than two cells share one facet: the mesh folds onto itself")
        outside[kind] = facets[np.sort(first[counts == 1])]
    return outside


def bodies(blocks: tuple[tuple[str, Ints], ...], points: int) -> Ints:
    """Number (n,) of the body that each of `points` nodes belongs to: cells (m, k) that share a node are one; -1:
    none."""
    import scipy.sparse as sp
    from scipy.sparse.csgraph import connected_components

    first = np.concatenate([np.repeat(cells[:, 0], cells.shape[1] - 1) for _, cells in blocks])
    others = np.concatenate([cells[:, 1:].ravel() for _, cells in blocks])
    graph = sp.coo_matrix((np.ones(len(first)), (first, others)), shape=(points, points))
    _, labels = connected_components(graph, directed=False)
    used = np.unique(np.concatenate((first, others)))
    out = np.full(points, -1, dtype=np.int64)
    out[used] = np.unique(labels[used], return_inverse=True)[1]
    return out
