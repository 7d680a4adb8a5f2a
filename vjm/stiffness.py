"""Cartesian 6x6 stiffness of a mechanism, at rest and under load (Eq. 10), and its closed form (Eq. 11)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from vjm import blocks, lagrangian
from vjm.equilibrium import Equilibrium, unloaded
from vjm.frames import Array, rotate_stiffness, rotation_y
from vjm.mechanism import ElasticChain, Mechanism
from vjm.stability import scaled_hessian


def eliminate(
    jacobian_theta: Array,
    jacobian_q: Array,
    stiffness: Array,
    hessian_theta: Array | float = 0.0,
    hessian_theta_q: Array | float = 0.0,
    hessian_q: Array | float = 0.0,
) -> Array:
    """Eq. 10: the block matrix over (lambda, q), inverted; its first 6x6 block (..., 6, 6).

    jacobian_theta (..., 6, v), jacobian_q (..., 6, p), stiffness (v, v), Hessians of Psi = g^T lambda:
    (..., v, v), (..., v, p), (..., p, p); zero at rest. The transposes that Eqs. 7 and 9 lack are in place.
    Rows and columns are equilibrated before the inversion, since mm and rad differ by orders of magnitude.
    numpy.linalg.LinAlgError where K - H_theta_theta or the block is singular: a critical state of the chain.
    """
    shape = (jacobian_theta.shape[-1], jacobian_q.shape[-1])
    hessian_theta_q = np.broadcast_to(hessian_theta_q, (*jacobian_q.shape[:-2], *shape))
    compliance = np.linalg.inv(stiffness - hessian_theta)
    flexibility = jacobian_theta @ compliance @ _transpose(jacobian_theta)
    mixed = jacobian_q + jacobian_theta @ compliance @ hessian_theta_q
    corner = hessian_q + _transpose(hessian_theta_q) @ compliance @ hessian_theta_q
    passive = mixed.shape[-1]
    block = np.zeros((*mixed.shape[:-2], 6 + passive, 6 + passive))
    block[..., :6, :6] = flexibility
    block[..., :6, 6:] = mixed
    block[..., 6:, :6] = _transpose(mixed)
    block[..., 6:, 6:] = corner
    scale = _equilibration(block)
    inverse = np.linalg.inv(scale[..., :, None] * block * scale[..., None, :])
    return (scale[..., :, None] * inverse * scale[..., None, :])[..., :6, :6]


def chain_stiffness(
    chain: ElasticChain,
    coordinates: ArrayLike,
    multiplier: ArrayLike | None = None,
    memory: Array | None = None,
) -> Array:
    """K_c (..., 6, 6) of one chain at coordinates (..., n) under the multiplier (..., 6), base frame.

    Conjugate to (p, rotation vector): delta lambda = K_c delta t, symmetric under load.
    multiplier None: unloaded. memory: (..., M) of its laws, default the initial one.
    """
    coordinates = np.asarray(coordinates, dtype=float)
    kinematics = chain.chain.kinematics(coordinates, 0.0 if multiplier is None else multiplier)
    strain = (coordinates - chain.rest)[..., chain.moving]
    past = chain.initial_memory if memory is None else memory
    past = np.broadcast_to(past, (*strain.shape[:-1], past.shape[-1]))
    tangent = np.zeros((*strain.shape[:-1], chain.chain.size, chain.chain.size))
    tangent[..., chain.moving[:, None], chain.moving] = chain.respond(strain, past).tangent
    tangent -= kinematics.hessian
    theta, q = chain.virtual, chain.passive
    return eliminate(
        kinematics.jacobian[..., theta],
        kinematics.jacobian[..., q],
        tangent[..., theta[:, None], theta],
        hessian_theta_q=-tangent[..., theta[:, None], q],
        hessian_q=-tangent[..., q[:, None], q],
    )


def stiffness_by_chain(state: Equilibrium) -> Array:
    """K_ci (..., chains, 6, 6) at an equilibrium, base frame, conjugate to the rotation vector.

    numpy.linalg.LinAlgError where a chain has none: it is rigid in some direction, or critical.
    """
    place, chains = lagrangian.layout(state.mechanism), state.mechanism.chains
    if any(chain.loops or chain.varying for chain in chains):
        flat = state.reshaped(state.converged.size)
        rows = lagrangian.all_rows(state.mechanism, flat.unknowns, flat.memory, flat.drives)
        found = blocks.chain_stiffnesses(state.mechanism, rows)
        return found.reshape(*state.converged.shape, *found.shape[1:])
    loads = np.moveaxis(state.multipliers, -2, 0)
    parts = zip(chains, state.coordinates, loads, place.memories, strict=True)
    return np.stack(
        [chain_stiffness(chain, x, dual, state.memory[..., past]) for chain, x, dual, past in parts], axis=-3
    )


def loaded_stiffness(state: Equilibrium, q: float = 0.0) -> Array:
    """K_c (..., 6, 6), the sum over the chains at an equilibrium, conjugate to the rotation vector.

    q: angle of the bar frame in which the matrix is written; 0 is the base frame.
    numpy.linalg.LinAlgError in a critical state with the platform held.
    """
    if any(chain.rigid for chain in state.mechanism.chains):
        return in_bar_frame(_of_the_whole(state), q)
    return in_bar_frame(np.sum(stiffness_by_chain(state), axis=-3), q)


def _of_the_whole(state: Equilibrium) -> Array:
    """(..., 6, 6) with all unknowns but the pose eliminated together, as no chain has a stiffness of its own."""
    place = lagrangian.layout(state.mechanism)
    scaled = scaled_hessian(state)
    pose = np.arange(place.size)[place.platform]
    inner = np.setdiff1d(np.arange(place.size), pose)
    mixed = scaled[..., inner[:, None], pose]
    # L is stationary in all but the pose, so its second derivative along the pose is the Schur complement.
    k = -_transpose(mixed) @ np.linalg.solve(scaled[..., inner[:, None], inner], mixed)
    k = k * place.load_scale[:, None] / place.pose_scale
    return np.asarray(0.5 * (k + _transpose(k)))


def read_stiffness(state: Equilibrium) -> Array:
    """(..., 6, 6) change of the load read with the pose read: `loaded_stiffness` seen through the sensors."""
    slope, k = state.seen.channels.slope, loaded_stiffness(state)
    pose = slope[..., :6, :6] + slope[..., :6, 6:] @ k
    load = slope[..., 6:, :6] + slope[..., 6:, 6:] @ k
    # load x pose^-1, from the right.
    return np.asarray(np.swapaxes(np.linalg.solve(_transpose(pose), _transpose(load)), -1, -2))


def unloaded_stiffness(mechanism: Mechanism, q: float = 0.0) -> Array:
    """K_c (6, 6) of the mechanism at rest, written in the bar frame of angle q (0: base frame)."""
    return loaded_stiffness(unloaded(mechanism), q)


def in_bar_frame(stiffness: ArrayLike, q: float) -> Array:
    """Components in the bar frame of a 6x6 (..., 6, 6) given in the base frame."""
    return rotate_stiffness(stiffness, rotation_y(q).T)


def closed_form(bar_stiffness: ArrayLike, width: float, q: float) -> Array:
    """K_p (6, 6) of the unloaded parallelogram, Eq. 11, in the *bar frame*; N, mm, rad.

    bar_stiffness: K_b (6, 6) at the tip with the two coupled blocks (26 and 35) only; other entries are not
    read. width: d, mm; q: rad. The length does not appear: K_b stands at the tip.
    """
    k = np.asarray(bar_stiffness, dtype=float)
    c, s = 0.5 * width * np.cos(q), 0.5 * width * np.sin(q)
    half = np.zeros((6, 6))
    half[0, 0], half[1, 1], half[1, 5] = k[0, 0], k[1, 1], k[1, 5]
    half[3, 3] = k[3, 3] + c * c * k[1, 1]
    half[3, 5] = c * s * k[1, 1]
    half[4, 4] = c * c * k[0, 0]
    half[5, 5] = k[5, 5] + s * s * k[1, 1]
    return 2.0 * (half + np.triu(half, 1).T)


def singular_values(stiffness: ArrayLike, length: float) -> Array:
    """Singular values (..., 6), N/mm, with rotations counted as arcs on the radius `length`, mm."""
    scale = np.repeat([1.0, 1.0 / length], 3)
    return np.linalg.svd(scale[:, None] * np.asarray(stiffness, dtype=float) * scale, compute_uv=False)


def rank(stiffness: ArrayLike, length: float, threshold: float = 1e-9) -> np.ndarray:
    """Number (...) of singular values above threshold x the largest, see `singular_values`."""
    values = singular_values(stiffness, length)
    return np.sum(values > threshold * values[..., :1], axis=-1)


def _transpose(a: Array) -> Array:
    return np.swapaxes(a, -1, -2)


def _equilibration(symmetric: Array) -> Array:
    """Positive s (..., n) such that the rows of s_i M_ij s_j have largest entries near 1.

    D. Ruiz, "A scaling algorithm to equilibrate both rows and columns norms in matrices", RAL-TR-2001-034.
    """
    scale = np.ones(symmetric.shape[:-1])
    for _ in range(8):
        scaled = scale[..., :, None] * symmetric * scale[..., None, :]
        scale = scale / np.sqrt(np.max(np.abs(scaled), axis=-1))
    return scale
