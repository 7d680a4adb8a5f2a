"""The paper's own iteration, Eq. 6: a second way to the equilibria that Newton's method finds."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from vjm.equilibrium import TOLERANCE, Equilibrium, posed, record
from vjm.frames import POSE_NAMES, Array
from vjm.mechanism import Mechanism
from vjm.newton import Step, dense, newton


def picard(
    mechanism: Mechanism,
    poses: ArrayLike,
    start: Equilibrium | None = None,
    tolerance: float = TOLERANCE,
    limit: int = 500,
) -> Equilibrium:
    """The paper's own iteration, Eq. 6 with its block matrix inverted (as printed it is not, and fails).

    poses: (..., 6). Each step linearises t = g but drops the Hessians of g, so this is a Picard iteration: it
    converges linearly, the slower the larger the load against the springs, and may diverge near or beyond a
    critical load. `equilibrium` is the safe choice there; both share residual and record. Laws beside the
    linear springs enter with their tangent.
    """
    problem, first, _, batch = posed(mechanism, poses, POSE_NAMES, start, None, None)
    place = problem.place
    weight = place.scale / place.energy
    parts = list(zip(mechanism.chains, place.coordinates, place.memories, strict=True))

    def without_hessians(unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
        rows, matrix = problem.whole(unknowns, members)
        for chain, x, past in parts:
            strain = unknowns[..., x] - chain.rest[chain.moving]
            matrix[..., x, x] = weight[x, None] * chain.respond(strain, problem.memory[members, past]).tangent
        return rows, dense(rows, matrix, place.scale)

    return record(
        problem, newton(without_hessians, first, place.scale, tolerance, limit, patience=limit), batch
    )
