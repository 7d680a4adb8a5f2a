"""K_b with loads distributed over deformable end faces: what RBE3 elements do in other programs.

The motion of an end is the rigid motion nearest to that of its face, least squares over the area; its loads are the
dual of that fit (`fem.virtual_experiments` does so at the tip of a clamped bar). Both ends do so here: a wrench at the
tip and what balances it at the base need no support but six displacements that hold the body still.
"""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
import scipy.linalg as sl
import scipy.sparse as sp

from fem.cells import reference
from fem.coarse_space import CORNERS_AND_EDGES, linear_in_quadratic
from fem.rigid_motions import rigid_motions
from fem.solvers import Solver, automatic
from meshes.part import PartMesh
from meshes.solid import Floats, Ints


def distributed_stiffness(
    mesh: PartMesh,
    stiffness: sp.csr_matrix,
    facets: tuple[Mapping[str, Ints], Mapping[str, Ints]],
    points: tuple[Floats, Floats],
    solver: Solver = automatic,
) -> Floats:
    """(6, 6) stiffness at the tip point against the base point, frame of the mesh, N, mm, rad.

    stiffness : (dofs, dofs) of the whole mesh, nothing held
    facets : those of base and tip, by kind
    points : (3,) base point and tip point, mm
    Raises SolveError if the system cannot be solved.
    """
    base, tip = (fit(mesh.points, own, at) for own, at in zip(facets, points, strict=True))
    # A motion of the base point as the tip point follows it, and a wrench at the tip as the base has to balance it.
    carried = np.eye(6)
    carried[:3] = rigid_motions((points[1] - points[0])[None])
    loads = tip.T - base.T @ carried.T
    free = np.ones(mesh.dofs, dtype=bool)
    free[still(mesh.points)] = False
    u = np.zeros((mesh.dofs, 6))
    coarse = (lambda: corners(mesh, free)) if mesh.kind in CORNERS_AND_EDGES else None
    u[free] = solver(stiffness[free][:, free], coarse)(loads[free])
    compliance = loads.T @ u
    inverse = np.linalg.inv(0.5 * (compliance + compliance.T))
    return np.asarray(0.5 * (inverse + inverse.T))


def corners(mesh: PartMesh, free: npt.NDArray[np.bool_]) -> sp.csr_matrix:
    """Sparse (m, c): displacements `free` (dofs,), m of them, of a motion of the c corners, linear between these."""
    nodes, _ = linear_in_quadratic(mesh)
    return sp.csr_matrix(sp.kron(nodes, sp.eye(3), format="csr")[free])


def fit(points: Floats, facets: Mapping[str, Ints], at: Floats) -> Floats:
    """(6, 3 n): the rigid motion about a point (3,) nearest to displacements (3 n,) of the facets' nodes.

    ValueError where the facets lie on a line or a point, which can hold no rigid motion.
    """
    mass = sp.kron(facet_mass(points, facets), sp.eye(3), format="csr")
    motions = rigid_motions(points - at)
    weighted = mass @ motions
    gram = motions.T @ weighted
    scale = np.sqrt(np.diag(gram))
    if scale.min() <= 0.0 or np.linalg.cond(gram / np.outer(scale, scale)) > 1e10:
        raise ValueError("the facets of an end hold no rigid motion: they have no area")
    return np.asarray(np.linalg.solve(gram, weighted.T))


def facet_mass(points: Floats, facets: Mapping[str, Ints]) -> sp.csr_matrix:
    """∫ N_i N_j dA over facets, sparse (n, n), mm²."""
    total = sp.csr_matrix((len(points), len(points)))
    for kind, own in facets.items():
        ref = reference(kind)
        tangents = np.einsum("fka,qkb->fqab", points[own], ref.slopes)
        area = np.linalg.norm(np.cross(tangents[..., 0], tangents[..., 1]), axis=-1) * ref.weights
        local = np.einsum("fq,qi,qj->fij", area, ref.values, ref.values)
        rows = np.broadcast_to(own[:, :, None], local.shape)
        columns = np.broadcast_to(own[:, None, :], local.shape)
        total = total + sp.coo_matrix((local.ravel(), (rows.ravel(), columns.ravel())), total.shape)
    return total.tocsr()


def still(points: Floats) -> Ints:
    """Six displacements that hold a body of these points (n, 3) still without a reaction to balanced loads."""
    centred = points - points.mean(axis=0)
    motions = rigid_motions(centred / np.abs(centred).max())
    _, _, order = sl.qr(motions.T, mode="economic", pivoting=True)
    return np.sort(order[:6])
