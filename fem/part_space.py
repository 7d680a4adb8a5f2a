"""Displacement space of a part of several kinds of cells, curved or straight."""

import numpy as np

from fem.cells import nodal_slopes, reference
from fem.space import Space
from meshes.part import PartMesh
from meshes.solid import Floats, Ints, SolidMesh


def part_space(mesh: PartMesh) -> Space:
    """The space of a part; ValueError names how many cells are inside out.

    Cells of fewer nodes or points than others are filled up with functions and weights of zero.
    """
    parts = [_block(kind, mesh.points, cells) for kind, cells in mesh.blocks]
    nodes = max(g.shape[2] for g, _, _ in parts)
    points = max(g.shape[1] for g, _, _ in parts)
    gradients, weights, connectivity = [], [], []
    for g, w, c in parts:
        more_nodes, more_points = nodes - g.shape[2], points - g.shape[1]
        gradients.append(np.pad(g, ((0, 0), (0, more_points), (0, more_nodes), (0, 0))))
        weights.append(np.pad(w, ((0, 0), (0, more_points))))
        # The last node again: in rising order, and nothing is added to it.
        connectivity.append(np.pad(c, ((0, 0), (0, more_nodes)), mode="edge"))
    return Space(mesh, np.concatenate(gradients), np.concatenate(weights), np.concatenate(connectivity))


def layer_space(mesh: SolidMesh) -> Space:
    """The space of a mesh of one kind of cells, by the same functions; ValueError for cells that are inside out."""
    return Space(mesh, *_block(mesh.kind, mesh.points, mesh.cells))


def _block(kind: str, points: Floats, cells: Ints) -> tuple[Floats, Floats, Ints]:
    """Gradients (m, q, k, 3), weights (m, q) and nodes (m, k) in rising order."""
    ref = reference(kind)
    jacobian = np.einsum("mka,qkb->mqab", points[cells], ref.slopes)
    determinant = np.linalg.det(jacobian)
    if np.any(determinant <= 0.0):
        bad = int(np.count_nonzero((determinant <= 0.0).any(axis=1)))
        raise ValueError(f"{bad} of {len(cells)} cells of kind {kind} are inside out")
    gradients = np.einsum("qkb,mqba->mqka", ref.slopes, np.linalg.inv(jacobian))
    order = np.argsort(cells, axis=1)
    return (
        np.take_along_axis(gradients, order[:, None, :, None], axis=2),
        determinant * ref.weights,
        np.take_along_axis(cells, order, axis=1),
    )


def shape_quality(mesh: PartMesh) -> dict[str, float]:
    """`worst_cell`: smallest over largest Jacobian, at points and nodes, of the worst cell (1 is undistorted, 0 or less
    folds over); `longest_aspect`: longest over shortest edge of a cell's bounding box; `volume_mm3`."""
    worst, aspect, volume = 1.0, 1.0, 0.0
    for kind, cells in mesh.blocks:
        ref, corners = reference(kind), mesh.points[cells]
        inside = np.linalg.det(np.einsum("mka,qkb->mqab", corners, ref.slopes))
        there = np.linalg.det(np.einsum("mka,qkb->mqab", corners, nodal_slopes(kind)))
        every = np.concatenate((inside, there), axis=1)
        worst = min(worst, float(np.min(every.min(axis=1) / np.abs(every).max(axis=1))))
        extents = np.ptp(corners, axis=1)
        aspect = max(aspect, float(np.max(extents.max(axis=1) / extents.min(axis=1))))
        volume += float(np.sum(inside * ref.weights))
    return {"worst_cell": worst, "longest_aspect": aspect, "volume_mm3": volume}
