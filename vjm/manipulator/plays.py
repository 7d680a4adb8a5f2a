"""How hard the stops of the plays of a manipulator are pressed."""

from __future__ import annotations

import numpy as np

from vjm.clearance import Clearance
from vjm.frames import Array
from vjm.manipulator.equilibrium import Loaded


def pressed(state: Loaded, change: Array) -> tuple[Array, Array]:
    """Forces (B, K), N, as of `vjm.slides.pressed`, and their changes (B, K, k) along those of the unknowns (B, size,
    k)."""
    of = state.system
    forces, slopes = [], []
    for k, leg in enumerate(of.legs):
        strain = of.full(k, state.unknowns) - of.rest[k]
        for spring in leg.springs:
            if not isinstance(spring.law, Clearance):
                continue
            (number,) = spring.coordinates
            at = of.coordinates[k].start + int(np.searchsorted(leg.moving, number))
            force, slope = spring.law.pressed(strain[:, number])
            forces.append(force)
            slopes.append(slope[:, None] * change[:, at])
    if not forces:
        return np.zeros((len(change), 0)), np.zeros((len(change), 0, change.shape[-1]))
    return np.stack(forces, axis=1), np.stack(slopes, axis=1)
