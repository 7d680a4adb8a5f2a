"""The Lagrange function of Eq. 4 with the platform pose among the unknowns: gradient and bordered Hessian.

Unknowns u, in this order: the moving coordinates (theta and q) of each chain, the platform pose t (6), the
multiplier lambda_i (6) of each chain with those mu (6) of the loops inside it. L = sum of elastic energies
+ sum lambda_i^T (t - g_i) + sum mu^T (g_2 - g_1) - F^T t, g_1 and g_2 at the ends of the two paths of a loop.
The gradient is Eq. 5 together with the platform's balance; its Hessian is symmetric, bordered by the
closures t = g_i and g_1 = g_2. All arrays carry leading batch axes. `vjm.blocks` solves with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from math import prod

import numpy as np

from vjm import kernels
from vjm.frames import Array, flat
from vjm.mechanism import NONE, ElasticChain, Mechanism
from vjm.work import note

NUMBERS = 100_000
"""Of the matrices of each chain that are made at once: less than a MB."""


@dataclass(frozen=True, eq=False)
class Layout:
    """Where each unknown stands in u, and its typical size.

    coordinates, closing, memories: one slice per chain, of its closures' multipliers, lambda first, and of the
    memory of its laws; platform: one slice.
    scale: (N,) size of each unknown: length for translations, 1 rad, stiffness x length for forces.
    energy: stiffness x length², N·mm, the size of L. scale_i scale_j H_ij / energy is dimensionless.
    drives: names of the D inputs; defaults: (D,) their values; rest_slopes: (D, n) per chain.
    posture: (D,) mask of the inputs with which gauges are zeroed.
    """

    coordinates: tuple[slice, ...]
    platform: slice
    closing: tuple[slice, ...]
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

    @cached_property
    def multipliers(self) -> tuple[slice, ...]:
        """lambda (6) of each chain."""
        return tuple(slice(dual.start, dual.start + 6) for dual in self.closing)

    @cached_property
    def several(self) -> int:
        """Load cases whose matrices stay in a cache together; memory does not grow with the batch either."""
        sizes = zip(self.coordinates, self.closing, strict=True)
        return max(4, NUMBERS // max(x.stop - x.start + dual.stop - dual.start for x, dual in sizes) ** 2)

    @property
    def closures(self) -> int:
        """Number of scalar closure equations, those of the loops inside chains included."""
        return self.size - self.platform.stop

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
    pieces = _slices([*sizes, 6, *(chain.closures for chain in chains)])
    memories = _slices([chain.initial_memory.size for chain in chains])
    force = length * max(_translational_stiffness(chain) for chain in chains)
    pose_scale = np.repeat([length, 1.0], 3)
    scales = [_coordinate_scale(chain, length) for chain in chains]
    wrench_scale = force * np.repeat([1.0, length], 3)
    closures = sum(chain.closures for chain in chains)
    scale = np.concatenate([*scales, pose_scale, *[wrench_scale] * (closures // 6)])
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
    first = mechanism.chains[0].main
    pose = first.chain.pose(values[0][..., first.numbers])
    return np.concatenate([*moving, pose, np.zeros((*batch, layout(mechanism).closures))], axis=-1)


def chain_coordinates(chain: ElasticChain, moving: Array, rest: Array) -> Array:
    """All coordinates (..., n) of a chain from its moving ones (..., m) and the rest values (..., n) of all."""
    full = np.broadcast_to(rest, (*moving.shape[:-1], chain.size)).copy()
    full[..., chain.moving] = moving
    return full


@dataclass(frozen=True, eq=False)
class ChainRows:
    """One chain's share of gradient and Hessian, with c closures, that of the platform first.

    balance: (..., m) by its coordinates. gap: (..., c) t - g and g_2 - g_1. matrix: (..., m + c, m + c) by its
    coordinates and its multipliers.
    """

    balance: Array
    gap: Array
    matrix: Array


def chain_rows(
    chain: ElasticChain,
    moving: Array,
    rest: Array,
    pose: Array,
    multipliers: Array,
    memory: Array,
    second: bool,
    linear: Array | None = None,
) -> ChainRows:
    """Rows of a chain at its moving coordinates (..., m), the platform pose t and the multipliers (..., c).

    rest: (..., n) of all its coordinates. linear: of `ElasticChain.linear`. Without `second` the matrix is empty.
    """
    coordinates = chain_coordinates(chain, moving, rest)
    strain = moving - rest[..., chain.moving]
    m, batch = chain.moving.size, moving.shape[:-1]
    matrix, stiffness = NONE, chain.full_stiffness if linear is None else linear
    if second:
        whole = np.zeros((*stiffness.shape[:-2], m + chain.closures, m + chain.closures))
        whole[..., :m, :m] = stiffness
        matrix = np.empty((*batch, *whole.shape[-2:]))
        matrix[...] = whole
    balance = chain.force(strain, memory, linear, matrix)
    balance, gap = np.ascontiguousarray(balance), np.zeros((*batch, chain.closures))
    gap[..., :6] = pose
    _close(chain, coordinates, multipliers, gap, balance, matrix)
    for load, columns in zip(chain.loads, chain.load_columns, strict=True):
        load.add(coordinates, columns, -1.0, balance, matrix)
    return ChainRows(balance, gap, matrix)


def closing_force(chain: ElasticChain, coordinates: Array, multipliers: Array) -> Array:
    """Force (..., m) on the moving coordinates of a chain by its closures, at all its coordinates (..., n) and the
    multipliers (..., c): what its springs carry."""
    out = np.zeros((*coordinates.shape[:-1], chain.moving.size))
    _close(chain, coordinates, multipliers, np.zeros(multipliers.shape), out, np.zeros(0))
    return -out


def _close(
    chain: ElasticChain, coordinates: Array, multipliers: Array, gap: Array, balance: Array, matrix: Array
) -> None:
    """Add the closures of a chain at all its coordinates (..., n) and the multipliers (..., c) to its gap (..., c), its
    balance (..., m) and, unless it is empty, its matrix (..., m + c, m + c), all contiguous.

    ValueError for coordinates and multipliers of different batches.
    """
    if coordinates.shape[:-1] != multipliers.shape[:-1]:
        raise ValueError(f"coordinates are {coordinates.shape}, multipliers {multipliers.shape}")
    count, m, closures = prod(coordinates.shape[:-1]), balance.shape[-1], gap.shape[-1]
    matrices = matrix.reshape(count, *matrix.shape[-2:]) if matrix.size else np.zeros((0, 0, 0))
    gaps, balances, duals = gap.reshape(count, closures), balance.reshape(count, m), flat(multipliers)
    for each in chain.closed:
        own = flat(coordinates if each.whole else coordinates[..., each.path.numbers])
        program = each.path.chain.program
        kernels.close(program, each.columns, own, duals, each.dual, each.sign, m, gaps, balances, matrices)


def all_rows(
    mechanism: Mechanism, unknowns: Array, memory: Array, drives: Array, second: bool = True
) -> tuple[ChainRows, ...]:
    """`chain_rows` of every chain at unknowns (..., N), memory (..., M), inputs (..., D)."""
    place = layout(mechanism)
    note(unknowns.size // place.size, place.size)
    parts = zip(
        mechanism.chains,
        rest(mechanism, drives),
        linear_stiffness(mechanism, drives),
        place.coordinates,
        place.closing,
        place.memories,
        strict=True,
    )
    pose = unknowns[..., place.platform]
    return tuple(
        chain_rows(
            chain, unknowns[..., x], start, pose, unknowns[..., dual], memory[..., past], second, linear
        )
        for chain, start, linear, x, dual, past in parts
    )


def linear_stiffness(mechanism: Mechanism, drives: Array) -> tuple[Array, ...]:
    """(m, m), or (..., m, m) of chains with springs that follow an input, at the inputs (..., D)."""
    place = layout(mechanism)
    inputs = {name: drives[..., k] + place.defaults[k] for k, name in enumerate(place.drives)}
    return tuple(chain.linear(inputs) for chain in mechanism.chains)


def gradient(place: Layout, rows: tuple[ChainRows, ...], unknowns: Array) -> Array:
    """Gradient (..., N) of L without external load: at the platform stands the sum of the multipliers."""
    out = np.zeros_like(unknowns)
    for row, x, dual, load in zip(rows, place.coordinates, place.closing, place.multipliers, strict=True):
        out[..., x], out[..., dual] = row.balance, row.gap
        out[..., place.platform] += unknowns[..., load]
    return out


def hessian(place: Layout, rows: tuple[ChainRows, ...]) -> Array:
    """Hessian (..., N, N) of L."""
    out = np.zeros((*rows[0].gap.shape[:-1], place.size, place.size))
    for row, x, dual, load in zip(rows, place.coordinates, place.closing, place.multipliers, strict=True):
        m = x.stop - x.start
        out[..., x, x] = row.matrix[..., :m, :m]
        out[..., dual, x] = row.matrix[..., m:, :m]
        out[..., x, dual] = row.matrix[..., :m, m:]
        out[..., load, place.platform] = out[..., place.platform, load] = np.eye(6)
    return out


def _drives(chains: tuple[ElasticChain, ...]) -> tuple[tuple[str, ...], Array, tuple[Array, ...], np.ndarray]:
    """Names, defaults (D,), rest values (D, n) that they move in each chain and posture (D,) of all inputs."""
    every = {drive.name: drive for chain in chains for drive in chain.drives}
    names = tuple(every)
    slopes = []
    for chain in chains:
        slope = np.zeros((len(names), chain.size))
        for drive in chain.drives:
            slope[names.index(drive.name)] += drive.slope
        slopes.append(slope)
    defaults = np.array([drive.default for drive in every.values()], dtype=float)
    return names, defaults, tuple(slopes), np.array([drive.posture for drive in every.values()], dtype=bool)


def _coordinate_scale(chain: ElasticChain, length: float) -> Array:
    joints = chain.joints
    return np.array([length if joints[k].kind == "translation" else 1.0 for k in chain.moving])


def _translational_stiffness(chain: ElasticChain) -> float:
    """The largest, N/mm, with inputs at their defaults."""
    defaults = {drive.name: np.asarray(drive.default) for drive in chain.drives}
    entries = zip(chain.moving, np.diag(chain.linear(defaults)), strict=True)
    joints = chain.joints
    found = [float(k) for j, k in entries if joints[j].kind == "translation" and j in chain.virtual]
    return max(found, default=1.0)


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    return tuple(slice(int(a), int(b)) for a, b in pairwise(np.cumsum([0, *sizes])))
