"""K_b of a mesh from the direct solver's displacements, by the strain energy at the integration points."""

from __future__ import annotations

import numpy as np

from fem.elasticity import stress
from fem.linear import LinearModel
from fem.linkage import PLATFORM
from meshes.solid import Floats


def by_strain_energy(model: LinearModel) -> Floats:
    """(6, 6) ∫ σ_i:ε_j dV over the bar for the six unit motions of its tip.

    Strains are differences of displacements, so that rigid parts of the motion leave no rounding: K26 = -K22 L/2 of a
    bar that is its own mirror image holds to 1e-15. The product uᵀ K u keeps it to 1e-8 where a layer is thin: entries
    of 1e7 N/mm, each rounded, cancel to 20 N/mm there.
    """
    motions = model.motions(PLATFORM, ())
    u = model.reduction.fields(motions, model.reduction.rest)[0]
    space = model.linkage.members[0].space
    sigma = [stress(space, model.material, column) for column in u.T]
    gradient = [space.displacement_gradient(column) for column in u.T]
    products = [[np.einsum("mqab,mqab,mq->", s, g, space.weights) for g in gradient] for s in sigma]
    return np.asarray(products)
