"""K_b by virtual experiments, a second route beside the rigid tie.

The tip face is free. Six unit wrenches are applied to it one after the other as tractions, the displacement field of
the face is fitted to a rigid motion by least squares over its area, and the compliance found is inverted.
Source: A. Pashkevich, A. Klimchik, D. Chablat, Ph. Wenger, Accuracy improvement for stiffness modeling of parallel
manipulators, 42nd CIRP Conference on Manufacturing Systems, 2009.

The tractions are the linear field t = B M⁻¹ F with the rigid motions B of the face and M = ∫ Bᵀ B dA. The fit
d = M⁻¹ ∫ Bᵀ u dA is then its dual, so that the compliance is symmetric.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.elasticity import stiffness_matrix
from fem.material import Isotropic
from fem.reduction import node_dofs
from fem.rigid_motions import rigid_motions
from fem.solvers import Solver, direct
from fem.space import Space
from meshes.discrete import discretise
from meshes.solid import Floats, SolidMesh


@dataclass(frozen=True)
class VirtualExperiments:
    """Result of the six experiments.

    stiffness : (6, 6) at the middle of the tip face, bar frame, N, mm, rad
    leftover  : (6,) for each unit wrench, the part of the face's displacement that is no rigid motion, as root
                mean square over the face relative to the whole displacement
    """

    stiffness: Floats
    leftover: Floats


def virtual_experiments(
    mesh: SolidMesh, length: float, material: Isotropic, solver: Solver = direct
) -> VirtualExperiments:
    """Identify K_b of a bar with its base face fixed; raises SolveError if the system cannot be solved."""
    discrete = discretise(mesh)
    stiffness = stiffness_matrix(Space.of(mesh), material)
    mass = sp.kron(discrete.face_mass(length), sp.eye(3), format="csr")
    motions = rigid_motions(mesh.points - np.array([length, 0.0, 0.0]))
    weighted = mass @ motions
    fit = np.linalg.solve(motions.T @ weighted, weighted.T)
    free = np.ones(mesh.dofs, dtype=bool)
    free[node_dofs(mesh.face_nodes("base"))] = False
    u = np.zeros((mesh.dofs, 6))
    u[free] = solver(stiffness[free][:, free])(fit.T[free])
    compliance = fit @ u
    rest = u - motions @ compliance
    leftover = np.sqrt(np.sum(rest * (mass @ rest), axis=0) / np.sum(u * (mass @ u), axis=0))
    inverse = np.linalg.inv(compliance)
    return VirtualExperiments(0.5 * (inverse + inverse.T), leftover)
