"""The Lagrange function of Eq. 4 with the platform pose among the unknowns: gradient and bordered Hessian.

Unknowns u, in this order: the moving coordinates (theta and q) of each chain, the platform pose t (6), the
multiplier lambda_i (6) of each chain. L = sum of elastic energies + sum lambda_i^T (t - g_i) - F^T t.
The gradient is Eq. 5 together with the platform's balance; its Hessian is symmetric, bordered by the loop
closures t = g_i. All arrays carry leading batch axes. Chains meet at the platform only, so Newton's step
needs no larger system than that of one chain (`chain_rows`, `newton_step`).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.mechanism import ElasticChain, Mechanism
from vjm.newton import negative_pivots, solve_each


@dataclass(frozen=True, eq=False)
class Layout:
    """Where each unknown stands in u, and its typical size.

    coordinates, multipliers, memories: one slice per chain, the last of the memory of the laws; platform:
    one slice.
    scale: (N,) size of each unknown: length for translations, 1 rad, stiffness x length for forces.
    energy: stiffness x length², N·mm, the size of L. scale_i scale_j H_ij / energy is dimensionless.
    """

    coordinates: tuple[slice, ...]
    platform: slice
    multipliers: tuple[slice, ...]
    memories: tuple[slice, ...]
    scale: Array
    energy: float

    @property
    def size(self) -> int:
        return self.scale.size

    @property
    def closures(self) -> int:
        """Number of scalar loop-closure equations: six per chain."""
        return 6 * len(self.multipliers)


def layout(mechanism: Mechanism) -> Layout:
    """Layout of u for a mechanism; its largest translational spring gives the unit of force."""
    sizes = [chain.moving.size for chain in mechanism.chains]
    pieces = _slices([*sizes, 6, *[6] * len(sizes)])
    memories = _slices([chain.initial_memory.size for chain in mechanism.chains])
    length = mechanism.length
    force = length * max(_translational_stiffness(chain) for chain in mechanism.chains)
    pose_scale = np.repeat([length, 1.0], 3)
    scales = [_coordinate_scale(chain, length) for chain in mechanism.chains]
    wrench_scale = force * np.repeat([1.0, length], 3)
    scale = np.concatenate([*scales, pose_scale, *[wrench_scale] * len(sizes)])
    n = len(sizes)
    return Layout(pieces[:n], pieces[n], pieces[n + 1 :], memories, scale, force * length)


def at_rest(mechanism: Mechanism) -> Array:
    """Unknowns (N,) of the unloaded mechanism."""
    coordinates = [chain.rest[chain.moving] for chain in mechanism.chains]
    return np.concatenate([*coordinates, mechanism.unloaded_pose, np.zeros(6 * len(coordinates))])


def chain_coordinates(chain: ElasticChain, moving: Array) -> Array:
    """All coordinates (..., n) of a chain from its moving ones (..., m); drives stand at rest."""
    full = np.broadcast_to(chain.rest, (*moving.shape[:-1], chain.chain.size)).copy()
    full[..., chain.moving] = moving
    return full


@dataclass(frozen=True, eq=False)
class ChainRows:
    """One chain's share of gradient and Hessian.

    balance: (..., m) by its coordinates. gap: (..., 6) t - g. matrix: (..., m + 6, m + 6) by its coordinates
    and its multiplier. order: (m + 6,) virtual coordinates, multiplier, passive coordinates: eliminated in
    this order the matrix at rest has no zero pivot.
    """

    balance: Array
    gap: Array
    matrix: Array
    order: np.ndarray


def chain_rows(
    chain: ElasticChain, moving: Array, pose: Array, multiplier: Array, memory: Array
) -> ChainRows:
    """Rows of a chain at its moving coordinates (..., m), the platform pose t and lambda (..., 6)."""
    kinematics = chain.chain.kinematics(chain_coordinates(chain, moving))
    jacobian, curvature = kinematics.jacobian, kinematics.hessian(multiplier)
    if chain.moving.size < chain.chain.size:
        jacobian = jacobian[..., chain.moving]
        curvature = curvature[..., chain.moving[:, None], chain.moving]
    answer = chain.respond(moving - chain.rest[chain.moving], memory)
    pull = np.einsum("...ji,...j->...i", jacobian, multiplier)
    m = chain.moving.size
    matrix = np.zeros((*moving.shape[:-1], m + 6, m + 6))
    matrix[..., :m, :m] = answer.tangent - curvature
    matrix[..., m:, :m] = -jacobian
    matrix[..., :m, m:] = -np.swapaxes(jacobian, -1, -2)
    return ChainRows(answer.force - pull, pose - kinematics.pose, matrix, chain.elimination_order)


def all_rows(mechanism: Mechanism, unknowns: Array, memory: Array) -> tuple[ChainRows, ...]:
    """`chain_rows` of every chain at unknowns (..., N), memory (..., M)."""
    place = layout(mechanism)
    parts = zip(mechanism.chains, place.coordinates, place.multipliers, place.memories, strict=True)
    pose = unknowns[..., place.platform]
    return tuple(
        chain_rows(chain, unknowns[..., x], pose, unknowns[..., dual], memory[..., past])
        for chain, x, dual, past in parts
    )


def gradient(place: Layout, rows: tuple[ChainRows, ...], unknowns: Array, wrench: ArrayLike) -> Array:
    """Gradient (..., N) of L under the external load wrench (..., 6), conjugate to (p, rotation vector)."""
    out = np.empty_like(unknowns)
    out[..., place.platform] = -np.asarray(wrench, dtype=float)
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        out[..., x], out[..., dual] = row.balance, row.gap
        out[..., place.platform] += unknowns[..., dual]
    return out


def hessian(place: Layout, rows: tuple[ChainRows, ...]) -> Array:
    """Hessian (..., N, N) of L."""
    out = np.zeros((*rows[0].gap.shape[:-1], place.size, place.size))
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        m = x.stop - x.start
        out[..., x, x] = row.matrix[..., :m, :m]
        out[..., dual, x] = row.matrix[..., m:, :m]
        out[..., x, dual] = row.matrix[..., :m, m:]
        out[..., dual, place.platform] = out[..., place.platform, dual] = np.eye(6)
    return out


@dataclass(frozen=True, eq=False)
class Solution:
    """step: (B, N, r) dimensionless. regular: (B,). stiffness: (B, 6, 6) dimensionless, the sum of Eq. 10."""

    step: Array
    regular: np.ndarray
    stiffness: Array


def newton_step(place: Layout, rows: tuple[ChainRows, ...], right: Array, held: np.ndarray) -> Solution:
    """Dimensionless solutions of H step = right, chain by chain.

    right: (B, N, r) dimensionless; where `held` (B, 6) is True the platform's row reads step = right instead.
    Each chain is solved for its own right side and for six unit motions of the platform, which leaves 6x6
    equations with the sum of the chains' stiffness (Eq. 10).
    """
    count = right.shape[-1]
    step = np.empty_like(right)
    platform = right[:, place.platform].copy()
    stiffness = np.zeros((len(right), 6, 6))
    regular = np.ones(len(right), dtype=bool)
    answers = []
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        m = x.stop - x.start
        sides = np.zeros((len(right), m + 6, count + 6))
        sides[:, :m, :count], sides[:, m:, :count] = right[:, x], right[:, dual]
        sides[:, m:, count:] = -np.eye(6)
        answer, solvable = solve_each(_dimensionless(place, row, x, dual), sides)
        platform -= np.where(held[..., None], 0.0, answer[:, m:, :count])
        stiffness += answer[:, m:, count:]
        regular &= solvable
        answers.append(answer)
    motion, solvable = solve_each(np.where(held[..., None], np.eye(6), stiffness), platform)
    step[:, place.platform] = motion
    for answer, x, dual in zip(answers, place.coordinates, place.multipliers, strict=True):
        m = x.stop - x.start
        whole = answer[..., :count] + answer[..., count:] @ motion
        step[:, x], step[:, dual] = whole[:, :m], whole[:, m:]
    return Solution(step, regular & solvable, stiffness)


def unstable_directions(
    place: Layout, rows: tuple[ChainRows, ...], stiffness: Array, held: np.ndarray, members: np.ndarray
) -> np.ndarray:
    """Number of unstable directions of these members, chain by chain.

    Inertia adds up over the elimination (E. V. Haynsworth, "Determination of the inertia of a partitioned
    Hermitian matrix", Linear Algebra and its Applications 1, 1968): what each chain's matrix has beyond the six
    negative eigenvalues of its closure, and what is left on the free platform coordinates.
    """
    count = np.zeros(members.size, dtype=int)
    if members.size == 0:
        return count
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        part = ChainRows(row.balance, row.gap, row.matrix[members], row.order)
        matrix = _dimensionless(place, part, x, dual)[:, row.order[:, None], row.order]
        count += negative_pivots(matrix) - 6
    free = ~held[members]
    both = free[:, :, None] & free[:, None, :]
    return count + negative_pivots(np.where(both, stiffness[members], np.eye(6)))


def _dimensionless(place: Layout, row: ChainRows, x: slice, dual: slice) -> Array:
    scale = np.concatenate([place.scale[x], place.scale[dual]])
    return row.matrix * np.outer(scale, scale / place.energy)


def _coordinate_scale(chain: ElasticChain, length: float) -> Array:
    joints = chain.chain.joints
    return np.array([length if joints[k].kind == "translation" else 1.0 for k in chain.moving])


def _translational_stiffness(chain: ElasticChain) -> float:
    joints = chain.chain.joints
    entries = zip(chain.virtual, np.diag(chain.stiffness), strict=True)
    return max((float(k) for j, k in entries if joints[j].kind == "translation"), default=1.0)


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    return tuple(slice(int(a), int(b)) for a, b in pairwise(np.cumsum([0, *sizes])))
