"""Stability of an equilibrium by the inertia of its loaded tangent.

The second variation of the energy decides over all motions that keep the loops closed and the held platform
coordinates fixed. Two routes give the same count: the bordered tangent [[H, C^T], [C, 0]], whose inertia is
that of the reduced tangent plus one negative and one positive eigenvalue per closure (N. I. M. Gould, "On
practical conditions for the existence and uniqueness of solutions to the general equality quadratic
programming problem", Mathematical Programming 32, 1985), and the reduced tangent Z^T H Z, Z spanning the null
space of C.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm import lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.problem import Held, held_mask


@dataclass(frozen=True, eq=False)
class Modes:
    """Spectrum of the reduced tangent, dimensionless (see `lagrangian.Layout`).

    values: (..., r) ascending. vectors: (..., N, r) in the units of the unknowns, multipliers zero; their
    dimensionless length is 1.
    """

    values: Array
    vectors: Array


def bordered_tangent(state: Equilibrium, held: Held) -> Array:
    """Symmetric dimensionless Hessian (..., M, M) of the Lagrange function without the held coordinates.

    held: the platform coordinates that do not move, x included if it is driven. Closures stand last.
    """
    free = _free(lagrangian.layout(state.mechanism), held)
    return scaled_hessian(state)[..., free[:, None], free]


def scaled_hessian(state: Equilibrium) -> Array:
    """Symmetric dimensionless Hessian (..., N, N) of the Lagrange function by all unknowns."""
    place = lagrangian.layout(state.mechanism)
    rows = lagrangian.all_rows(state.mechanism, state.unknowns, state.memory, state.drives)
    return place.scale[:, None] * lagrangian.hessian(place, rows) * place.scale / place.energy


def negative_eigenvalues(state: Equilibrium, held: Held) -> np.ndarray:
    """Number (...) of unstable directions: negatives of the bordered tangent less those the closures bring.

    Each chain closes with six equations t = g_i, and six for each loop inside it, whose gradients are independent
    (springs, or motions of the platform, reach every one), so that they bring exactly as many negatives: twelve for a
    parallelogram of two chains.
    Held coordinates are left out and bring none.
    """
    values = np.linalg.eigvalsh(bordered_tangent(state, held))
    return np.sum(values < 0, axis=-1) - lagrangian.layout(state.mechanism).closures


def reduced_modes(state: Equilibrium, held: Held) -> Modes:
    """Eigenvalues and vectors of the tangent on the motions that keep all loops closed; where a law has no
    numbers for its tangent, values that are none and vectors without meaning."""
    place = lagrangian.layout(state.mechanism)
    free = _free(place, held)
    tangent = bordered_tangent(state, held)
    there = np.asarray(np.isfinite(tangent).all(axis=(-2, -1), keepdims=True))
    tangent = np.where(there, tangent, 0.0)
    motions = free.size - place.closures
    closure = tangent[..., motions:, :motions]
    basis = np.swapaxes(np.linalg.svd(closure)[2], -1, -2)[..., place.closures :]
    values, vectors = np.linalg.eigh(np.swapaxes(basis, -1, -2) @ tangent[..., :motions, :motions] @ basis)
    full = np.zeros((*values.shape[:-1], place.size, values.shape[-1]))
    full[..., free[:motions], :] = basis @ vectors
    return Modes(np.where(there[..., 0], values, np.nan), full * place.scale[:, None])


def _free(place: lagrangian.Layout, held: Held) -> np.ndarray:
    pinned = np.arange(place.size)[place.platform][held_mask(held)]
    return np.setdiff1d(np.arange(place.size), pinned)
