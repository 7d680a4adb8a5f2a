"""Parts made cell by cell, without a mesher: a block of hexahedra or wedges, two materials, linear or quadratic."""

from __future__ import annotations

import numpy as np

from meshes.brought.ends import end_of
from meshes.brought.found import outside_of
from meshes.brought.raised import raised
from meshes.brought.raw import Raw
from meshes.part import PartMesh
from tests.meshes.brought.made import plane


def block(
    kind: str, counts: tuple[int, int, int] = (6, 1, 2), size: tuple[float, float, float] = (60, 6, 10)
) -> Raw:
    """A box along x of "hexahedron" or "wedge" cells, linear; region 1 beyond the middle of x."""
    axes = [np.linspace(0, s, n + 1) for s, n in zip(size, counts, strict=True)]
    axes[1] -= size[1] / 2
    axes[2] -= size[2] / 2
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape([n + 1 for n in counts])
    cells = []
    for i, j, k in np.ndindex(*counts):
        low = [number[i, j, k], number[i + 1, j, k], number[i + 1, j + 1, k], number[i, j + 1, k]]
        high = [
            number[i, j, k + 1],
            number[i + 1, j, k + 1],
            number[i + 1, j + 1, k + 1],
            number[i, j + 1, k + 1],
        ]
        if kind == "hexahedron":
            cells.append(low + high)
        else:
            cells += [[*low[:3], *high[:3]], [low[0], low[2], low[3], high[0], high[2], high[3]]]
    array = np.array(cells)
    region = (points[array][:, :, 0].mean(axis=1) > size[0] / 2).astype(np.int64)
    return Raw(points, ((kind, array),), region, ("left", "right"), {})


def mixed() -> Raw:
    """Hexahedra to the middle of x, wedges beyond it, node to node."""
    hexes, wedges = block("hexahedron"), block("wedge")
    left = hexes.region_of == 0
    right = wedges.region_of == 1
    blocks = (("hexahedron", hexes.blocks[0][1][left]), ("wedge", wedges.blocks[0][1][right]))
    region = np.concatenate((hexes.region_of[left], wedges.region_of[right]))
    return Raw(hexes.points, blocks, region, hexes.regions, {})


def part(raw: Raw, length: float = 60.0) -> PartMesh:
    """Quadratic, with its ends at x = 0 and x = length."""
    whole = raised(raw)
    outside = outside_of(whole)
    ends = {"base": plane(0, 0, 0), "tip": plane(length, 0, 0)}
    facets = {which: end_of(outside, spec, which).facets for which, spec in ends.items()}
    return PartMesh.of(whole.points, whole.blocks, whole.region_of, whole.regions, facets)
