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

import numpy as np

from vjm.frames import Array
from vjm.mechanism import ElasticChain, Mechanism, Path
from vjm.work import note


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
    if second:
        answer = chain.respond(strain, memory, linear)
        size = m + chain.closures
        matrix, balance = np.zeros((*batch, size, size)), answer.force
        matrix[..., :m, :m] = answer.tangent
    else:
        matrix, balance = np.zeros(0), chain.force(strain, memory, linear)
    gap = np.zeros((*batch, chain.closures)) if chain.loops else np.empty((*batch, 6))
    gap[..., :6] = pose
    for number, sides in enumerate(_closures(chain)):
        dual = slice(6 * number, 6 * number + 6)
        for path, sign in sides:
            end, pull = _closed(
                path, sign, coordinates, multipliers[..., dual], chain, matrix, m + dual.start
            )
            if sign > 0:
                gap[..., dual] += end
                balance = balance + pull
            else:
                gap[..., dual] -= end
                balance = balance - pull
    for load in chain.loads:
        pull, slope = load.pull(coordinates, second)
        balance = balance - pull[..., chain.moving]
        if second:
            matrix[..., :m, :m] -= slope[..., chain.moving[:, None], chain.moving]
    return ChainRows(balance, gap, matrix)


def closing_force(chain: ElasticChain, coordinates: Array, multipliers: Array) -> Array:
    """Force (..., m) on the moving coordinates of a chain by its closures, at all its coordinates (..., n) and the
    multipliers (..., c): what its springs carry."""
    nothing, out = np.zeros(0), np.zeros((*coordinates.shape[:-1], chain.moving.size))
    for number, sides in enumerate(_closures(chain)):
        dual = multipliers[..., 6 * number : 6 * number + 6]
        for path, sign in sides:
            out = out - sign * _closed(path, sign, coordinates, dual, chain, nothing, 0)[1]
    return out


def _closures(chain: ElasticChain) -> list[tuple[tuple[Path, float], ...]]:
    """Of each closure the paths that are in it, with their signs."""
    return [((chain.main, -1.0),), *(loop.sides for loop in chain.loops)]


def _closed(
    path: Path,
    sign: float,
    coordinates: Array,
    multiplier: Array,
    chain: ElasticChain,
    matrix: Array,
    row: int,
) -> tuple[Array, Array]:
    """Pose (..., 6) at the end of a path, and Jacobian^T multiplier (..., m) by the moving coordinates of the chain.

    Adds sign x its Jacobian to the matrix at this row and column, and sign x its curvature, unless that is empty.
    """
    whole = path.numbers.size == chain.size
    here = path.chain.kinematics(coordinates if whole else coordinates[..., path.numbers])
    second, m = matrix.size > 0, chain.moving.size
    if whole and m == chain.size:
        mine: np.ndarray | slice = slice(None)
        place: np.ndarray | slice = slice(0, m)
    else:
        mine = np.flatnonzero(np.isin(path.numbers, chain.moving))
        place = np.searchsorted(chain.moving, path.numbers[mine])
    if not second:
        own = here.pull(multiplier)[..., mine]
    else:
        jacobian, curvature = here.jacobian[..., mine], here.hessian(multiplier)
        dual = slice(row, row + 6)
        # No other path has these rows and columns.
        if isinstance(place, slice):
            np.multiply(jacobian, sign, out=matrix[..., dual, place])
            np.multiply(np.swapaxes(jacobian, -1, -2), sign, out=matrix[..., place, dual])
            (np.add if sign > 0 else np.subtract)(
                matrix[..., place, place], curvature, out=matrix[..., place, place]
            )
        else:
            signed = sign * jacobian
            matrix[..., dual, place] = signed
            matrix[..., place, dual] = np.swapaxes(signed, -1, -2)
            matrix[..., place[:, None], place] += sign * curvature[..., mine, :][..., mine]
        own = np.einsum("...ji,...j->...i", jacobian, multiplier)
    if isinstance(place, slice):
        return here.pose, own
    pull = np.zeros((*own.shape[:-1], m))
    pull[..., place] = own
    return here.pose, pull


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
