"""The Lagrange function of Eq. 4 with the platform pose among the unknowns: gradient and bordered Hessian.

Unknowns u, in this order: the moving coordinates (theta and q) of each chain, the platform pose t (6), the
multiplier lambda_i (6) of each chain. L = sum of elastic energies + sum lambda_i^T (t - g_i) - F^T t.
The gradient is Eq. 5 together with the platform's balance; its Hessian is symmetric, bordered by the loop
closures t = g_i. All arrays carry leading batch axes. Chains meet at the platform only, so Newton's step
needs no larger system than that of one chain (`chain_rows`, `newton_step`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from vjm.frames import Array
from vjm.mechanism import ElasticChain, Mechanism
from vjm.newton import negative_pivots, solve_each
from vjm.work import note


@dataclass(frozen=True, eq=False)
class Layout:
    """Where each unknown stands in u, and its typical size.

    coordinates, multipliers, memories: one slice per chain, the last of the memory of the laws; platform:
    one slice.
    scale: (N,) size of each unknown: length for translations, 1 rad, stiffness x length for forces.
    energy: stiffness x length², N·mm, the size of L. scale_i scale_j H_ij / energy is dimensionless.
    drives: names of the D inputs; defaults: (D,) their values; rest_slopes: (D, n) per chain.
    posture: (D,) mask of the inputs with which gauges are zeroed.
    """

    coordinates: tuple[slice, ...]
    platform: slice
    multipliers: tuple[slice, ...]
    memories: tuple[slice, ...]
    scale: Array
    energy: float
    drives: tuple[str, ...]
    defaults: Array
    rest_slopes: tuple[Array, ...]
    posture: np.ndarray

    @property
    def size(self) -> int:
        return self.scale.size

    @property
    def closures(self) -> int:
        """Number of scalar loop-closure equations: six per chain."""
        return 6 * len(self.multipliers)

    @property
    def pose_scale(self) -> Array:
        """(6,) size of the pose."""
        return self.scale[self.platform]

    @property
    def load_scale(self) -> Array:
        """(6,) size of the load."""
        return self.energy / self.pose_scale


def layout(mechanism: Mechanism) -> Layout:
    """Layout of u for a mechanism; its largest translational spring gives the unit of force."""
    return _layout(mechanism.chains, mechanism.length)


@lru_cache(maxsize=256)
def _layout(chains: tuple[ElasticChain, ...], length: float) -> Layout:
    sizes = [chain.moving.size for chain in chains]
    pieces = _slices([*sizes, 6, *[6] * len(sizes)])
    memories = _slices([chain.initial_memory.size for chain in chains])
    force = length * max(_translational_stiffness(chain) for chain in chains)
    pose_scale = np.repeat([length, 1.0], 3)
    scales = [_coordinate_scale(chain, length) for chain in chains]
    wrench_scale = force * np.repeat([1.0, length], 3)
    scale = np.concatenate([*scales, pose_scale, *[wrench_scale] * len(sizes)])
    n = len(sizes)
    drives = _drives(chains)
    return Layout(pieces[:n], pieces[n], pieces[n + 1 :], memories, scale, force * length, *drives)


def rest(mechanism: Mechanism, drives: Array, unloaded: bool = False) -> tuple[Array, ...]:
    """Rest values (..., n) of all coordinates of each chain; drives (..., D) are departures from the defaults.

    unloaded: with the inputs of the posture alone, the state in which gauges are zeroed.
    """
    place = layout(mechanism)
    if not place.drives:
        return tuple(chain.rest for chain in mechanism.chains)
    if unloaded:
        drives = np.where(place.posture, drives, 0.0)
    pairs = zip(mechanism.chains, place.rest_slopes, strict=True)
    return tuple(chain.rest + drives @ slope + _curved(place, chain, drives) for chain, slope in pairs)


def _curved(place: Layout, chain: ElasticChain, drives: Array) -> Array | float:
    """(..., n) what inputs (..., D) add to the rest values beyond their slopes."""
    curves = [(drive.curve, place.drives.index(drive.name)) for drive in chain.drives if drive.curve]
    return sum((curve(drives[..., number]) for curve, number in curves), start=0.0)


def at_rest(mechanism: Mechanism, drives: Array) -> Array:
    """Unknowns (..., N) of the unloaded mechanism at the inputs (..., D): chains at rest, platform on the first."""
    batch = drives.shape[:-1]
    values = [np.broadcast_to(x, (*batch, x.shape[-1])) for x in rest(mechanism, drives)]
    moving = [x[..., chain.moving] for x, chain in zip(values, mechanism.chains, strict=True)]
    pose = mechanism.chains[0].chain.pose(values[0])
    return np.concatenate([*moving, pose, np.zeros((*batch, 6 * len(values)))], axis=-1)


def chain_coordinates(chain: ElasticChain, moving: Array, rest: Array) -> Array:
    """All coordinates (..., n) of a chain from its moving ones (..., m) and the rest values (..., n) of all."""
    full = np.broadcast_to(rest, (*moving.shape[:-1], chain.chain.size)).copy()
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
    chain: ElasticChain,
    moving: Array,
    rest: Array,
    pose: Array,
    multiplier: Array,
    memory: Array,
    second: bool,
) -> ChainRows:
    """Rows of a chain at its moving coordinates (..., m), the platform pose t and lambda (..., 6).

    rest: (..., n) of all its coordinates. Without `second` the matrix is empty.
    """
    coordinates = chain_coordinates(chain, moving, rest)
    kinematics = chain.chain.kinematics(coordinates)
    strain = moving - rest[..., chain.moving]
    m = chain.moving.size
    if second:
        answer, jacobian = chain.respond(strain, memory), kinematics.jacobian
        curvature = kinematics.hessian(multiplier)
        if m < chain.chain.size:
            jacobian = jacobian[..., chain.moving]
            curvature = curvature[..., chain.moving[:, None], chain.moving]
        matrix = np.zeros((*moving.shape[:-1], m + 6, m + 6))
        matrix[..., :m, :m] = answer.tangent - curvature
        matrix[..., m:, :m] = -jacobian
        matrix[..., :m, m:] = -np.swapaxes(jacobian, -1, -2)
        balance = answer.force - np.einsum("...ji,...j->...i", jacobian, multiplier)
    else:
        matrix = np.zeros(0)
        balance = chain.force(strain, memory) - kinematics.pull(multiplier)[..., chain.moving]
    for load in chain.loads:
        pull, slope = load.pull(coordinates, second)
        balance = balance - pull[..., chain.moving]
        if second:
            matrix[..., :m, :m] -= slope[..., chain.moving[:, None], chain.moving]
    return ChainRows(balance, pose - kinematics.pose, matrix, chain.elimination_order)


def all_rows(
    mechanism: Mechanism, unknowns: Array, memory: Array, drives: Array, second: bool = True
) -> tuple[ChainRows, ...]:
    """`chain_rows` of every chain at unknowns (..., N), memory (..., M), inputs (..., D)."""
    place = layout(mechanism)
    note(unknowns.size // place.size, place.size)
    parts = zip(
        mechanism.chains,
        rest(mechanism, drives),
        place.coordinates,
        place.multipliers,
        place.memories,
        strict=True,
    )
    pose = unknowns[..., place.platform]
    return tuple(
        chain_rows(chain, unknowns[..., x], start, pose, unknowns[..., dual], memory[..., past], second)
        for chain, start, x, dual, past in parts
    )


def gradient(place: Layout, rows: tuple[ChainRows, ...], unknowns: Array) -> Array:
    """Gradient (..., N) of L without external load: at the platform stands the sum of the multipliers."""
    out = np.zeros_like(unknowns)
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
class Control:
    """Six equations of the platform, one for each of its coordinates, linearised and dimensionless.

    by_pose, by_load: (B, 6, 6) by the pose and by the sum of the multipliers. by_coordinates: (B, 6, m) by a
    chain's coordinates, None where no gauge on it is controlled. held: (B, 6) equations that hold a motion.
    plain: whether each equation is about the coordinate itself, its pose or its load.
    """

    by_pose: Array
    by_load: Array
    by_coordinates: tuple[Array | None, ...]
    held: np.ndarray
    plain: bool


@dataclass(frozen=True, eq=False)
class Solution:
    """step: (B, N, r) dimensionless. regular: (B,). stiffness: (B, 6, 6) dimensionless, the sum of Eq. 10.

    control: (B, 6, 6) the platform's equations by its motion, all else following.
    """

    step: Array
    regular: np.ndarray
    stiffness: Array
    control: Array


def newton_step(place: Layout, rows: tuple[ChainRows, ...], right: Array, control: Control) -> Solution:
    """Dimensionless solutions of H step = right, chain by chain; the platform's rows are those of the control.

    right: (B, N, r) dimensionless. Each chain is solved for its own right side and for six unit motions of the
    platform, which leaves 6x6 equations with the sum of the chains' stiffness (Eq. 10).
    """
    count = right.shape[-1]
    step = np.empty_like(right)
    stiffness = np.zeros((len(right), 6, 6))
    load = np.zeros((len(right), 6, count))
    regular = np.ones(len(right), dtype=bool)
    answers = []
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        m = x.stop - x.start
        sides = np.zeros((len(right), m + 6, count + 6))
        sides[:, :m, :count], sides[:, m:, :count] = right[:, x], right[:, dual]
        sides[:, m:, count:] = -np.eye(6)
        answer, solvable = solve_each(_dimensionless(place, row, x, dual), sides)
        load += answer[:, m:, :count]
        stiffness += answer[:, m:, count:]
        regular &= solvable
        answers.append(answer)
    platform = right[:, place.platform] - control.by_load @ load
    matrix = control.by_pose + control.by_load @ stiffness
    for answer, by in zip(answers, control.by_coordinates, strict=True):
        if by is not None:
            platform -= by @ answer[:, : by.shape[-1], :count]
            matrix += by @ answer[:, : by.shape[-1], count:]
    motion, solvable = solve_each(matrix, platform)
    step[:, place.platform] = motion
    for answer, x, dual in zip(answers, place.coordinates, place.multipliers, strict=True):
        m = x.stop - x.start
        whole = answer[..., :count] + answer[..., count:] @ motion
        step[:, x], step[:, dual] = whole[:, :m], whole[:, m:]
    return Solution(step, regular & solvable, stiffness, matrix)


def unstable_directions(
    place: Layout, rows: tuple[ChainRows, ...], found: Solution, control: Control, members: np.ndarray
) -> np.ndarray:
    """Number of unstable directions of these members, chain by chain.

    Inertia adds up over the elimination (E. V. Haynsworth, "Determination of the inertia of a partitioned
    Hermitian matrix", Linear Algebra and its Applications 1, 1968): what each chain's matrix has beyond the six
    negative eigenvalues of its closure, and what is left on the motions of the platform that the control allows.
    """
    count = np.zeros(members.size, dtype=int)
    if members.size == 0:
        return count
    for row, x, dual in zip(rows, place.coordinates, place.multipliers, strict=True):
        part = ChainRows(row.balance, row.gap, row.matrix[members], row.order)
        matrix = _dimensionless(place, part, x, dual)[:, row.order[:, None], row.order]
        count += negative_pivots(matrix) - 6
    stiffness, held = found.stiffness[members], control.held[members]
    if not control.plain:
        return count + _on_allowed(stiffness, found.control[members], held)
    both = ~held[:, :, None] & ~held[:, None, :]
    return count + negative_pivots(np.where(both, stiffness, np.eye(6)))


def _on_allowed(stiffness: Array, control: Array, held: np.ndarray) -> np.ndarray:
    """Negative eigenvalues (B,) of the stiffness on the motions that leave the held equations alone.

    Bordered with k such equations, the stiffness has k negative eigenvalues more.
    """
    bordered = np.zeros((len(stiffness), 12, 12))
    bordered[:, :6, :6] = 0.5 * (stiffness + np.swapaxes(stiffness, -1, -2))
    rows = np.where(held[..., None], control, 0.0)
    size = np.linalg.norm(rows, axis=-1, keepdims=True)
    rows = rows / np.where(size > 0, size, 1.0)
    bordered[:, 6:, :6], bordered[:, :6, 6:] = rows, np.swapaxes(rows, -1, -2)
    bordered[:, range(6, 12), range(6, 12)] = ~held
    return np.sum(np.linalg.eigvalsh(bordered) < 0, axis=-1) - np.sum(held, axis=-1)


def _dimensionless(place: Layout, row: ChainRows, x: slice, dual: slice) -> Array:
    scale = np.concatenate([place.scale[x], place.scale[dual]])
    return row.matrix * np.outer(scale, scale / place.energy)


def _drives(chains: tuple[ElasticChain, ...]) -> tuple[tuple[str, ...], Array, tuple[Array, ...], np.ndarray]:
    """Names, defaults (D,), rest values (D, n) that they move in each chain and posture (D,) of all inputs."""
    every = {drive.name: drive for chain in chains for drive in chain.drives}
    names = tuple(every)
    slopes = []
    for chain in chains:
        slope = np.zeros((len(names), chain.chain.size))
        for drive in chain.drives:
            slope[names.index(drive.name)] += drive.slope
        slopes.append(slope)
    defaults = np.array([drive.default for drive in every.values()], dtype=float)
    return names, defaults, tuple(slopes), np.array([drive.posture for drive in every.values()], dtype=bool)


def _coordinate_scale(chain: ElasticChain, length: float) -> Array:
    joints = chain.chain.joints
    return np.array([length if joints[k].kind == "translation" else 1.0 for k in chain.moving])


def _translational_stiffness(chain: ElasticChain) -> float:
    joints = chain.chain.joints
    entries = zip(chain.virtual, np.diag(chain.stiffness), strict=True)
    return max((float(k) for j, k in entries if joints[j].kind == "translation"), default=1.0)


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    return tuple(slice(int(a), int(b)) for a, b in pairwise(np.cumsum([0, *sizes])))
