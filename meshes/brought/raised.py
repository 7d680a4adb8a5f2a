"""Linear cells raised to quadratic ones: a node in the middle of every edge."""

from dataclasses import replace

import numpy as np

from meshes.brought.raw import Raw
from meshes.solid import EDGES, Floats, Ints

RAISED = {"tetra": "tetra10", "hexahedron": "hexahedron20", "wedge": "wedge15"}
EDGES_OF: dict[str, Ints] = {
    "tetra": np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]]),
    "hexahedron": EDGES,
    "wedge": np.array([[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]]),
}
# Of an edge: a middle node farther than this from its middle is that of another edge.
ASTRAY = 0.35


def raised(raw: Raw) -> Raw:
    """The part with all cells quadratic, right side out, and their middle nodes on their edges.

    ValueError where linear and quadratic cells meet, which leaves gaps, or where nodes are in another order.
    """
    linear = [kind in RAISED for kind, _ in raw.blocks]
    if not any(linear):
        return replace(raw, blocks=tuple(_judged(raw.points, k, c) for k, c in raw.blocks))
    if not all(linear):
        kinds = ", ".join(kind for kind, _ in raw.blocks)
        raise ValueError(f"has linear and quadratic cells side by side ({kinds}), allowed is one order")
    edges = [np.sort(cells[:, EDGES_OF[kind]].reshape(-1, 2), axis=1) for kind, cells in raw.blocks]
    unique, numbers = np.unique(np.concatenate(edges), axis=0, return_inverse=True)
    middles = raw.points[unique].mean(axis=1)
    start, blocks, first = len(raw.points), [], 0
    for (kind, cells), own in zip(raw.blocks, edges, strict=True):
        number = numbers.ravel()[first : first + len(own)].reshape(len(cells), -1)
        blocks.append((RAISED[kind], np.concatenate((cells, start + number), axis=1)))
        first += len(own)
    points = np.concatenate((raw.points, middles))
    said = "its linear cells were raised to quadratic ones with straight edges"
    whole = tuple(_judged(points, kind, cells) for kind, cells in blocks)
    return replace(raw, points=points, blocks=whole, remarks=(*raw.remarks, said))


def _judged(points: Floats, kind: str, cells: Ints) -> tuple[str, Ints]:
    """The block; ValueError where middle nodes stand elsewhere than on their edges."""
    corner_kind = next(low for low, high in RAISED.items() if kind.startswith(high[:-2]))
    edges = EDGES_OF[corner_kind]
    corners = {"tetra": 4, "hexahedron": 8, "wedge": 6}[corner_kind]
    ends = points[cells[:, edges]]
    middle = points[cells[:, corners : corners + len(edges)]]
    length = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2)
    if np.any(length <= 0.0):
        raise ValueError(f"has {kind} cells with two nodes in one place")
    off = np.linalg.norm(middle - ends.mean(axis=2), axis=2) / length
    if off.max() > ASTRAY:
        raise ValueError(
            f"has {int((off.max(axis=1) > ASTRAY).sum())} {kind} cells with a middle node far from its edge: the nodes "
            "are in another order, or the mesh is damaged"
        )
    return kind, cells
