"""Whether a leg between held ends is determined: neither rigid in a direction nor moving without load.

Both are questions of rank, of how coordinates move the ends, and so do not depend on how stiff a spring is.
"""

from __future__ import annotations

import numpy as np

from vjm.frames import Array
from vjm.mechanism import rank

RIGID = "is rigid in some direction: nothing of it gives way there"
LOOSE = "has a part that moves without load while both ends of the leg are held"


def undetermined(jacobian: Array, free: np.ndarray) -> str:
    """What is wrong with a leg whose coordinates close its loops by a dimensionless Jacobian (m, n); "" if nothing is.

    The m closures are those at its end and of loops inside it. free: (n,) of bool, coordinates without a spring.
    A leg that is both rigid and loose is called rigid.
    """
    if rank(jacobian) < len(jacobian):
        return RIGID
    if rank(jacobian[:, free]) < int(np.sum(free)):
        return LOOSE
    return ""
