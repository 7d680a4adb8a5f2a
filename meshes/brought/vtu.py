"""Unstructured grids of VTK: solid cells, regions by the cell data "region", ends by planes and cylinders."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from meshes.brought.as_found import found_on_one_mesh
from meshes.brought.child import Arrays
from meshes.brought.raw import NODES, Raw
from meshes.solid import Floats, Ints

SUFFIXES = (".vtu",)
REGION = "region"
# VTK's numbers of solid cells, and of those of lower dimension, which are read past.
KIND_OF = {
    10: "tetra",
    12: "hexahedron",
    13: "wedge",
    24: "tetra10",
    25: "hexahedron20",
    26: "wedge15",
    29: "hexahedron27",
}
FLAT = {1, 3, 4, 5, 7, 8, 9, 21, 22, 23, 28}


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """In the child: the mesh at `asked["path"]` as it is; keys as in `meshes.brought.cad.work`."""
    import pyvista

    # VTK says what is wrong on the terminal and returns an empty grid.
    grid = pyvista.read(Path(asked["path"]))
    if not isinstance(grid, pyvista.UnstructuredGrid) or grid.n_cells == 0:
        raise ValueError("holds no cells, or is damaged")
    return found_on_one_mesh(raw_of(grid), asked)


def raw_of(grid: Any) -> Raw:
    """The solid cells of a grid; ValueError for other solids, or none."""
    types = np.asarray(grid.celltypes)
    if unknown := sorted({int(t) for t in types} - set(KIND_OF) - FLAT):
        raise ValueError(
            f"holds cells of VTK's kind {unknown[0]}, allowed are tetrahedra, hexahedra and wedges"
        )
    if not np.isin(types, list(KIND_OF)).any():
        raise ValueError(
            f"holds {len(types)} plane cells and no solid ones, allowed are solids: shells have no thickness"
        )
    data = grid.cell_data[REGION] if REGION in grid.cell_data else np.zeros(len(types), dtype=np.int64)
    values, numbers = np.unique(np.asarray(data)[np.isin(types, list(KIND_OF))], return_inverse=True)
    region_of = np.full(len(types), -1, dtype=np.int64)
    region_of[np.isin(types, list(KIND_OF))] = numbers.ravel()
    offsets, connectivity = np.asarray(grid.cell_offsets), np.asarray(grid.cell_connectivity)
    points = np.asarray(grid.points, dtype=float)
    blocks, regions = [], []
    for code, kind in KIND_OF.items():
        own = np.flatnonzero(types == code)
        if own.size:
            if (np.diff(offsets)[own] != NODES[kind]).any():
                raise ValueError(f"has {kind} cells of other than {NODES[kind]} nodes: it is damaged")
            cells = connectivity[offsets[own][:, None] + np.arange(NODES[kind])].astype(np.int64)
            blocks.append((kind, cells))
            regions.append(region_of[own])
    names = tuple(f"region {v:g}" for v in values)
    raw = Raw(points, tuple(blocks), np.concatenate(regions), names, {})
    # Of points that are known to be there.
    stood = ((kind, upright(points, own) if kind.startswith("wedge") else own) for kind, own in blocks)
    return replace(raw, blocks=tuple(stood))


def upright(points: Floats, cells: Ints) -> Ints:
    """Wedges (m, 6 | 15) with the triangle that looks inward first: of VTK's some writers have it the other way."""
    a, b, c, top = (points[cells[:, k]] for k in range(4))
    below = np.einsum("ij,ij->i", np.cross(b - a, c - a), top - a) < 0.0
    order = [3, 4, 5, 0, 1, 2, *([9, 10, 11, 6, 7, 8, 12, 13, 14] if cells.shape[1] == 15 else [])]
    return np.where(below[:, None], cells[:, order], cells)
