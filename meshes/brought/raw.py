"""Cells as a file has them."""

from dataclasses import dataclass

import numpy as np

from meshes.solid import Floats, Ints

NODES = {
    "tetra": 4,
    "tetra10": 10,
    "wedge": 6,
    "wedge15": 15,
    "hexahedron": 8,
    "hexahedron20": 20,
    "hexahedron27": 27,
}
"""Of every kind of cell that is taken."""


@dataclass(frozen=True, eq=False)
class Raw:
    """Cells as a file has them, linear or quadratic, mm or not.

    points : (n, 3). blocks: kind and cells (m, k), meshio's orders. region_of: (all cells,) in the order of the blocks
    node_sets : named sets of nodes of the surface
    faces : of a CAD file, the corners (f, 3 | 4) of the facets of each of its faces
    remarks : what was read past, a sentence each
    Raises ValueError for points that are no finite numbers, and for cells of points that are not there.
    """

    points: Floats
    blocks: tuple[tuple[str, Ints], ...]
    region_of: Ints
    regions: tuple[str, ...]
    node_sets: dict[str, Ints]
    remarks: tuple[str, ...] = ()
    faces: tuple[Ints, ...] = ()

    def __post_init__(self) -> None:
        if not np.isfinite(self.points).all():
            raise ValueError("has coordinates that are no finite numbers")
        for kind, cells in self.blocks:
            if (wrong := cells[(cells < 0) | (cells >= len(self.points))]).size:
                raise ValueError(
                    f"has {kind} cells of {wrong.size} nodes that are not in the file, which holds {len(self.points)}"
                )
