"""The stressed state of a linkage and its geometric stiffness."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.elasticity import geometric_stiffness_matrix, internal_forces, stress
from fem.linear import LinearModel
from fem.linkage import PLATFORM
from fem.solvers import Factor
from meshes.solid import Floats


@dataclass(frozen=True, eq=False)
class Prestress:
    """A state of small displacements and what it adds to the stiffness.

    displacements : node displacements (dofs,) of each member in its own frame, mm
    wrench        : (6,) exerted on the platform at its point, base frame, N and N·mm
    geometric     : geometric stiffness in the linkage's unknowns, sparse symmetric
    """

    displacements: tuple[Floats, ...]
    wrench: Floats
    geometric: sp.csr_matrix


def prestress(
    model: LinearModel, driven: str, held: Sequence[str], factor: Factor | None = None
) -> Prestress:
    """Drive one platform coordinate by a unit, mm or rad, with the `held` ones at zero and the rest free of load.

    `factor` as in `LinearModel.motions`.
    """
    return stressed(model, model.motions([driven], held, factor)[:, 0])


def stressed(model: LinearModel, motion: Floats) -> Prestress:
    """The state of a small `motion` (size,) of all unknowns."""
    r = model.reduction
    fields = r.fields(motion, r.rest)
    sigmas = [stress(m.space, model.material, u) for m, u in zip(model.linkage.members, fields, strict=True)]
    kg = [geometric_stiffness_matrix(m.space, s) for m, s in zip(model.linkage.members, sigmas, strict=True)]
    nodal = [internal_forces(m.space, s) for m, s in zip(model.linkage.members, sigmas, strict=True)]
    geometric = r.reduce(kg, r.rest, r.curvature(nodal, r.rest))
    wrench = np.asarray(model.reduced @ motion)[r.platform(PLATFORM)]
    return Prestress(fields, wrench, geometric)
