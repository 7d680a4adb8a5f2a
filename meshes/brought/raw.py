"""Cells as a file has them."""

from dataclasses import dataclass

from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class Raw:
    """Cells as a file has them, linear or quadratic, mm or not.

    points : (n, 3). blocks: kind and cells (m, k), meshio's orders. region_of: (all cells,) in the order of the blocks
    node_sets : named sets of nodes of the surface
    faces : of a CAD file, the corners (f, 3 | 4) of the facets of each of its faces
    remarks : what was read past, a sentence each
    """

    points: Floats
    blocks: tuple[tuple[str, Ints], ...]
    region_of: Ints
    regions: tuple[str, ...]
    node_sets: dict[str, Ints]
    remarks: tuple[str, ...] = ()
    faces: tuple[Ints, ...] = ()
