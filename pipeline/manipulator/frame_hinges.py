"""What a parallelogram with effects is for finite elements at rest: hinges that spring back, and what it lacks."""

import numpy as np
from numpy.typing import NDArray

from fem.frame.structure import FREE
from vjm.laws import Law, Linear
from vjm.link import Link

HINGE = 4
"""The axis of a hinge among the six of its frame: about y."""


def hinge_give(laws: tuple[Law, ...], more: float = 0.0) -> float:
    """rad/(N·mm) of one hinge about its axis: free, or linear springs in parallel. ValueError for another law.

    laws: of its turn. more: N·mm/rad of one that is not in the description.
    """
    stiffness = more
    for law in laws:
        if not isinstance(law, Linear):
            raise ValueError(f"finite elements at rest have no {type(law).__name__} in a hinge")
        stiffness += float(law.stiffness[0, 0])
    return 1.0 / stiffness if stiffness else FREE


def refuse(link: Link, drawn: float, line_load: NDArray[np.float64]) -> None:
    """ValueError for a bar whose state at rest is not that of a straight beam of the drawn length, mm.

    line_load: (3,) along it.
    """
    for give in (link.base_give, link.tip_give):
        if np.any(give != np.diag(np.diag(give))) or give[HINGE, HINGE]:
            raise ValueError("finite elements at rest have axes that give along and across themselves only")
    if np.any(line_load):
        raise ValueError("finite elements at rest have bars without weight")
    if link.length != drawn or link.slides or any(link.bow) or link.fibres is not None:
        raise ValueError("finite elements at rest have straight, linear bars of the drawn length")
