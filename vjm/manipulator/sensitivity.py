"""Derivative of a manipulator's readings by what its control prescribes."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from vjm.frames import Array
from vjm.manipulator.equilibrium import Loaded, channels, control_rows
from vjm.problem import held_mask


def unknowns_by_targets(state: Loaded, held: Collection[str] = ()) -> Array:
    """(B, size, 6) change of the unknowns with the six targets, at converged states.

    numpy.linalg.LinAlgError in a critical state.
    """
    of, mask = state.system, held_mask(held)
    _, hessian, unit = control_rows(of, state.unknowns, mask)
    right = np.zeros((of.size, 6))
    right[of.platform] = np.diag(unit)
    change = np.linalg.solve(hessian * of.scale, np.broadcast_to(right, (len(hessian), *right.shape)))
    return np.asarray(change * of.scale[:, None])


def by_targets(state: Loaded, held: Collection[str] = ()) -> Array:
    """(B, 12, 6) change of the readings of pose and load with the six targets, as `unknowns_by_targets`."""
    return readings_along(state, unknowns_by_targets(state, held))


def readings_along(state: Loaded, change: Array) -> Array:
    """(B, 12, k) change of the readings of pose and load along changes of the unknowns (B, size, k)."""
    of = state.system
    load = np.sum([change[:, of.multiplier(k)] for k in range(len(of.legs))], axis=0)
    both = np.concatenate([change[:, of.platform], load], axis=1)
    return np.asarray(channels(of, state.unknowns).slope @ both)
