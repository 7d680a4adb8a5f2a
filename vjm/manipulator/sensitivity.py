"""Derivative of a manipulator's readings by what its control prescribes."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from vjm.frames import Array
from vjm.manipulator.equilibrium import Loaded, channels, control_rows
from vjm.problem import held_mask


def by_targets(state: Loaded, held: Collection[str] = ()) -> Array:
    """(B, 12, 6) change of the readings of pose and load with the six targets, at converged states.

    numpy.linalg.LinAlgError in a critical state.
    """
    of, mask = state.system, held_mask(held)
    _, hessian, unit = control_rows(of, state.unknowns, mask)
    right = np.zeros((of.size, 6))
    right[of.platform] = np.diag(unit)
    change = np.linalg.solve(hessian * of.scale, np.broadcast_to(right, (len(hessian), *right.shape)))
    change = change * of.scale[:, None]
    load = np.sum([change[:, of.multiplier(k)] for k in range(len(of.legs))], axis=0)
    both = np.concatenate([change[:, of.platform], load], axis=1)
    return np.asarray(channels(of, state.unknowns).slope @ both)
