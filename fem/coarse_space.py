"""The linear elements inside the quadratic ones: a coarse space for multigrid on the same mesh.

Corner nodes keep their unknowns, a mid-edge node moves with the mean of its ends. Rigid faces move as they do in
the fine space, so that the six rigid motions of every part are in the coarse space exactly.
"""

import numpy as np
import scipy.sparse as sp

from fem.reduction import Reduction
from meshes.solid import EDGES, Ints, SolidMesh

TETRAHEDRON_EDGES = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])
CORNERS_AND_EDGES = {"hexahedron20": (8, EDGES), "tetra10": (4, TETRAHEDRON_EDGES)}


def linear_in_quadratic(mesh: SolidMesh) -> tuple[sp.csr_matrix, Ints]:
    """Sparse (nodes, corners) that gives node values from corner values, and the corners' node numbers.

    Raises ValueError for cells with nodes inside their faces.
    """
    if mesh.kind not in CORNERS_AND_EDGES:
        raise ValueError(f"cell kind is {mesh.kind!r}, allowed are {', '.join(CORNERS_AND_EDGES)}")
    count, edges = CORNERS_AND_EDGES[mesh.kind]
    corners = np.unique(mesh.cells[:, :count])
    number = np.zeros(len(mesh.points), dtype=np.int64)
    number[corners] = np.arange(len(corners))
    middle, first = np.unique(mesh.cells[:, count:], return_index=True)
    ends = mesh.cells[:, edges].reshape(-1, 2)[first]
    rows = np.concatenate((corners, middle, middle))
    columns = number[np.concatenate((corners, ends[:, 0], ends[:, 1]))]
    values = np.concatenate((np.ones(len(corners)), np.full(2 * len(middle), 0.5)))
    return sp.csr_matrix((values, (rows, columns)), shape=(len(mesh.points), len(corners))), corners


def prolongation(reduction: Reduction, free: Ints) -> sp.csr_matrix:
    """Sparse (m, c) from the c coarse unknowns to the unknowns `free` (m,) of a linkage at rest."""
    blocks, borders = [], []
    for index, member in enumerate(reduction.linkage.members):
        nodes, corners = linear_in_quadratic(member.space.mesh)
        whole = sp.kron(nodes, sp.eye(3), format="csr")[reduction.inner[index]]
        dofs = (3 * corners[:, None] + np.arange(3)).ravel()
        inside = np.isin(dofs, reduction.inner[index])
        outer = reduction.outer[index]
        order = np.argsort(outer)
        place = order[np.searchsorted(outer[order], dofs[~inside])]
        jacobian = reduction.face_jacobians(reduction.rest)[index][place]
        blocks.append(whole[:, inside])
        borders.append(whole[:, ~inside] @ sp.csr_matrix(jacobian))
    generalised = np.arange(reduction.starts[-1], reduction.size)
    kept = np.isin(generalised, free)
    below = sp.csr_matrix((reduction.generalised, sum(b.shape[1] for b in blocks)))
    fine = sp.vstack(
        (sp.hstack((sp.block_diag(blocks), sp.vstack(borders))), sp.hstack((below, sp.eye(len(kept)))))
    )
    columns = np.concatenate((np.ones(below.shape[1], dtype=bool), kept))
    return sp.csr_matrix(sp.csr_matrix(fine)[free][:, columns])
